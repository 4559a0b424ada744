#include "integrator/pixel_filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace lumivec {
namespace {

// Half widths in pixels, as in Cycles and pbrt: wide enough to be smooth, narrow enough to stay
// sharp.
constexpr double tent_radius = 1.0;
constexpr double gaussian_radius = 1.5;
constexpr double gaussian_sigma = 0.5;
constexpr double blackman_harris_radius = 0.75;

double radius_of(PixelFilter filter) {
  switch (filter) {
    case PixelFilter::tent:
      return tent_radius;
    case PixelFilter::gaussian:
      return gaussian_radius;
    case PixelFilter::blackman_harris:
      return blackman_harris_radius;
    case PixelFilter::box:
      break;
  }
  return 0.5;
}

double weight(PixelFilter filter, double x) {
  switch (filter) {
    case PixelFilter::tent:
      return 1.0 - std::abs(x) / tent_radius;
    case PixelFilter::gaussian: {
      const double s2 = 2.0 * gaussian_sigma * gaussian_sigma;
      return std::exp(-x * x / s2) - std::exp(-gaussian_radius * gaussian_radius / s2);
    }
    case PixelFilter::blackman_harris: {
      const double t = std::numbers::pi * (x / blackman_harris_radius + 1.0);
      return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2.0 * t) -
             0.01168 * std::cos(3.0 * t);
    }
    case PixelFilter::box:
      break;
  }
  return 1.0;
}

}  // namespace

PixelFilterSampler::PixelFilterSampler(PixelFilter filter)
    : box_(filter == PixelFilter::box),
      filter_(filter),
      radius_(static_cast<float>(radius_of(filter))) {
  if (box_) return;
  constexpr int steps = 4096;
  const double radius = radius_of(filter);
  std::vector<double> cdf(steps + 1, 0.0);
  for (int i = 0; i < steps; ++i) {
    const double x = radius * (2.0 * (i + 0.5) / steps - 1.0);
    cdf[std::size_t(i) + 1] = cdf[std::size_t(i)] + std::max(weight(filter, x), 0.0);
  }
  scale_ = static_cast<float>(steps / (2.0 * radius * cdf.back()));
  for (int i = 0; i <= table_size; ++i) {
    const double target = cdf.back() * i / table_size;
    const auto above = std::lower_bound(cdf.begin() + 1, cdf.end() - 1, target);
    const double low = *(above - 1), high = *above;
    const double fraction = high > low ? std::clamp((target - low) / (high - low), 0.0, 1.0) : 0.0;
    const double cell = static_cast<double>(above - cdf.begin()) - 1.0 + fraction;
    inverse_cdf_[std::size_t(i)] = static_cast<float>(radius * (2.0 * cell / steps - 1.0));
  }
}

float PixelFilterSampler::density(float x) const {
  return std::abs(x) < radius_ ? scale_ * static_cast<float>(std::max(weight(filter_, x), 0.0))
                               : 0.0f;
}

float PixelFilterSampler::offset(float u) const {
  if (box_) return u - 0.5f;
  const float position = u * static_cast<float>(table_size);
  const int i = std::min(static_cast<int>(position), table_size - 1);
  const float fraction = position - static_cast<float>(i);
  return inverse_cdf_[std::size_t(i)] * (1.0f - fraction) +
         inverse_cdf_[std::size_t(i) + 1] * fraction;
}

}  // namespace lumivec
