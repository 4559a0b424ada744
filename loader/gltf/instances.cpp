#include "loader/gltf/instances.h"

#include <ImathBoxAlgo.h>

#include <algorithm>
#include <cmath>

#include "loader/gltf/extensions.h"
#include "loader/transforms.h"

namespace lumivec::gltf {
namespace {

// Squares of coordinates must stay finite in float, in ray tracing kernels too: Embree ignores what
// lies farther out.
constexpr double farthest = 1e18;

class InstanceReader {
 public:
  InstanceReader(Context& context, const Document& document, Accessors& accessors,
                 const NodeTree& tree, Scene& scene)
      : context_(context),
        document_(document),
        accessors_(accessors),
        tree_(tree),
        scene_(scene),
        materials_(context, document, scene),
        meshes_(context, document, accessors, scene),
        joints_(document.model.skins.size()) {}

  void read(int index) {
    const tinygltf::Node& node = document_.model.nodes[static_cast<std::size_t>(index)];
    if (node.mesh < 0) return;
    const std::string where = pointer({"nodes", static_cast<std::size_t>(index)});
    const auto mesh = static_cast<std::size_t>(node.mesh);
    const auto& primitives = document_.model.meshes[mesh].primitives;
    const std::vector<M44d> transforms = instance_transforms(context_, accessors_, node, where);
    for (std::size_t i = 0; i < primitives.size(); ++i) {
      const Pose pose = pose_of(node, primitives[i], where);
      const int material = materials_.use(primitives[i].material);
      const Shape shape = meshes_.shape(mesh, i, material, pose);
      if (shape.mesh < 0 && shape.sphere < 0) continue;
      // A skin places its vertices in the world itself.
      const M44d world =
          pose.joint_matrices ? M44d() : tree_.worlds[static_cast<std::size_t>(index)];
      place(index, shape, material, world, transforms, where);
    }
  }

  const Imath::Box3d& bounds() const { return bounds_; }

 private:
  Pose pose_of(const tinygltf::Node& node, const tinygltf::Primitive& primitive,
               const std::string& where) {
    Pose pose;
    const auto& mesh = document_.model.meshes[static_cast<std::size_t>(node.mesh)];
    const auto& weights = node.weights.empty() ? mesh.weights : node.weights;
    const bool moves =
        std::any_of(weights.begin(), weights.end(), [](double w) { return w != 0.0; });
    if (moves && !primitive.targets.empty()) {
      for (const double w : weights) pose.weights.push_back(to_float(w));
      pose.weights.resize(primitive.targets.size());
    }
    if (node.skin < 0) return pose;
    if (!primitive.attributes.contains("JOINTS_0") || !primitive.attributes.contains("WEIGHTS_0")) {
      context_.warn(where, "has a skin, but its mesh has no joints and weights");
      return pose;
    }
    pose.skin = node.skin;
    auto& joints = joints_[static_cast<std::size_t>(node.skin)];
    if (!joints) {
      joints = std::make_shared<const std::vector<M44d>>(joint_matrices(
          context_, accessors_, document_.model.skins[static_cast<std::size_t>(node.skin)],
          pointer({"skins", static_cast<std::size_t>(node.skin)}), tree_.worlds));
    }
    pose.joint_matrices = joints;
    return pose;
  }

  void place(int node, const Shape& shape, int material, const M44d& world,
             const std::vector<M44d>& transforms, const std::string& where) {
    const std::string& name = tree_.nodes[static_cast<std::size_t>(node)].name;
    context_.claim(transforms.size(), sizeof(Instance) + name.size(), where);
    std::size_t singular = 0;
    std::size_t far = 0;
    for (const M44d& transform : transforms) {
      const M44d object_to_world = transform * world;
      if (!is_invertible(object_to_world)) {
        ++singular;
        continue;
      }
      const Imath::Box3d box = Imath::affineTransform(shape.bounds, object_to_world);
      if (!is_near(box)) {
        ++far;
        continue;
      }
      bounds_.extendBy(box);
      scene_.instances.push_back({name, shape.mesh, shape.sphere, material, node, object_to_world});
    }
    if (singular > 0) {
      context_.warn(where, "scales to nothing in some direction and is left out");
    }
    if (far > 0) context_.warn(where, "lies too far from the origin and is left out");
  }

  static bool is_near(const Imath::Box3d& box) {
    for (int i = 0; i < 3; ++i) {
      if (!(box.min[i] > -farthest && box.max[i] < farthest)) return false;
    }
    return true;
  }

  Context& context_;
  const Document& document_;
  Accessors& accessors_;
  const NodeTree& tree_;
  Scene& scene_;
  Materials materials_;
  Meshes meshes_;
  std::vector<std::shared_ptr<const std::vector<M44d>>> joints_;  // by skin
  Imath::Box3d bounds_;
};

}  // namespace

Imath::Box3d read_instances(Context& context, const Document& document, Accessors& accessors,
                            const NodeTree& tree, const std::vector<int>& nodes, Scene& scene) {
  InstanceReader reader(context, document, accessors, tree, scene);
  for (const int node : nodes) reader.read(node);
  return reader.bounds();
}

}  // namespace lumivec::gltf
