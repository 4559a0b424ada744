// Animation channels of node transforms and morph weights, as data.
#pragma once

#include "loader/gltf/accessors.h"
#include "loader/scene.h"

namespace lumivec::gltf {

// All animations of the file. A channel that contradicts itself is left out with a warning: a still
// picture does not need it.
std::vector<Animation> read_animations(Context& context, const Document& document,
                                       Accessors& accessors);

}  // namespace lumivec::gltf
