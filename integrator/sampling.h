// Warps of the unit square to the domains that rendering samples, each with its density.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "loader/scene.h"

namespace lumivec {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float inv_pi = std::numbers::inv_pi_v<float>;

// sin x and cos x for |x| ≤ π/4, to 3e-8: Taylor's series, several times faster than the library's,
// which take any x.
template <typename T>
inline T sin_of_octant(T x) {
  const T y = x * x;
  return x * (1.0f + y * (-1.0f / 6 + y * (1.0f / 120 + y * (-1.0f / 5040 + y * (1.0f / 362880)))));
}
template <typename T>
inline T cos_of_octant(T x) {
  const T y = x * x;
  return 1.0f + y * (-1.0f / 2 + y * (1.0f / 24 + y * (-1.0f / 720 + y * (1.0f / 40320))));
}

// The point of the unit circle u of a turn, [0, 1), from the x axis to the y axis, to 1e-7.
inline V2f unit_circle(float u) {
  const float quarters = 4.0f * u;
  const int nearest = static_cast<int>(quarters + 0.5f);
  const float angle = (quarters - nearest) * (pi / 2.0f);
  const std::array<float, 2> p = {cos_of_octant(angle), sin_of_octant(angle)};
  constexpr std::array<float, 4> signs_x = {1.0f, -1.0f, -1.0f, 1.0f};
  constexpr std::array<float, 4> signs_y = {1.0f, 1.0f, -1.0f, -1.0f};
  return {signs_x[nearest & 3] * p[nearest & 1], signs_y[nearest & 3] * p[~nearest & 1]};
}

// Uniform on the unit disc, density 1/π; keeps neighbours in the square neighbours on the disc.
// Source: Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square".
inline V2f sample_disc(const V2f& u) {
  const float x = 2.0f * u.x - 1.0f;
  const float y = 2.0f * u.y - 1.0f;
  // Look-ups instead of branches, of which every other one would be mispredicted.
  const std::size_t wide = std::abs(x) > std::abs(y) ? 1 : 0;
  const std::array<float, 2> xy = {x, y};
  const float r = xy[1 - wide];
  if (r == 0.0f) return {0.0f, 0.0f};
  const float angle = xy[wide] / r * (pi / 4.0f);
  const std::array<float, 2> p = {sin_of_octant(angle), cos_of_octant(angle)};
  return {r * p[wide], r * p[1 - wide]};
}

// Unit direction around +z, density cosθ/π sr⁻¹: the disc lifted to the hemisphere (Malley).
inline V3f sample_cosine_hemisphere(const V2f& u) {
  const V2f d = sample_disc(u);
  // sample_disc keeps squares around the centre as circles, so that the radius is known before the
  // point is.
  const float r = std::max(std::abs(2.0f * u.x - 1.0f), std::abs(2.0f * u.y - 1.0f));
  return {d.x, d.y, std::sqrt((1.0f - r) * (1.0f + r))};
}

// Eight numbers side by side.
using Floats8 = float __attribute__((vector_size(32)));

// The same of eight points, of which [i][1] and [i][2] are u.
inline void sample_cosine_hemispheres(const std::array<std::array<float, 4>, 8>& points,
                                      std::array<V3f, 8>& directions) {
  Floats8 x, y;
  for (std::size_t i = 0; i < 8; ++i) {
    x[i] = points[i][1];
    y[i] = points[i][2];
  }
  x = 2.0f * x - 1.0f;
  y = 2.0f * y - 1.0f;
  const Floats8 abs_x = x < 0.0f ? -x : x, abs_y = y < 0.0f ? -y : y;
  const auto wide = abs_x > abs_y;
  const Floats8 r = wide ? x : y;
  const Floats8 angle = (wide ? y : x) / (r == 0.0f ? Floats8{} + 1.0f : r) * (pi / 4.0f);
  const Floats8 sine = r * sin_of_octant(angle), cosine = r * cos_of_octant(angle);
  const Floats8 px = wide ? cosine : sine, py = wide ? sine : cosine;
  const Floats8 size = wide ? abs_x : abs_y;
  const Floats8 height2 = (1.0f - size) * (1.0f + size);
  for (std::size_t i = 0; i < 8; ++i) directions[i] = {px[i], py[i], std::sqrt(height2[i])};
}

inline float cosine_hemisphere_pdf(float cos_theta) {
  return std::max(0.0f, cos_theta) * inv_pi;
}

}  // namespace lumivec
