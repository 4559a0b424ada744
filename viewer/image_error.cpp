#include "viewer/image_error.h"

#include <cassert>
#include <cmath>

namespace lumivec {
namespace {

bool is_finite(const Color& c) {
  return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
}

}  // namespace

ImageError image_error(const Picture& test, const Picture& reference) {
  assert(test.width == reference.width && test.height == reference.height);
  constexpr double dark_guard = 0.01;  // keeps black reference pixels from deciding the mean
  ImageError error;
  double squares = 0.0, relative = 0.0, absolute = 0.0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    const Color& a = test.pixels[i];
    const Color& b = reference.pixels[i];
    if (!is_finite(a) || !is_finite(b)) continue;
    for (int c = 0; c < 3; ++c) {
      const double difference = double(a[c]) - double(b[c]);
      const double square = difference * difference;
      squares += square;
      relative += square / (double(b[c]) * double(b[c]) + dark_guard);
      absolute += std::abs(difference);
    }
    ++error.pixels;
  }
  const double count = 3.0 * double(error.pixels);
  error.rmse = std::sqrt(squares / count);
  error.relmse = relative / count;
  error.mean_absolute = absolute / count;
  return error;
}

NonFinite find_non_finite(const Picture& picture) {
  NonFinite found;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    if (is_finite(picture.pixels[i])) continue;
    if (found.count++ == 0) {
      found.first_x = int(i % std::size_t(picture.width));
      found.first_y = int(i / std::size_t(picture.width));
    }
  }
  return found;
}

}  // namespace lumivec
