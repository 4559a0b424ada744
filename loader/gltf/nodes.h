// The node tree: local transforms, parents, and world transforms.
#pragma once

#include <vector>

#include "loader/gltf/document.h"
#include "loader/scene.h"

namespace lumivec::gltf {

// Every node of the file, by its index there. Fails where a node has two parents, is its own
// ancestor, or has a transform that is not affine or not finite.
std::vector<Node> read_nodes(const Context& context, const tinygltf::Model& model);

// The parts of a node's transform; the node has no matrix.
RestTransform rest_transform(const tinygltf::Node& node, int index);

// The nodes below the roots of a scene (-1: every root of the file), parents before children, in
// the file's order.
std::vector<int> nodes_of_scene(Context& context, const tinygltf::Model& model,
                                const std::vector<Node>& tree, int scene);

}  // namespace lumivec::gltf
