// Exposure as colours: one for each band of stops around middle grey, as cameras and light meters
// show it. The shader and the legend are made from the same table.
#pragma once

#include <array>
#include <string>

#include "loader/scene.h"

namespace lumivec {

constexpr float middle_gray = 0.18f;

struct FalseColorBand {
  float below;       // stops from middle grey where the next band begins
  Color color;       // as displayed
  const char* says;  // of the band
};

const std::array<FalseColorBand, 10>& false_color_bands();

// radiance: exposed, scene-linear. Black and darker is the first band, as is what is not a number.
Color false_color(const Color& radiance);

// GLSL: vec3 false_color(vec3 radiance), the same.
std::string false_color_shader();

}  // namespace lumivec
