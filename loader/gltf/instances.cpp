#include "loader/gltf/instances.h"

#include <ImathBoxAlgo.h>

#include <algorithm>

#include "loader/deform.h"
#include "loader/gltf/extensions.h"
#include "loader/placement.h"
#include "loader/transforms.h"

namespace lumivec::gltf {
namespace {

// For each node, does an animation set its morph weights?
std::vector<bool> nodes_with_animated_weights(const Scene& scene) {
  std::vector<bool> nodes(scene.nodes.size());
  for (const Animation& animation : scene.animations) {
    for (const AnimationChannel& channel : animation.channels) {
      if (channel.target != AnimationTarget::weights) continue;
      nodes[static_cast<std::size_t>(channel.node)] = true;
    }
  }
  return nodes;
}

class InstanceReader {
 public:
  InstanceReader(Context& context, const Document& document, Accessors& accessors,
                 const std::vector<bool>& moving, Scene& scene)
      : context_(context),
        document_(document),
        accessors_(accessors),
        moving_(moving),
        scene_(scene),
        materials_(context, document, scene),
        meshes_(context, document, accessors, scene),
        animated_weights_(nodes_with_animated_weights(scene)),
        skins_(document.model.skins.size()) {}

  void read(int index) {
    const tinygltf::Node& node = document_.model.nodes[static_cast<std::size_t>(index)];
    if (node.mesh < 0) return;
    const std::string where = pointer({"nodes", static_cast<std::size_t>(index)});
    const auto mesh = static_cast<std::size_t>(node.mesh);
    const auto& primitives = document_.model.meshes[mesh].primitives;
    const std::vector<M44d> transforms = instance_transforms(context_, accessors_, node, where);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const Pose pose = pose_of(index, primitives[i], where);
      const int material = materials_.use(primitives[i].material);
      const Shape shape = meshes_.shape(mesh, i, material, pose);
      if (shape.mesh < 0 && shape.sphere < 0) continue;
      // A skin places its vertices in the world itself.
      place(index, shape, material, pose.posed_skin ? -1 : index, transforms, where);
    }
  }

  const Imath::Box3d& bounds() const { return bounds_; }

 private:
  Pose pose_of(int index, const tinygltf::Primitive& primitive, const std::string& where) {
    Pose pose;
    const tinygltf::Node& node = document_.model.nodes[static_cast<std::size_t>(index)];
    const auto& mesh = document_.model.meshes[static_cast<std::size_t>(node.mesh)];
    const auto& weights = node.weights.empty() ? mesh.weights : node.weights;
    const bool animated = animated_weights_[static_cast<std::size_t>(index)];
    const bool moves =
        animated || std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0.0; });
    if (moves && !primitive.targets.empty()) {
      for (const double w : weights) pose.weights.push_back(to_float(w));
      pose.weights.resize(primitive.targets.size());
      if (animated) pose.weights_node = index;
    }
    if (node.skin < 0) return pose;
    if (!primitive.attributes.contains("JOINTS_0") || !primitive.attributes.contains("WEIGHTS_0")) {
      context_.warn(where, "has a skin, but its mesh has no joints and weights");
      return pose;
    }
    pose.skin = node.skin;
    PosedSkin& skin = posed_skin(static_cast<std::size_t>(node.skin));
    pose.posed_skin = &skin;
    if (pose.is_animated() && skin.kept < 0) {
      skin.kept = static_cast<int>(scene_.motion.skins.size());
      scene_.motion.skins.push_back(skin.skin);
    }
    return pose;
  }

  PosedSkin& posed_skin(std::size_t index) {
    auto& posed = skins_[index];
    if (posed) return *posed;
    const std::string where = pointer({"skins", index});
    posed.emplace();
    posed->skin = read_skin(context_, accessors_, document_.model.skins[index], where);
    posed->joints = joint_matrices(posed->skin, scene_.nodes);
    for (std::size_t i = 0; i < posed->joints.size(); ++i) {
      if (!is_finite(posed->joints[i])) {
        context_.fail(where, "joint " + std::to_string(i) + " has no finite transform");
      }
      posed->moves |= moving_[static_cast<std::size_t>(posed->skin.joints[i])];
    }
    return *posed;
  }

  // under: the node that the instance hangs on, or -1 for one that joints place in the world.
  void place(int index, const Shape& shape, int material, int under,
             const std::vector<M44d>& transforms, const std::string& where) {
    const Node& node = scene_.nodes[static_cast<std::size_t>(index)];
    const M44d world = under < 0 ? M44d() : node.local_to_world;
    const bool moves =
        shape.deformation >= 0 || (under >= 0 && moving_[static_cast<std::size_t>(under)]);
    context_.claim(
        transforms.size(),
        sizeof(Instance) + node.name.size() + (moves ? sizeof(MovingInstance) : std::size_t{0}),
        where);
    std::size_t flattened = 0;
    std::size_t far_away = 0;
    for (const M44d& transform : transforms) {
      const M44d object_to_world = transform * world;
      const Placement how = placement(shape.bounds, object_to_world);
      const bool visible = how == Placement::shown;
      if (visible) bounds_.extendBy(Imath::affineTransform(shape.bounds, object_to_world));
      if (!visible && !moves) {
        ++(how == Placement::flattened ? flattened : far_away);
        continue;
      }
      const int instance = static_cast<int>(scene_.instances.size());
      scene_.instances.push_back({node.name, shape.mesh, shape.sphere, material, index,
                                  visible ? object_to_world : M44d(), visible});
      if (!moves) continue;
      scene_.motion.instances.push_back({instance, under, under < 0 ? object_to_world : transform,
                                         shape.deformation, shape.bounds});
    }
    if (flattened > 0) {
      context_.warn(where, "scales to nothing in some direction and is left out");
    }
    if (far_away > 0) context_.warn(where, "lies too far from the origin and is left out");
  }

  Context& context_;
  const Document& document_;
  Accessors& accessors_;
  const std::vector<bool>& moving_;
  Scene& scene_;
  Materials materials_;
  Meshes meshes_;
  std::vector<bool> animated_weights_;           // by node
  std::vector<std::optional<PosedSkin>> skins_;  // by index, those that are used
  Imath::Box3d bounds_;
};

}  // namespace

Imath::Box3d read_instances(Context& context, const Document& document, Accessors& accessors,
                            const std::vector<int>& nodes, const std::vector<bool>& moving,
                            Scene& scene) {
  InstanceReader reader(context, document, accessors, moving, scene);
  for (const int node : nodes) reader.read(node);
  return reader.bounds();
}

}  // namespace lumivec::gltf
