#include "loader/gltf/lights.h"

#include <algorithm>
#include <numbers>
#include <optional>

#include "loader/gltf/extensions.h"
#include "loader/placement.h"
#include "loader/transforms.h"

namespace lumivec::gltf {
namespace {

constexpr double brightest = 1e20;  // cd or lx: products with other factors stay finite

std::optional<LightKind> kind_of(const std::string& type) {
  if (type == "point") return LightKind::point;
  if (type == "spot") return LightKind::spot;
  if (type == "directional") return LightKind::directional;
  return std::nullopt;
}

void set_cone(Context& context, const std::string& where, const tinygltf::SpotLight& spot,
              Light& light) {
  constexpr double half_pi = std::numbers::pi / 2.0;
  double inner = spot.innerConeAngle;
  double outer = spot.outerConeAngle;
  if (!(outer > 0.0 && outer <= half_pi + 1e-6 && inner >= 0.0 && inner < outer)) {
    context.warn(where, "cone angles are out of range and clamped");
    constexpr double narrowest = 1e-3;  // radians
    outer = std::clamp(outer, narrowest, half_pi);
    inner = std::clamp(inner, 0.0, outer);
  }
  light.outer_cone = to_float(std::min(outer, half_pi));
  // The contract wants a soft edge, however thin.
  light.inner_cone = std::min(to_float(inner), light.outer_cone * (1.0f - 1e-6f));
}

}  // namespace

void read_lights(Context& context, const tinygltf::Model& model, const std::vector<int>& nodes,
                 const std::vector<bool>& moving, Scene& scene) {
  for (const int index : nodes) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
    const auto* extension = find_extension(node.extensions, "KHR_lights_punctual");
    const int number = extension ? index_or(*extension, "light", -1) : -1;
    if (number < 0) continue;
    const tinygltf::Light& source = model.lights[static_cast<std::size_t>(number)];
    const std::string where =
        pointer({"extensions", "KHR_lights_punctual", "lights", static_cast<std::size_t>(number)});
    const auto kind = kind_of(source.type);
    const M44d& world = scene.nodes[static_cast<std::size_t>(index)].local_to_world;
    const bool stands = moving[static_cast<std::size_t>(index)] || rigid_part(world) ||
                        (kind == LightKind::point && is_finite(world));
    if (!kind || !stands) {
      context.warn(where, "has an unknown type or no direction and is left out");
      continue;
    }
    Light light;
    light.name = source.name.empty() ? node.name : source.name;
    light.kind = *kind;
    light.node = index;
    light.object_to_world = standing_frame(world);
    bool clamped = false;
    for (std::size_t i = 0; i < 3; ++i) {
      const double color = source.color.size() == 3 ? source.color[i] : 1.0;
      const double intensity = color * source.intensity;
      clamped |= !(intensity >= 0.0 && intensity <= brightest);
      light.intensity[static_cast<int>(i)] = to_float(std::clamp(intensity, 0.0, brightest));
    }
    if (clamped) context.warn(where, "intensity is out of range and clamped");
    if (source.range > 0.0) light.range = to_float(source.range);
    if (*kind == LightKind::spot) set_cone(context, where, source.spot, light);
    scene.lights.push_back(light);
  }
}

}  // namespace lumivec::gltf
