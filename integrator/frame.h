// An orthonormal frame around a direction: shading works in it, with z along the normal.
#pragma once

#include <cmath>

#include "loader/scene.h"

namespace lumivec {

// Right-handed, unit axes; n is the local z.
struct Frame {
  V3f t, b, n;

  V3f to_local(const V3f& v) const { return {v.dot(t), v.dot(b), v.dot(n)}; }
  V3f to_world(const V3f& v) const { return v.x * t + v.y * b + v.z * n; }
};

// The frame of unit vector n. Continuous but where n.z changes sign, and without a square root.
// Source: Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
inline Frame make_frame(const V3f& n) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float c = n.x * n.y * a;
  return {V3f(1.0f + sign * n.x * n.x * a, sign * c, -sign * n.x),
          V3f(c, sign + n.y * n.y * a, -n.y), n};
}

}  // namespace lumivec
