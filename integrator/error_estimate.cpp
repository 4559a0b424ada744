#include "integrator/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "integrator/relative_error.h"

namespace lumivec {

void ErrorEstimate::remember(const Film& film, std::uint32_t samples) {
  samples_ = samples;
  half_.resize(film.size());
  for (std::size_t i = 0; i < film.size(); ++i) half_[i] = film.beauty(i);
}

double ErrorEstimate::compare(const Film& film) {
  double sum = 0.0;
  for (std::size_t i = 0; i < film.size(); ++i) {
    const Color mean = film.beauty(i);
    for (int c = 0; c < 3; ++c) {
      // mean = (first + second) / 2, so first - mean is half the difference: its square estimates
      // the variance.
      const double d = double(half_[i][c]) - mean[c];
      const double second = 2.0 * mean[c] - half_[i][c];
      sum += relative_to(d * d, std::max(half_[i][c] * second, 0.0));
    }
  }
  compared_at_ = 2 * samples_;
  error_ = std::sqrt(sum / (3.0 * static_cast<double>(film.size())));
  return error_;
}

double ErrorEstimate::error_at(double samples) const {
  return error_ < 0.0 || samples <= 0.0 ? error_ : error_ * std::sqrt(compared_at_ / samples);
}

}  // namespace lumivec
