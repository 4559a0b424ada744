// KHR_lights_punctual: point, spot and directional lights of the scene's nodes, in their
// photometric units.
#pragma once

#include "loader/gltf/nodes.h"

namespace lumivec::gltf {

// Fills Scene::lights. A light of an unknown type, or without a direction where it needs one, is
// left out with a warning.
void read_lights(Context& context, const tinygltf::Model& model, const NodeTree& tree,
                 const std::vector<int>& nodes, Scene& scene);

}  // namespace lumivec::gltf
