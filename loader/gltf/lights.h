// KHR_lights_punctual: point, spot and directional lights of the scene's nodes, in their
// photometric units.
#pragma once

#include "loader/gltf/nodes.h"

namespace lumivec::gltf {

// Fills Scene::lights. A light of an unknown type, or without a direction where it needs one, is
// left out with a warning; one that animations move (moving, by node) may find its direction later.
void read_lights(Context& context, const tinygltf::Model& model, const std::vector<int>& nodes,
                 const std::vector<bool>& moving, Scene& scene);

}  // namespace lumivec::gltf
