// A scene in numbers.
#pragma once

#include <ImathBox.h>

#include <cstddef>
#include <cstdint>

#include "loader/scene.h"

namespace lumivec {

struct SceneCounts {
  std::uint64_t triangles = 0;            // in meshes
  std::uint64_t triangles_instanced = 0;  // in the world: each mesh as often as it is placed
  std::uint64_t spheres = 0;              // exact spheres in the world
  std::uint64_t emissive_instances = 0;   // whose material emits
  std::uint64_t bytes_geometry = 0;
  std::uint64_t bytes_images = 0;
};

SceneCounts count_scene(const Scene& scene);

// What an animation changes of a scene.
struct AnimationCounts {
  std::uint64_t nodes = 0;      // whose transform it sets
  std::uint64_t instances = 0;  // that it carries along
  std::uint64_t meshes = 0;     // whose vertices it moves, by morph targets or joints
  std::uint64_t lights = 0;
  std::uint64_t cameras = 0;
};

// animation: one of the scene's.
AnimationCounts count_animation(const Scene& scene, const Animation& animation);

// World space, scene units; exact for spheres under any affine transform. Empty if the scene is.
Imath::Box3d world_bounds(const Scene& scene);

}  // namespace lumivec
