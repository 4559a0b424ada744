// Normals and tangents: repair of what a file gives, and tangents where it gives none.
#pragma once

#include "loader/gltf/context.h"
#include "loader/scene.h"

namespace lumivec::gltf {

// Normals become unit vectors. One that is zero or not finite becomes the geometric one of its
// triangles; if all are, the array goes and the mesh is flat.
void repair_normals(Context& context, const std::string& where, Mesh& mesh);

// Tangents become unit vectors with w = ±1; useless ones become any direction at right angles to
// the normal.
void repair_tangents(Context& context, const std::string& where, Mesh& mesh);

// Which texture coordinates a tangent frame follows: a UV set of the mesh, transformed.
struct TangentSpace {
  int uv_set = 0;
  M33f uv_transform;
};

// Fills mesh.tangents from the derivative of position by u, averaged over the triangles at a vertex
// by their angle there. A vertex where mirrored and unmirrored triangles meet is doubled. mesh has
// normals and the UV set.
void compute_tangents(Context& context, const std::string& where, const TangentSpace& space,
                      Mesh& mesh);

}  // namespace lumivec::gltf
