#include <algorithm>
#include <cmath>
#include <numbers>

#include "loader/pov/conversion.h"
#include "loader/pov/finiteness.h"
#include "loader/pov/pattern_values.h"
#include "loader/pov/surfaces.h"

namespace lumivec::pov {
namespace {

constexpr int sky_width = 512;
constexpr int sky_height = 256;

// Layers of pigments, the last on top; each lets through what it filters and transmits.
Color sky_color(const SkySphere& sky, const V3d& direction, double gamma, bool& approximate) {
  Color seen(0.0f);
  for (const Pigment& pigment : sky.pigments) {
    const ColorFT c = pigment_color(pigment, direction, approximate);
    const Color color = linear_color(c.red, c.green, c.blue, gamma);
    const auto through = static_cast<float>(std::clamp(c.filter + c.transmit, 0.0, 1.0));
    seen = color * (1.0f - through) + seen * through;
  }
  return seen * static_cast<float>(sky.emission);
}

}  // namespace

void convert_sky(Conversion& conversion) {
  const PovScene& scene = conversion.scene;
  const double gamma = scene.settings.assumed_gamma;
  Environment& environment = conversion.out.environment;
  if (!scene.sky_sphere || scene.sky_sphere->pigments.empty()) {
    if (scene.background) {
      const ColorFT& c = *scene.background;
      environment.radiance = linear_color(c.red, c.green, c.blue, gamma);
      if (!fits_float(V3d(environment.radiance)))
        conversion.parser.fail("the background's color is not finite or too large");
    }
    return;
  }
  const SkySphere& sky = *scene.sky_sphere;
  M44d inverse;
  for (const PatternStep& step : sky.steps) inverse = inverse * step.transform;
  inverse = inverse.inverse();
  Image image;
  image.name = "sky_sphere";
  image.width = sky_width;
  image.height = sky_height;
  conversion.parser.claim(std::uint64_t{16} * sky_width * sky_height);
  image.rgba32f.reserve(std::size_t{4} * sky_width * sky_height);
  bool approximate = false;
  for (int y = 0; y < sky_height; ++y) {
    const double theta = std::numbers::pi * (y + 0.5) / sky_height;
    for (int x = 0; x < sky_width; ++x) {
      const double phi = 2.0 * std::numbers::pi * ((x + 0.5) / sky_width - 0.5);
      const V3d world(std::sin(theta) * std::sin(phi), std::cos(theta),
                      -std::sin(theta) * std::cos(phi));
      V3d direction, own;
      conversion.to_world.inverse().multDirMatrix(world, direction);
      inverse.multDirMatrix(direction, own);
      const Color c = sky_color(sky, own.normalized(), gamma, approximate);
      if (std::isnan(c.x + c.y + c.z))
        conversion.parser.fail_at(sky.place, "a color of the sky sphere is not finite");
      for (const float channel : {c.x, c.y, c.z, 1.0f})
        image.rgba32f.push_back(std::min(channel, 65504.0f));
    }
  }
  if (approximate)
    conversion.parser.mention(sky.place, "a pattern of the sky sphere became its average color");
  environment.image = static_cast<int>(conversion.out.images.size());
  environment.radiance = Color(1.0f);
  conversion.out.images.push_back(std::move(image));
}

}  // namespace lumivec::pov
