// Rotations as the language means them: in degrees, by the left hand, around x, then y, then z.
// Matrices are Imath's: p' = p · M. In left-handed coordinates, rotations by the left hand are
// those of the usual formulas.
#pragma once

#include "loader/scene.h"

namespace lumivec::pov {

M44d rotation_matrix(const V3d& degrees);
M44d axis_rotation_matrix(const V3d& axis, double degrees);

}  // namespace lumivec::pov
