#include <algorithm>
#include <cmath>
#include <numbers>

#include "loader/pov/conversion.h"
#include "loader/pov/finiteness.h"
#include "loader/pov/surfaces.h"
#include "loader/transforms.h"

namespace lumivec::pov {
namespace {

constexpr double pi = std::numbers::pi;

// Looks along -Z.
M44d looking(const V3d& position, const V3d& direction) {
  const V3d z = -direction.normalized();
  const V3d helper = std::abs(z.y) < 0.9 ? V3d(0, 1, 0) : V3d(1, 0, 0);
  const V3d x = helper.cross(z).normalized(), y = z.cross(x);
  return {x.x, x.y, x.z, 0, y.x,        y.y,        y.z,        0,
          z.x, z.y, z.z, 0, position.x, position.y, position.z, 1};
}

// What is left of the light at a distance, by the language's formula.
double faded(const LightSource& light, double distance) {
  if (light.fade_power <= 0.0 || light.fade_distance <= 0.0) return 1.0;
  return 2.0 / (1.0 + std::pow(distance / light.fade_distance, light.fade_power));
}

void set_fading(const LightSource& light, Light& out) {
  const bool fades = light.fade_power > 0.0 && light.fade_distance > 0.0;
  out.fade_distance = fades ? static_cast<float>(light.fade_distance) : 1.0f;
  out.fade_power = fades ? static_cast<float>(light.fade_power) : 0.0f;
}

void set_spot(const LightSource& light, Light& out) {
  const auto angle = [](double degrees) {
    return static_cast<float>(std::clamp(degrees * pi / 180.0, 1e-3, pi / 2.0));
  };
  out.kind = LightKind::spot;
  out.outer_cone = angle(std::max(light.falloff, light.radius));
  out.inner_cone =
      std::clamp(static_cast<float>(light.radius * pi / 180.0), 0.0f, out.outer_cone * 0.999f);
  out.tightness = static_cast<float>(std::max(light.tightness, 0.0));
  out.smooth_edge = true;
}

void set_beam(const LightSource& light, Light& out) {
  out.kind = LightKind::beam;
  out.outer_radius = static_cast<float>(std::max(light.falloff, light.radius));
  out.inner_radius = static_cast<float>(std::clamp(light.radius, 0.0, light.falloff));
  out.tightness = static_cast<float>(std::max(light.tightness, 0.0));
  out.smooth_edge = true;
}

void set_area(const AreaLight& area, const M44d& to_world, Light& out) {
  V3d u, v;
  to_world.multDirMatrix(area.axis1 / 2.0, u);
  to_world.multDirMatrix(area.axis2 / 2.0, v);
  out.shadow_u = V3f(u);
  out.shadow_v = V3f(v);
  out.round_shadows = area.circular;
}

bool fits(const Light& light) {
  return fits_float(V3d(light.intensity)) && std::isfinite(light.fade_distance) &&
         std::isfinite(light.fade_power) && std::isfinite(light.tightness) &&
         std::isfinite(light.inner_radius) && std::isfinite(light.outer_radius) &&
         fits_float(V3d(light.shadow_u)) && fits_float(V3d(light.shadow_v));
}

}  // namespace

// POV-Ray's color of a lamp is what a white surface facing it shows: an illuminance of π times
// that, at any distance unless the lamp is told to fade. Area lights are lamps in the middle of
// their area whose shadows alone are soft.
void convert_light(Conversion& conversion, const LightSource& light, const M44d& transform,
                   const Place& place) {
  Parser& parser = conversion.parser;
  const V3d position = light.location * transform, target = light.point_at * transform;
  if (!fits_float(position) || !fits_float(target) || !is_finite(transform))
    parser.fail_at(place, "the position of a light is not finite or too large");
  if (light.area && (!fits_float(light.area->axis1) || !fits_float(light.area->axis2)))
    parser.fail_at(place, "the area of a light is not finite or too large");
  if (light.projected_through) parser.mention(place, "projected_through is left out");
  if (light.looks_like) {
    convert_lamp_object(conversion, *light.looks_like,
                        M44d().setTranslation(light.location) * transform);
  }
  Light out;
  V3d direction = target - position;
  const bool aimed = light.parallel || light.shape != LightShape::point;
  if (!aimed || direction.length() == 0.0) direction = conversion.focus - position;
  V3d world_direction;
  conversion.to_world.multDirMatrix(direction, world_direction);
  if (world_direction.length() == 0.0) world_direction = V3d(0, -1, 0);
  out.object_to_world = looking(position * conversion.to_world, world_direction);
  out.casts_shadows = !light.shadowless;
  out.intensity = linear_color(light.color.red, light.color.green, light.color.blue,
                               conversion.scene.settings.assumed_gamma) *
                  static_cast<float>(pi);
  set_fading(light, out);
  if (light.shape == LightShape::cylinder) {
    set_beam(light, out);
  } else if (light.parallel) {
    out.kind = LightKind::directional;
    out.intensity *= static_cast<float>(faded(light, (conversion.focus - position).length()));
    if (light.shape != LightShape::point)
      parser.mention(place, "a spotlight that is parallel shines everywhere");
  } else {
    if (light.shape == LightShape::spotlight) set_spot(light, out);
    if (light.area) {
      set_area(*light.area, transform * conversion.to_world, out);
      if (light.area->orient && light.area->circular)
        parser.mention(place, "orient is left out: the area of a light looks the way it is given");
    }
  }
  if (!fits(out))
    parser.fail_at(place, "the brightness or size of a light is not finite or too large");
  conversion.out.lights.push_back(out);
}

}  // namespace lumivec::pov
