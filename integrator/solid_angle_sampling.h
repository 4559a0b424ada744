// Directions toward area emitters, uniform in the solid angle that they subtend: sphere, triangle,
// rectangle.
//
// All geometry is relative to the receiving point. Densities are per steradian. Where a shape
// subtends so little that single precision loses its solid angle, callers sample its area instead
// (see min_solid_angle).
#pragma once

#include <array>

#include "loader/scene.h"

namespace lumivec {

// Below this many steradians the spherical formulas cancel in single precision; area sampling is
// then as good, since cosine and distance hardly vary over so small a shape.
constexpr float min_solid_angle = 1e-3f;

// The cone that a sphere subtends from outside.
struct SphereCone {
  V3f axis;  // unit, toward the centre
  float center_distance = 0.0f;
  float one_minus_cos_max = 0.0f;  // 1 - cos of the half angle, without cancellation
  float pdf = 0.0f;                // sr⁻¹, uniform
};
// to_center: from the receiving point; its length must exceed radius.
SphereCone sphere_cone(const V3f& to_center, float radius);
// Unit direction in the cone from two numbers in [0, 1), and the distance to the sphere's near side
// along it.
V3f sample_sphere_cone(const SphereCone& cone, float radius, const V2f& u, float& distance);

// Solid angle of a triangle, sr, ≥ 0 (Van Oosterom and Strackee 1983).
float triangle_solid_angle(const std::array<V3f, 3>& corners);
// Unit direction, uniform over the triangle (Arvo 1995).
V3f sample_spherical_triangle(const std::array<V3f, 3>& corners, const V2f& u);

// A rectangle seen from the receiving point (Ureña, Fajardo and King 2013).
struct SphericalRectangle {
  V3f x, y, z;  // local frame, unit; z points away from the rectangle's plane
  float x0 = 0.0f, x1 = 0.0f, y0 = 0.0f, y1 = 0.0f, z0 = 0.0f;
  float b0 = 0.0f, b1 = 0.0f, k = 0.0f;
  float solid_angle = 0.0f;  // sr
};
// corner, edges: the rectangle; the edges must be perpendicular.
SphericalRectangle spherical_rectangle(const V3f& corner, const V3f& edge_x, const V3f& edge_y);
// Point of the rectangle relative to the receiving point, uniform in solid angle.
V3f sample_spherical_rectangle(const SphericalRectangle& rectangle, const V2f& u);

}  // namespace lumivec
