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
  const RestTransform rest = rest_transform(node, static_cast<int>(index));
  m = compose(rest.translation, rest.rotation, rest.scale);
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

RestTransform rest_transform(const tinygltf::Node& node, int index) {
  RestTransform rest;
  rest.node = index;
  if (!node.translation.empty()) std::copy_n(node.translation.begin(), 3, &rest.translation.x);
  if (!node.rotation.empty()) std::copy_n(node.rotation.begin(), 4, &rest.rotation.x);
  if (!node.scale.empty()) std::copy_n(node.scale.begin(), 3, &rest.scale.x);
  return rest;
}

std::vector<Node> read_nodes(const Context& context, const tinygltf::Model& model) {
  std::vector<Node> nodes(model.nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i].name = model.nodes[i].name;
    nodes[i].local_to_parent = local_transform(context, model.nodes[i], i);
  }
  connect(context, model, nodes);

  std::vector<int> order;
  descend(model, roots_backwards(nodes), order);
  std::vector<bool> reached(nodes.size());
  for (const int i : order) {
    const auto index = static_cast<std::size_t>(i);
    reached[index] = true;
    nodes[index].local_to_world = world_transform(nodes[index], nodes);
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    if (!reached[i]) context.fail(where_of(i), "is its own ancestor, or below one that is");
  }
  return nodes;
}

std::vector<int> nodes_of_scene(Context& context, const tinygltf::Model& model,
                                const std::vector<Node>& tree, int scene) {
  std::vector<int> order;
  if (scene < 0) {
    descend(model, roots_backwards(tree), order);
    return order;
  }
  const auto& listed = model.scenes[static_cast<std::size_t>(scene)].nodes;
  const std::string where = pointer({"scenes", static_cast<std::size_t>(scene), "nodes"});
  std::vector<bool> seen(tree.size());
  std::vector<int> roots;
  for (const int root : listed) {
    const auto index = static_cast<std::size_t>(root);
    if (tree[index].parent >= 0) {
      context.fail(where, "lists node " + std::to_string(root) + ", which is a child of node " +
                              std::to_string(tree[index].parent));
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
