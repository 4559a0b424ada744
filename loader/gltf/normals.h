// Normals and tangents as a file gives them, repaired.
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

// Says how many of them had no direction; nothing if none.
void warn_of_normals(Context& context, const std::string& where, std::size_t count);
void warn_of_tangents(Context& context, const std::string& where, std::size_t count);

}  // namespace lumivec::gltf
