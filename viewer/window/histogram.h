// How often each brightness occurs in a picture, on a scale of stops, and each term's share.
#pragma once

#include <array>
#include <vector>

#include "integrator/settings.h"
#include "loader/scene.h"

namespace lumivec {

struct Histogram {
  static constexpr int bins_per_stop = 4;
  static constexpr float first_stop = -12.0f, last_stop = 8.0f;  // from middle grey
  static constexpr int bin_count = int(last_stop - first_stop) * bins_per_stop;

  // Logarithms of the counts, log10(1 + n), of luminance, red, green and blue.
  std::array<std::array<float, bin_count>, 4> counts{};
  // Pixels that have no place in it.
  std::size_t black = 0, below = 0, above = 0, not_finite = 0;
};

// Every stride-th pixel in both directions is looked at. exposure: stops.
Histogram histogram(const std::vector<Color>& radiance, int width, double exposure, int stride);

// Of the luminance summed over all pixels; they add up to 1, or are all 0.
std::array<double, term_count> term_shares(
    const std::array<std::vector<Color>, term_count>& layers);

}  // namespace lumivec
