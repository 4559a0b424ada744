// A direction in 32 bits: the octahedron |x| + |y| + |z| = 1, unfolded to a square of 2^16 steps a
// side (Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors").
// Off by 7e-5 at most. Unpacking takes no branch, and eight are unpacked at once in a loop.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "integrator/lanes.h"
#include "loader/scene.h"

namespace lumivec {

constexpr float packed_direction_error = 7e-5f;  // radians

// The point on the octahedron: the direction with a length from 1/√3 to 1.
inline V3f unpack_octahedral(std::uint32_t packed) {
  // Steps are odd multiples of half a step from the middle: no component is lost in the fold.
  constexpr float step = 2.0f / 65536.0f;
  const float x = (static_cast<float>(packed & 0xffff) + 0.5f) * step - 1.0f;
  const float y = (static_cast<float>(packed >> 16) + 0.5f) * step - 1.0f;
  const float z = 1.0f - std::abs(x) - std::abs(y);
  // The lower half is folded over the edges.
  const float fold = 0.5f * twice_positive_part(-z);
  return V3f(x - std::copysign(fold, x), y - std::copysign(fold, y), z);
}

inline V3f unpack_direction(std::uint32_t packed) {
  const V3f v = unpack_octahedral(packed);
  return v * (1.0f / std::sqrt(v.length2()));
}

// Of a unit direction.
inline std::uint32_t pack_direction(const V3f& d) {
  const float scale = 1.0f / (std::abs(d.x) + std::abs(d.y) + std::abs(d.z));
  float x = d.x * scale, y = d.y * scale;
  if (d.z < 0.0f) {
    const float folded = std::copysign(1.0f - std::abs(y), x);
    y = std::copysign(1.0f - std::abs(x), y);
    x = folded;
  }
  const auto steps = [](float c) {
    return static_cast<std::uint32_t>(std::clamp((c + 1.0f) * 32768.0f, 0.0f, 65535.0f));
  };
  return steps(y) << 16 | steps(x);
}

}  // namespace lumivec
