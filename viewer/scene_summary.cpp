#include "viewer/scene_summary.h"

#include <algorithm>

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

// What posing the scene takes.
std::uint64_t bytes_of_motion(const Motion& motion) {
  std::uint64_t bytes = bytes_of(motion.nodes) + bytes_of(motion.rest) + bytes_of(motion.instances);
  for (const Skin& skin : motion.skins)
    bytes += bytes_of(skin.joints) + bytes_of(skin.inverse_binds);
  for (const Deformation& d : motion.deformations) {
    bytes += bytes_of(d.positions) + bytes_of(d.normals) + bytes_of(d.tangents);
    for (const MorphTarget& t : d.targets) {
      bytes += bytes_of(t.positions) + bytes_of(t.normals) + bytes_of(t.tangents);
    }
    for (const JointSet& set : d.joint_sets) bytes += bytes_of(set.joints) + bytes_of(set.weights);
  }
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
  counts.bytes_geometry +=
      bytes_of(scene.instances) + bytes_of(scene.nodes) + bytes_of_motion(scene.motion);
  for (const Image& image : scene.images) {
    counts.bytes_images += bytes_of(image.rgba8) + bytes_of(image.rgba32f);
  }
  return counts;
}

AnimationCounts count_animation(const Scene& scene, const Animation& animation) {
  AnimationCounts counts;
  std::vector<bool> moved(scene.nodes.size());
  std::vector<bool> morphed(scene.nodes.size());
  for (const AnimationChannel& channel : animation.channels) {
    const auto node = std::size_t(channel.node);
    if (channel.target == AnimationTarget::weights) {
      morphed[node] = true;
    } else {
      counts.nodes += !moved[node];
      moved[node] = true;
    }
  }
  for (const int node : scene.motion.nodes) {  // parents come first
    const int parent = scene.nodes[std::size_t(node)].parent;
    if (parent >= 0 && moved[std::size_t(parent)]) moved[std::size_t(node)] = true;
  }
  const auto moves = [&](int node) { return node >= 0 && moved[std::size_t(node)]; };
  const auto carried = [&](const auto& item) { return moves(item.node); };
  const auto deformed = [&](const Deformation& d) {
    if (d.weights_node >= 0 && morphed[std::size_t(d.weights_node)]) return true;
    if (d.skin < 0) return false;
    const std::vector<int>& joints = scene.motion.skins[std::size_t(d.skin)].joints;
    return std::any_of(joints.begin(), joints.end(), moves);
  };
  const auto count = [](const auto& items, const auto& is) {
    return std::uint64_t(std::count_if(items.begin(), items.end(), is));
  };
  counts.instances = count(scene.motion.instances, carried);
  counts.meshes = count(scene.motion.deformations, deformed);
  counts.lights = count(scene.lights, carried);
  counts.cameras = count(scene.cameras, carried);
  return counts;
}

Imath::Box3d world_bounds(const Scene& scene) {
  Imath::Box3d bounds;
  for (const Instance& instance : scene.instances) {
    if (!instance.visible) continue;
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
    if (instance.solid >= 0) {
      const Imath::Box3d& box = scene.solids[std::size_t(instance.solid)].bounds;
      for (int corner = 0; corner < 8; ++corner) {
        bounds.extendBy(V3d(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                            corner & 4 ? box.max.z : box.min.z) *
                        m);
      }
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
