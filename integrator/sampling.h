// Warps of the unit square to the domains that rendering samples, each with its density.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "loader/scene.h"

namespace lumivec {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float inv_pi = std::numbers::inv_pi_v<float>;

// Uniform on the unit disc, density 1/π; keeps neighbours in the square neighbours on the disc.
// Source: Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square".
inline V2f sample_disc(const V2f& u) {
  const float x = 2.0f * u.x - 1.0f;
  const float y = 2.0f * u.y - 1.0f;
  if (x == 0.0f && y == 0.0f) return {0.0f, 0.0f};
  const bool wide = std::abs(x) > std::abs(y);
  const float r = wide ? x : y;
  const float ratio = (wide ? y : x) / r * (pi / 4.0f);
  const float s = std::sin(ratio);  // the sine of at most 45°, from which the cosine follows safely
  const float c = std::sqrt(1.0f - s * s);
  return wide ? V2f(r * c, r * s) : V2f(r * s, r * c);
}

// Unit direction around +z, density cosθ/π sr⁻¹: the disc lifted to the hemisphere (Malley).
inline V3f sample_cosine_hemisphere(const V2f& u) {
  const V2f d = sample_disc(u);
  return {d.x, d.y, std::sqrt(std::max(0.0f, 1.0f - d.x * d.x - d.y * d.y))};
}

inline float cosine_hemisphere_pdf(float cos_theta) {
  return std::max(0.0f, cos_theta) * inv_pi;
}

}  // namespace lumivec
