// How bright a picture is shown.
#pragma once

#include <vector>

#include "loader/scene.h"

namespace lumivec {

// Rec. 709 luminance of a linear colour.
inline float luminance(const Color& c) {
  return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
}

// Stops that bring the logarithmic mean of the luminance to middle grey, 0.18 (Reinhard et al.
// 2002, equation 1, key 0.18). Pixels that are black or not finite do not count; 0 if none is left.
double automatic_exposure(const std::vector<Color>& scene_linear);

}  // namespace lumivec
