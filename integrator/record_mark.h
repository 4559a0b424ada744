// What can be shown of a record of cached light: where it holds, and why no further.
#pragma once

#include <array>
#include <cstdint>

#include "integrator/irradiance_record.h"
#include "loader/scene.h"

namespace lumivec {

struct RecordMark {
  V3d position{0.0};  // world space
  V3d normal{0.0};    // unit
  // Half axes of the ellipse inside which it is used for pixels of the present view, world space.
  std::array<V3d, 2> half_axis = {V3d(0.0), V3d(0.0)};
  RadiusLimit limit = RadiusLimit::curvature;  // of the shorter one
  float noise = 0.0f;                          // relative, √ of the variance
  bool provisional = false;                    // not yet made as well as the error asks
};

}  // namespace lumivec
