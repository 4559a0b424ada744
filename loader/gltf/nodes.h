// The node tree: local transforms, parents, and world transforms.
#pragma once

#include <vector>

#include "loader/gltf/document.h"
#include "loader/scene.h"

namespace lumivec::gltf {

// One entry for every node of the file, by its index there.
struct NodeTree {
  std::vector<Node> nodes;
  std::vector<M44d> worlds;  // may be singular or not finite
};

// Fails where a node has two parents, is its own ancestor, or has a transform that is not affine or
// not finite.
NodeTree read_nodes(const Context& context, const tinygltf::Model& model);

// The nodes below the roots of a scene (-1: every root of the file), parents before children, in
// the file's order.
std::vector<int> nodes_of_scene(Context& context, const tinygltf::Model& model,
                                const NodeTree& tree, int scene);

}  // namespace lumivec::gltf
