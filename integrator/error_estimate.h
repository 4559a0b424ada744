// The error of a picture by its own samples: what the second half of them changed.
#pragma once

#include <cstdint>
#include <vector>

#include "integrator/film.h"

namespace lumivec {

// A pixel's square, which the error is relative to, is taken as the product of its halves: the
// square of their mean is too large where they are noisy, and would hide the very pixels that are
// worst.
class ErrorEstimate {
 public:
  // Remembers the picture after `samples` samples a pixel.
  void remember(const Film& film, std::uint32_t samples);

  // √relMSE of the picture, which has twice as many samples as the one remembered.
  double compare(const Film& film);

  // Of the picture remembered; 0: none yet.
  std::uint32_t samples() const { return samples_; }
  // At a number of samples a pixel, by the rate of plain Monte Carlo; < 0: not known yet.
  double error_at(double samples) const;

 private:
  std::vector<Color> half_;
  std::uint32_t samples_ = 0;
  double compared_at_ = 0.0;
  double error_ = -1.0;
};

}  // namespace lumivec
