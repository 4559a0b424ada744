#include "loader/animate.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <map>

#include "loader/deform.h"
#include "loader/keyframes.h"
#include "loader/placement.h"
#include "loader/to_float.h"
#include "loader/transforms.h"

namespace lumivec {
namespace {

using Flags = std::vector<std::uint8_t>;

// Puts b in the place of a. Was there any difference? By bits, so that what is not finite compares
// equal to itself.
bool replace(M44d& a, const M44d& b) {
  bool differs = false;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      differs |= std::bit_cast<std::uint64_t>(a[i][j]) != std::bit_cast<std::uint64_t>(b[i][j]);
    }
  }
  a = b;
  return differs;
}

template <class Visit>
void for_each_channel(const Scene& scene, std::span<const PlayedAnimation> played,
                      const Visit& visit) {
  for (const PlayedAnimation& p : played) {
    for (const AnimationChannel& channel : scene.animations[p.animation].channels) {
      visit(channel, p.seconds);
    }
  }
}

void set(const AnimationChannel& channel, double seconds, RestTransform& transform) {
  const std::vector<double> v = value_at(channel, seconds);
  switch (channel.target) {
    case AnimationTarget::translation:
      transform.translation = V3d(v[0], v[1], v[2]);
      break;
    case AnimationTarget::rotation:
      transform.rotation = V4d(v[0], v[1], v[2], v[3]);
      break;
    case AnimationTarget::scale:
      transform.scale = V3d(v[0], v[1], v[2]);
      break;
    case AnimationTarget::weights:
      break;
  }
}

// Which nodes have another world transform than before?
Flags pose_nodes(Scene& scene, std::span<const PlayedAnimation> played) {
  std::vector<RestTransform> transforms = scene.motion.rest;
  for_each_channel(scene, played, [&](const AnimationChannel& channel, double seconds) {
    if (channel.target == AnimationTarget::weights) return;
    const auto it =
        std::lower_bound(transforms.begin(), transforms.end(), channel.node,
                         [](const RestTransform& t, int node) { return t.node < node; });
    if (it != transforms.end() && it->node == channel.node) set(channel, seconds, *it);
  });
  for (const RestTransform& t : transforms) {
    scene.nodes[static_cast<std::size_t>(t.node)].local_to_parent =
        compose(t.translation, t.rotation, t.scale);
  }
  Flags moved(scene.nodes.size(), 0);
  for (const int i : scene.motion.nodes) {
    Node& node = scene.nodes[static_cast<std::size_t>(i)];
    moved[static_cast<std::size_t>(i)] =
        replace(node.local_to_world, world_transform(node, scene.nodes));
  }
  return moved;
}

using WeightsByNode = std::map<int, std::vector<double>>;

// The morph weights that are animated.
WeightsByNode played_weights(const Scene& scene, std::span<const PlayedAnimation> played) {
  WeightsByNode weights;
  for_each_channel(scene, played, [&](const AnimationChannel& channel, double seconds) {
    if (channel.target != AnimationTarget::weights) return;
    weights[channel.node] = value_at(channel, seconds);
  });
  return weights;
}

// The weights of a deformation's targets in this pose.
std::vector<float> pose_weights(const Deformation& deformation, const WeightsByNode& played) {
  std::vector<float> weights = deformation.rest_weights;
  const auto it = played.find(deformation.weights_node);
  if (it == played.end()) return weights;
  const std::size_t count = std::min(it->second.size(), weights.size());
  for (std::size_t i = 0; i < count; ++i) weights[i] = to_float(it->second[i]);
  return weights;
}

// Which deformations have other vertices than before? Joints are worked out once for all meshes
// that hang on them.
Flags pose_meshes(Scene& scene, std::span<const PlayedAnimation> played, const Flags& moved) {
  Motion& motion = scene.motion;
  std::vector<std::vector<M44d>> joints(motion.skins.size());  // empty: not needed yet
  const auto joints_moved = [&](int skin) {
    const auto& nodes = motion.skins[static_cast<std::size_t>(skin)].joints;
    return std::any_of(nodes.begin(), nodes.end(),
                       [&](int node) { return moved[static_cast<std::size_t>(node)] != 0; });
  };
  const WeightsByNode animated_weights = played_weights(scene, played);
  Flags changed(motion.deformations.size(), 0);
  for (std::size_t i = 0; i < changed.size(); ++i) {
    Deformation& deformation = motion.deformations[i];
    std::vector<float> weights = pose_weights(deformation, animated_weights);
    const bool skinned = deformation.skin >= 0;
    if (weights == deformation.weights && !(skinned && joints_moved(deformation.skin))) continue;
    changed[i] = 1;
    deformation.weights = std::move(weights);
    Mesh& mesh = scene.meshes[static_cast<std::size_t>(deformation.mesh)];
    if (!skinned) {
      deform({}, deformation, mesh);
      continue;
    }
    const auto skin = static_cast<std::size_t>(deformation.skin);
    if (joints[skin].empty()) joints[skin] = joint_matrices(motion.skins[skin], scene.nodes);
    deform(joints[skin], deformation, mesh);
  }
  return changed;
}

// Has the instance another transform or visibility than before?
bool place(const Scene& scene, const MovingInstance& moving, Instance& instance) {
  M44d object_to_world = moving.object_to_node;
  if (moving.node >= 0) {
    object_to_world *= scene.nodes[static_cast<std::size_t>(moving.node)].local_to_world;
  }
  const Imath::Box3d& bounds =
      moving.deformation >= 0
          ? scene.motion.deformations[static_cast<std::size_t>(moving.deformation)].bounds
          : moving.bounds;
  const bool visible = placement(bounds, object_to_world) == Placement::shown;
  const bool turned_up = visible != instance.visible;
  instance.visible = visible;
  return replace(instance.object_to_world, visible ? object_to_world : M44d()) || turned_up;
}

}  // namespace

bool PoseChanges::empty() const {
  return instances.empty() && meshes.empty() && lights.empty() && cameras.empty();
}

PoseChanges pose_scene(Scene& scene, std::size_t animation, double seconds) {
  const PlayedAnimation played{animation, seconds};
  return pose_scene(scene, std::span(&played, 1));
}

PoseChanges pose_scene(Scene& scene, std::span<const PlayedAnimation> played) {
  for (const PlayedAnimation& p : played) static_cast<void>(scene.animations.at(p.animation));
  PoseChanges changes;
  const Flags moved = pose_nodes(scene, played);
  const Flags deformed = pose_meshes(scene, played, moved);
  for (std::size_t i = 0; i < deformed.size(); ++i) {
    if (deformed[i]) changes.meshes.push_back(scene.motion.deformations[i].mesh);
  }
  std::sort(changes.meshes.begin(), changes.meshes.end());
  for (const MovingInstance& moving : scene.motion.instances) {
    const bool carried = moving.node >= 0 && moved[static_cast<std::size_t>(moving.node)];
    const bool reshaped =
        moving.deformation >= 0 && deformed[static_cast<std::size_t>(moving.deformation)];
    if (!carried && !reshaped) continue;
    Instance& instance = scene.instances[static_cast<std::size_t>(moving.instance)];
    if (place(scene, moving, instance)) changes.instances.push_back(moving.instance);
  }
  const auto carry = [&](int node, M44d& frame) {
    if (node < 0 || !moved[static_cast<std::size_t>(node)]) return false;
    return replace(frame,
                   standing_frame(scene.nodes[static_cast<std::size_t>(node)].local_to_world));
  };
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    Light& light = scene.lights[i];
    if (carry(light.node, light.object_to_world)) changes.lights.push_back(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < scene.cameras.size(); ++i) {
    Camera& camera = scene.cameras[i];
    if (carry(camera.node, camera.camera_to_world)) changes.cameras.push_back(static_cast<int>(i));
  }
  return changes;
}

double animation_length(const Animation& animation) {
  double seconds = 0.0;
  for (const AnimationChannel& channel : animation.channels) {
    if (!channel.times.empty()) seconds = std::max(seconds, double(channel.times.back()));
  }
  return seconds;
}

}  // namespace lumivec
