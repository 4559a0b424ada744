// Normals and tangents as a file gives them, repaired.
#pragma once

#include "loader/gltf/context.h"
#include "loader/scene.h"

namespace lumivec::gltf {

// Brings v to unit length; false if it has no direction.
bool normalize(V3f& v);

// Any unit vector at right angles to the unit vector n.
V3f perpendicular(const V3f& n);

// Normals become unit vectors. One that is zero or not finite becomes the geometric one of its
// triangles; if all are, the array goes and the mesh is flat.
void repair_normals(Context& context, const std::string& where, Mesh& mesh);

// Tangents become unit vectors with w = ±1; useless ones become any direction at right angles to
// the normal.
void repair_tangents(Context& context, const std::string& where, Mesh& mesh);

}  // namespace lumivec::gltf
