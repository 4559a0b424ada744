// A map of errors as a picture.
#pragma once

#include <vector>

#include "viewer/picture.h"

namespace lumivec {

// values: width × height, clamped to [0, 1]. Black over purple, red and orange to pale yellow,
// rising evenly in lightness; display-encoded sRGB.
// The color of one value.
Color heat_color(float value);
Picture heat_picture(const std::vector<float>& values, int width, int height);

}  // namespace lumivec
