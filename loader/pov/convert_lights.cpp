#include <algorithm>
#include <cmath>
#include <numbers>

#include "loader/placement.h"
#include "loader/pov/bounds.h"
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

// A rectangle or ellipse that shines to both sides, or along the direction if that has a length.
// Then it stands a little before its place, where scenes have the lamp's case.
void add_area_lamp(Conversion& conversion, const AreaLight& area, V3d position,
                   const V3d& direction, const M44d& transform, const Color& intensity,
                   const Place& place) {
  V3d u, v;
  transform.multDirMatrix(area.axis1 / 2.0, u);
  transform.multDirMatrix(area.axis2 / 2.0, v);
  if (u.cross(v).dot(direction) < 0.0) std::swap(u, v);
  constexpr double step = 0.02;  // of its size
  if (direction.length() > 0.0)
    position += direction.normalized() * (step * std::max(u.length(), v.length()));
  if (!fits_float(position) || !fits_float(u) || !fits_float(v))
    conversion.parser.fail_at(place, "the area of a light is not finite or too large");
  Mesh mesh;
  mesh.positions.emplace_back(position);
  const int corners = area.circular ? 64 : 4;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * pi * (i + (area.circular ? 0.0 : 0.5)) / corners;
    const double size = area.circular ? 1.0 : std::sqrt(2.0);
    mesh.positions.emplace_back(position + u * (size * std::cos(angle)) +
                                v * (size * std::sin(angle)));
    const auto k = static_cast<std::uint32_t>(i);
    mesh.triangles.push_back({0, k + 1, (k + 1) % static_cast<std::uint32_t>(corners) + 1});
  }
  const double surface = 4.0 * u.cross(v).length() * (area.circular ? pi / 4.0 : 1.0);
  Material material;
  material.name = "area light";
  material.base_color = Color(0.0f);
  material.specular = 0.0f;
  material.double_sided = direction.length() == 0.0;
  material.emission = intensity * static_cast<float>(1.0 / surface);
  Instance instance;
  instance.mesh = static_cast<int>(conversion.out.meshes.size());
  instance.material = static_cast<int>(conversion.out.materials.size());
  instance.object_to_world = conversion.to_world;
  conversion.out.meshes.push_back(std::move(mesh));
  conversion.out.materials.push_back(std::move(material));
  conversion.out.instances.push_back(std::move(instance));
}

bool has_area(const AreaLight& area) {
  return area.axis1.cross(area.axis2).length() > 0.0;
}

}  // namespace

// POV-Ray's color of a lamp is what a white surface facing it shows: an illuminance of π times
// that. Its lamps do not fade unless they are told to; those of a Scene always do, with the square.
// They agree at what the camera looks at.
void convert_light(Conversion& conversion, const LightSource& light, const M44d& transform,
                   const Place& place) {
  Parser& parser = conversion.parser;
  const V3d position = light.location * transform, target = light.point_at * transform;
  if (!fits_float(position) || !fits_float(target) || !is_finite(transform))
    parser.fail_at(place, "the position of a light is not finite or too large");
  if (light.area && (!fits_float(light.area->axis1) || !fits_float(light.area->axis2)))
    parser.fail_at(place, "the area of a light is not finite or too large");
  const double distance = std::max((conversion.focus - position).length(), 1e-6);
  const Color color = linear_color(light.color.red, light.color.green, light.color.blue,
                                   conversion.scene.settings.assumed_gamma);
  const Color illuminance = color * static_cast<float>(pi * faded(light, distance));
  const Color intensity = illuminance * static_cast<float>(distance * distance);
  if (!fits_float(V3d(intensity)))
    parser.fail_at(place, "the brightness of a light is not finite or too large");
  if (light.shadowless) parser.mention(place, "a shadowless light casts shadows");
  if (light.projected_through) parser.mention(place, "projected_through is left out");
  constexpr double fading_square = 2.0;
  constexpr double far_away = 20.0;  // times the scene's extent: then it reaches all alike
  const bool is_far = distance > far_away * conversion.extent;
  if (light.looks_like && !is_far) {
    const Imath::Box3d box = bounds_of(*light.looks_like);
    const V3d size = box.isEmpty() ? V3d(0.0) : box.size();
    const double shadow = pi / 4.0 * (size.x * size.y + size.y * size.z + size.z * size.x) / 3.0;
    if (shadow > 0.0) {
      return convert_lamp_object(conversion, *light.looks_like,
                                 M44d().setTranslation(light.location) * transform,
                                 intensity * static_cast<float>(1.0 / shadow));
    }
  }
  if (light.area && !light.parallel && has_area(*light.area) && !is_far) {
    V3d direction(0.0);
    if (light.shape != LightShape::point) {
      parser.mention(place, "an area light that is a spotlight shines to all of its front");
      direction = target - position;
    }
    return add_area_lamp(conversion, *light.area, position, direction, transform, intensity, place);
  }
  Light out;
  V3d direction = target - position;
  const bool aimed = light.parallel || light.shape != LightShape::point;
  if (!aimed || direction.length() == 0.0) direction = conversion.focus - position;
  V3d world_direction;
  conversion.to_world.multDirMatrix(direction, world_direction);
  if (world_direction.length() == 0.0) world_direction = V3d(0, -1, 0);
  out.object_to_world = looking(position * conversion.to_world, world_direction);
  out.intensity = intensity;
  if (light.parallel || (is_far && light.shape == LightShape::point)) {
    out.kind = LightKind::directional;
    out.intensity = illuminance;
  } else if (light.shape != LightShape::point) {
    out.kind = LightKind::spot;
    const bool beam = light.shape == LightShape::cylinder;
    if (light.tightness > 0.0) parser.mention(place, "the tightness of a spotlight is left out");
    if (beam) parser.mention(place, "a cylinder light is taken for a spotlight");
    const auto angle = [&](double given) {
      const double radians = beam ? std::atan(given / distance) : given * pi / 180.0;
      return static_cast<float>(std::clamp(radians, 1e-3, pi / 2.0));
    };
    out.outer_cone = angle(std::max(light.falloff, light.radius));
    out.inner_cone = std::min(angle(light.radius), out.outer_cone * 0.999f);
  }
  if (out.kind != LightKind::directional && light.fade_power != fading_square) {
    parser.mention(place,
                   "a light fades with the square of the distance; it is as bright as it should be "
                   "at what the camera looks at");
  }
  conversion.out.lights.push_back(out);
}

}  // namespace lumivec::pov
