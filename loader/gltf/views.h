// Cameras of the scene's nodes, and one that frames everything for a file without any.
#pragma once

#include <ImathBox.h>

#include "loader/gltf/nodes.h"

namespace lumivec::gltf {

// Fills Scene::cameras. A camera that could see nothing is left out with a warning; one that
// animations move (moving, by node) may find its direction later.
void read_cameras(Context& context, const tinygltf::Model& model, const std::vector<int>& nodes,
                  const std::vector<bool>& moving, Scene& scene);

// Looks at the middle of the bounds from in front, from the right and from slightly above, from
// where all of them just fit a square picture. glTF models face +Z and stand upright along +Y.
Camera default_camera(const Imath::Box3d& bounds);

}  // namespace lumivec::gltf
