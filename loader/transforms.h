// Affine transforms, as Imath stores them: p' = p · M.
#pragma once

#include <optional>
#include <vector>

#include "loader/scene.h"

namespace lumivec {

bool is_finite(const M44d& m);

// Of the linear part.
double determinant3(const M44d& m);

// Can m be inverted in double precision with digits to spare, however large or small it scales as a
// whole?
bool is_invertible(const M44d& m);

// scale, then rotation (a quaternion x y z w of any length but 0), then translation.
M44d compose(const V3d& translation, const V4d& rotation, const V3d& scale);

// Local to world, if the parent's is right.
M44d world_transform(const Node& node, const std::vector<Node>& nodes);

// The position of m, and its -Z and +Y axes made a right-handed orthonormal frame: what a camera or
// a light is to take from a node. None if an axis has no direction.
std::optional<M44d> rigid_part(const M44d& m);

}  // namespace lumivec
