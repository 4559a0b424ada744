#include "viewer/scene_summary.h"

namespace lumivec {
namespace {

template <typename Value>
std::uint64_t bytes_of(const std::vector<Value>& values) {
  return values.size() * sizeof(Value);
}

std::uint64_t bytes_of_mesh(const Mesh& mesh) {
  std::uint64_t bytes = bytes_of(mesh.positions) + bytes_of(mesh.normals) +
                        bytes_of(mesh.tangents) + bytes_of(mesh.colors) + bytes_of(mesh.triangles);
  for (const std::vector<V2f>& uvs : mesh.uvs) bytes += bytes_of(uvs);
  return bytes;
}

bool is_emissive(const Scene& scene, const Instance& instance) {
  if (instance.material < 0) return false;
  const Color& emission = scene.materials[std::size_t(instance.material)].emission;
  return emission.x > 0.0f || emission.y > 0.0f || emission.z > 0.0f;
}

}  // namespace

SceneCounts count_scene(const Scene& scene) {
  SceneCounts counts;
  for (const Mesh& mesh : scene.meshes) {
    counts.triangles += mesh.triangles.size();
    counts.bytes_geometry += bytes_of_mesh(mesh);
  }
  for (const Instance& instance : scene.instances) {
    if (instance.mesh >= 0) {
      counts.triangles_instanced += scene.meshes[std::size_t(instance.mesh)].triangles.size();
    }
    counts.spheres += instance.sphere >= 0;
    counts.emissive_instances += is_emissive(scene, instance);
  }
  counts.bytes_geometry += bytes_of(scene.instances) + bytes_of(scene.nodes);
  for (const Image& image : scene.images) {
    counts.bytes_images += bytes_of(image.rgba8) + bytes_of(image.rgba32f);
  }
  return counts;
}

Imath::Box3d world_bounds(const Scene& scene) {
  Imath::Box3d bounds;
  for (const Instance& instance : scene.instances) {
    const M44d& m = instance.object_to_world;
    if (instance.sphere >= 0) {
      // The support of an ellipsoid along a world axis is the length of the matching column of its
      // matrix.
      const double radius = scene.spheres[std::size_t(instance.sphere)].radius;
      const V3d centre(m[3][0], m[3][1], m[3][2]);
      V3d reach;
      for (int axis = 0; axis < 3; ++axis) {
        reach[axis] = radius * V3d(m[0][axis], m[1][axis], m[2][axis]).length();
      }
      bounds.extendBy(centre - reach);
      bounds.extendBy(centre + reach);
    }
    if (instance.mesh < 0) continue;
    for (const V3f& p : scene.meshes[std::size_t(instance.mesh)].positions) {
      V3d world;
      m.multVecMatrix(V3d(p), world);
      bounds.extendBy(world);
    }
  }
  return bounds;
}

}  // namespace lumivec
