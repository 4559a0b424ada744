#include "viewer/window/scene_patch.h"

namespace lumivec {
namespace {

template <class Value>
const Value& patched(const std::map<std::size_t, Value>& values, std::size_t index,
                     const Value& usual) {
  const auto found = values.find(index);
  return found == values.end() ? usual : found->second;
}

}  // namespace

const Material& ScenePatch::material(const Scene& scene, std::size_t index) const {
  return patched(materials, index, scene.materials[index]);
}
const Light& ScenePatch::light(const Scene& scene, std::size_t index) const {
  return patched(lights, index, scene.lights[index]);
}
const M44d& ScenePatch::place(const Scene& scene, std::size_t index) const {
  return patched(places, index, scene.instances[index].object_to_world);
}
const Environment& ScenePatch::sky(const Scene& scene) const {
  return environment ? *environment : scene.environment;
}

void apply_patch(const ScenePatch& patch, Scene& scene) {
  for (const auto& [index, value] : patch.materials) {
    if (index < scene.materials.size()) scene.materials[index] = value;
  }
  for (const auto& [index, value] : patch.lights) {
    if (index < scene.lights.size()) scene.lights[index] = value;
  }
  for (const auto& [index, value] : patch.places) {
    if (index < scene.instances.size()) scene.instances[index].object_to_world = value;
  }
  if (patch.environment) scene.environment = *patch.environment;
}

}  // namespace lumivec
