// Normals and tangents of a mesh as unit vectors, also where what they are made from has no
// direction.
#pragma once

#include <cstddef>

#include "loader/scene.h"

namespace lumivec {

// Brings v to unit length; false if it has no direction.
bool normalize(V3f& v);

// Any unit vector at right angles to the unit vector n.
V3f perpendicular(const V3f& n);

// Brings normals to unit length. Ones that are zero or not finite become the geometric ones of
// their triangles; returns how many.
std::size_t renew_normals(Mesh& mesh);

// Brings tangents to unit length with w = ±1. Useless ones become any direction at right angles to
// the normal; returns how many.
std::size_t renew_tangents(Mesh& mesh);

}  // namespace lumivec
