// Tangent frames for normal maps whose mesh brings none, in the way of MikkTSpace.
#pragma once

#include <cstdint>
#include <vector>

#include "loader/gltf/context.h"
#include "loader/scene.h"

namespace lumivec::gltf {

// Which texture coordinates a tangent frame follows: a UV set of the mesh, transformed.
struct TangentSpace {
  int uv_set = 0;
  M33f uv_transform;
};

// Fills mesh.tangents from the derivative of position by u, averaged over the triangles at a vertex
// by their angle there. A vertex where mirrored and unmirrored triangles meet is doubled. mesh has
// normals and the UV set. Returns the vertices that were doubled, in the order of their copies,
// which are appended.
std::vector<std::uint32_t> compute_tangents(Context& context, const std::string& where,
                                            const TangentSpace& space, Mesh& mesh);

}  // namespace lumivec::gltf
