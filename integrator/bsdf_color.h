// Channel-wise helpers for colours.
#pragma once

#include <algorithm>

#include "loader/scene.h"

namespace lumivec {

inline float mean(const Color& c) {
  return (c.x + c.y + c.z) * (1.0f / 3.0f);
}

inline bool is_black(const Color& c) {
  return c.x <= 0.0f && c.y <= 0.0f && c.z <= 0.0f;
}

inline Color at_least_0(const Color& c) {
  return {std::max(c.x, 0.0f), std::max(c.y, 0.0f), std::max(c.z, 0.0f)};
}

inline Color at_most_1(const Color& c) {
  return {std::min(c.x, 1.0f), std::min(c.y, 1.0f), std::min(c.z, 1.0f)};
}

inline Color at_least(const Color& a, const Color& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

// a / b where b is a share of light that is left, and 0 where nothing is.
inline Color quotient(const Color& a, const Color& b) {
  constexpr float nothing = 1e-5f;
  return {b.x > nothing ? a.x / b.x : 0.0f, b.y > nothing ? a.y / b.y : 0.0f,
          b.z > nothing ? a.z / b.z : 0.0f};
}

inline Color white() {
  return Color(1.0f);
}

}  // namespace lumivec
