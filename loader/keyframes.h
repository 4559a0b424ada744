// The value of an animation channel between its keys, after glTF 2.0, appendix C.
#pragma once

#include <cstddef>
#include <vector>

#include "loader/scene.h"

namespace lumivec {

// Numbers that a channel holds for each of its keys, but for the tangents of splines.
std::size_t numbers_per_key(const AnimationChannel& channel);

// The value at a time, finite: 3 numbers, 4 of a unit quaternion, or one per morph weight. Before
// the first key it is the first one's, after the last key the last one's, at a key exactly that
// key's (a quaternion brought to unit length). Costs a binary search.
std::vector<double> value_at(const AnimationChannel& channel, double seconds);

}  // namespace lumivec
