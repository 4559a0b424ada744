// The images of a glTF file: those that a material of the scene uses, decoded once each, in
// parallel.
#pragma once

#include "loader/gltf/buffers.h"

namespace lumivec::gltf {

// Replaces the file's image indices in the scene's materials by indices into Scene::images, which
// it fills. A picture that is missing or cannot be decoded is a warning, and its maps are taken
// off.
void load_images(Context& context, Document& document, Buffers& buffers, Scene& scene);

}  // namespace lumivec::gltf
