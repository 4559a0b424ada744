#include "viewer/window/false_color.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "viewer/exposure.h"

namespace lumivec {

const std::array<FalseColorBand, 10>& false_color_bands() {
  static const std::array<FalseColorBand, 10> bands = {
      {{-6.0f, {0.10f, 0.02f, 0.20f}, "below -6"},
       {-4.0f, {0.28f, 0.10f, 0.55f}, "-6 to -4"},
       {-2.0f, {0.12f, 0.28f, 0.85f}, "-4 to -2"},
       {-1.0f, {0.10f, 0.55f, 0.70f}, "-2 to -1"},
       {-0.25f, {0.35f, 0.35f, 0.35f}, "-1 to -1/4"},
       {0.25f, {0.20f, 0.70f, 0.20f}, "middle grey"},
       {1.0f, {0.62f, 0.62f, 0.62f}, "1/4 to 1"},
       {2.0f, {0.95f, 0.85f, 0.20f}, "1 to 2"},
       {4.0f, {0.95f, 0.45f, 0.10f}, "2 to 4"},
       {std::numeric_limits<float>::infinity(), {0.85f, 0.08f, 0.08f}, "above 4"}}};
  return bands;
}

Color false_color(const Color& radiance) {
  const auto& bands = false_color_bands();
  const float bright = luminance(radiance);
  if (!(bright > 0.0f)) return bands.front().color;
  const float stops = std::log2(bright / middle_gray);
  for (const FalseColorBand& band : bands) {
    if (stops < band.below) return band.color;
  }
  return bands.back().color;
}

std::string false_color_shader() {
  const auto& bands = false_color_bands();
  std::ostringstream text;
  text.setf(std::ios::fixed);
  const auto color = [&](const FalseColorBand& band) {
    text << "return vec3(" << band.color.x << ", " << band.color.y << ", " << band.color.z
         << ");\n";
  };
  text << "vec3 false_color(vec3 radiance) {\n"
       << "  float bright = dot(radiance, vec3(0.2126, 0.7152, 0.0722));\n"
       << "  if (!(bright > 0.0)) ";
  color(bands.front());
  text << "  float stops = log2(bright / " << middle_gray << ");\n";
  for (std::size_t i = 0; i + 1 < bands.size(); ++i) {
    text << "  if (stops < " << bands[i].below << ") ";
    color(bands[i]);
  }
  text << "  ";
  color(bands.back());
  text << "}\n";
  return text.str();
}

}  // namespace lumivec
