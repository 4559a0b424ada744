// An object's transform as numbers that a person can change: place, turn, size and skew.
#pragma once

#include "loader/scene.h"

namespace lumivec {

// Applied from the last to the first: skew, size, turn, place.
struct ObjectPlace {
  V3d place{0.0};  // scene units
  V3d turn{0.0};   // degrees about X, then Y, then Z
  V3d size{1.0};   // factors along the object's axes; all negative for one that is mirrored
  V3d skew{0.0};   // xy, xz, yz
};

// transform: affine and invertible; otherwise identity.
ObjectPlace place_of(const M44d& transform);
M44d transform_of(const ObjectPlace& place);

}  // namespace lumivec
