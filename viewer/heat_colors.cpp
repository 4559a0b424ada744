#include "viewer/heat_colors.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace lumivec {

Color heat_color(float value) {
  // CIE lightness 0, 19, 38, 58, 78, 97: equal steps of error look like equal steps.
  static const std::array<Color, 6> ramp = {{{0.00f, 0.00f, 0.00f},
                                             {0.26f, 0.07f, 0.47f},
                                             {0.66f, 0.18f, 0.47f},
                                             {0.95f, 0.40f, 0.30f},
                                             {0.99f, 0.71f, 0.36f},
                                             {1.00f, 0.98f, 0.75f}}};
  const float place = std::clamp(value, 0.0f, 1.0f) * float(ramp.size() - 1);
  const std::size_t step = std::min(std::size_t(place), ramp.size() - 2);
  const float share = place - float(step);
  return ramp[step] * (1.0f - share) + ramp[step + 1] * share;
}

Picture heat_picture(const std::vector<float>& values, int width, int height) {
  assert(values.size() == std::size_t(width) * std::size_t(height));
  Picture picture(width, height);
  for (std::size_t i = 0; i < values.size(); ++i) picture.pixels[i] = heat_color(values[i]);
  return picture;
}

}  // namespace lumivec
