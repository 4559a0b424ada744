// What the user has changed of a scene, as values in place of the file's. It is as small as the
// changes are few, so that threads are given it by value and the scene itself is shared.
#pragma once

#include <map>
#include <optional>

#include "loader/scene.h"

namespace lumivec {

// Keys are indices into the scene's arrays.
struct ScenePatch {
  std::map<std::size_t, Material> materials;
  std::map<std::size_t, Light> lights;
  std::map<std::size_t, M44d> places;  // Instance::object_to_world
  std::optional<Environment> environment;

  bool empty() const {
    return materials.empty() && lights.empty() && places.empty() && !environment;
  }

  // The scene's own where nothing has been changed; index in range.
  const Material& material(const Scene& scene, std::size_t index) const;
  const Light& light(const Scene& scene, std::size_t index) const;
  const M44d& place(const Scene& scene, std::size_t index) const;
  const Environment& sky(const Scene& scene) const;
};

// scene: the one that the patch is of, or a copy. Indices beyond its arrays are passed over.
void apply_patch(const ScenePatch& patch, Scene& scene);

}  // namespace lumivec
