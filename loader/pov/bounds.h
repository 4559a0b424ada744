// How far objects reach.
#pragma once

#include <ImathBox.h>

#include "loader/pov/pov_scene.h"

namespace lumivec::pov {

// Farther than anything that is drawn: the bounds of infinite objects end here.
constexpr double beyond_all = 1e10;

// A box around the object, in the space that it stands in; empty if there is nothing, or nothing is
// known without rendering. Combinations are bounded by all of their parts, intersections by each.
Imath::Box3d bounds_of(const Object& object);

// What CombinedShape::bounds is to hold.
Imath::Box3d bounds_of_parts(const CombinedShape& combined);

// What lies in both; empty if nothing does.
Imath::Box3d overlap(const Imath::Box3d& a, const Imath::Box3d& b);

}  // namespace lumivec::pov
