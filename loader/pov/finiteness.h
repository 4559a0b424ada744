// Whether a scene's numbers can be those of a picture: sums and products of a scene may overflow.
#pragma once

#include <cmath>
#include <limits>

#include "loader/scene.h"

namespace lumivec::pov {

// A number that is finite, and stays so as a float.
inline bool fits_float(double x) {
  return std::abs(x) <= static_cast<double>(std::numeric_limits<float>::max());
}

inline bool fits_float(const V3d& v) {
  return fits_float(v.x) && fits_float(v.y) && fits_float(v.z);
}

}  // namespace lumivec::pov
