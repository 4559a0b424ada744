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

// World space, scene units; exact for spheres under any affine transform. Empty if the scene is.
Imath::Box3d world_bounds(const Scene& scene);

}  // namespace lumivec
