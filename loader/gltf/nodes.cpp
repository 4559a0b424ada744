#include "loader/gltf/nodes.h"

#include <algorithm>
#include <cmath>

#include "loader/transforms.h"

namespace lumivec::gltf {
namespace {

std::string where_of(std::size_t node) {
  return pointer({"nodes", node});
}

M44d local_transform(const Context& context, const tinygltf::Node& node, std::size_t index) {
  M44d m;
  if (!node.matrix.empty()) {
    // Column-major matrices of column vectors lie in memory as row-major ones of row vectors do.
    for (std::size_t k = 0; k < 16; ++k) m[static_cast<int>(k / 4)][k % 4] = node.matrix[k];
    if (m[0][3] != 0.0 || m[1][3] != 0.0 || m[2][3] != 0.0 || m[3][3] != 1.0) {
      context.fail(where_of(index) + "/matrix", "is not affine");
    }
    return m;
  }
  double rotation[4] = {0, 0, 0, 1};
  V3d scale(1.0);
  V3d translation(0.0);
  if (!node.rotation.empty()) std::copy_n(node.rotation.begin(), 4, rotation);
  if (!node.scale.empty()) scale = {node.scale[0], node.scale[1], node.scale[2]};
  if (!node.translation.empty()) {
    translation = {node.translation[0], node.translation[1], node.translation[2]};
  }
  m = compose(translation, rotation, scale);
  if (!is_finite(m)) {
    context.fail(where_of(index), "rotation is no quaternion, or the transform is not finite");
  }
  return m;
}

void connect(const Context& context, const tinygltf::Model& model, std::vector<Node>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const int child : model.nodes[i].children) {
      Node& node = nodes[static_cast<std::size_t>(child)];
      if (node.parent >= 0) {
        context.fail(where_of(static_cast<std::size_t>(child)),
                     "is a child of node " + std::to_string(node.parent) + " and of node " +
                         std::to_string(i));
      }
      node.parent = static_cast<int>(i);
    }
  }
}

// Appends the nodes below the ones on the stack, which is taken from its end. Each node has one
// parent, so none comes twice unless the stack holds it twice.
void descend(const tinygltf::Model& model, std::vector<int> stack, std::vector<int>& order) {
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    order.push_back(node);
    const auto& children = model.nodes[static_cast<std::size_t>(node)].children;
    stack.insert(stack.end(), children.rbegin(), children.rend());
  }
}

std::vector<int> roots_backwards(const std::vector<Node>& nodes) {
  std::vector<int> roots;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (nodes[i].parent < 0) roots.push_back(static_cast<int>(i));
  }
  return roots;
}

}  // namespace

NodeTree read_nodes(const Context& context, const tinygltf::Model& model) {
  NodeTree tree;
  tree.nodes.resize(model.nodes.size());
  tree.worlds.resize(model.nodes.size());
  for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
    tree.nodes[i].name = model.nodes[i].name;
    tree.nodes[i].local_to_parent = local_transform(context, model.nodes[i], i);
  }
  connect(context, model, tree.nodes);

  std::vector<int> order;
  descend(model, roots_backwards(tree.nodes), order);
  std::vector<bool> reached(tree.nodes.size());
  for (const int i : order) {
    const auto index = static_cast<std::size_t>(i);
    reached[index] = true;
    const Node& node = tree.nodes[index];
    tree.worlds[index] = node.local_to_parent;
    if (node.parent >= 0) tree.worlds[index] *= tree.worlds[static_cast<std::size_t>(node.parent)];
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (!reached[i]) context.fail(where_of(i), "is its own ancestor, or below one that is");
  }
  return tree;
}

std::vector<int> nodes_of_scene(Context& context, const tinygltf::Model& model,
                                const NodeTree& tree, int scene) {
  std::vector<int> order;
  if (scene < 0) {
    descend(model, roots_backwards(tree.nodes), order);
    return order;
  }
  const auto& listed = model.scenes[static_cast<std::size_t>(scene)].nodes;
  const std::string where = pointer({"scenes", static_cast<std::size_t>(scene), "nodes"});
  std::vector<bool> seen(tree.nodes.size());
  std::vector<int> roots;
  for (const int root : listed) {
    const auto index = static_cast<std::size_t>(root);
    if (tree.nodes[index].parent >= 0) {
      context.fail(where, "lists node " + std::to_string(root) + ", which is a child of node " +
                              std::to_string(tree.nodes[index].parent));
    }
    if (seen[index]) {
      context.warn(where, "lists node " + std::to_string(root) + " twice");
      continue;
    }
    seen[index] = true;
    roots.push_back(root);
  }
  descend(model, {roots.rbegin(), roots.rend()}, order);
  return order;
}

}  // namespace lumivec::gltf
