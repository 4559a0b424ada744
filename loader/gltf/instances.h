// The instances of a scene: one for every node and primitive, several with EXT_mesh_gpu_instancing.
#pragma once

#include "loader/gltf/materials.h"
#include "loader/gltf/meshes.h"
#include "loader/gltf/nodes.h"

namespace lumivec::gltf {

// Fills instances, meshes, spheres and materials of the scene from the given nodes, and returns the
// bounds of it all in the world. Instances whose transform cannot be inverted or does not fit a
// float are left out with a warning, or hidden if animations move or deform them. Fills skins,
// deformations and instances of the scene's motion. moving: for each node, do animations move it?
Imath::Box3d read_instances(Context& context, const Document& document, Accessors& accessors,
                            const std::vector<int>& nodes, const std::vector<bool>& moving,
                            Scene& scene);

// The transforms of EXT_mesh_gpu_instancing on a node, each to be followed by the node's own; one
// identity without it.
std::vector<M44d> instance_transforms(Context& context, Accessors& accessors,
                                      const tinygltf::Node& node, const std::string& where);

}  // namespace lumivec::gltf
