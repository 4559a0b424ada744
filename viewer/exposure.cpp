#include "viewer/exposure.h"

#include <cmath>
#include <cstddef>

namespace lumivec {

double automatic_exposure(const std::vector<Color>& scene_linear) {
  constexpr double middle_grey = 0.18;
  double sum = 0.0;
  std::size_t count = 0;
  for (const Color& c : scene_linear) {
    const float y = luminance(c);
    if (!(y > 0.0f) || !std::isfinite(y)) continue;
    sum += std::log2(double(y));
    ++count;
  }
  return count ? std::log2(middle_grey) - sum / double(count) : 0.0;
}

}  // namespace lumivec
