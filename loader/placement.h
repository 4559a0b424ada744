// Whether and how shapes, lights and cameras can stand in the world as a transform places them.
#pragma once

#include <ImathBox.h>

#include "loader/scene.h"

namespace lumivec {

enum class Placement : std::uint8_t { shown, flattened, far_away };

// shown: what an instance may be. flattened: the transform cannot be inverted. far_away: the box of
// the shape, in object space, is empty or reaches farther than ray tracing in float can follow.
Placement placement(const Imath::Box3d& bounds, const M44d& object_to_world);

// The frame of a light or camera: the rigid part of its node's transform. Where axes have no
// direction it has those of the world; where nothing is finite it stands at the origin.
M44d standing_frame(const M44d& node_to_world);

}  // namespace lumivec
