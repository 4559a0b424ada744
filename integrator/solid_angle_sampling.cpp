#include "integrator/solid_angle_sampling.h"

#include <algorithm>
#include <cmath>

#include "integrator/frame.h"
#include "integrator/sampling.h"

namespace lumivec {
namespace {

constexpr float below_one = 0x1.fffffep-1f;

float angle_between(const V3f& a, const V3f& b) {
  // Stable for nearly parallel and nearly opposite vectors (Kahan).
  return 2.0f * std::atan2((a - b).length(), (a + b).length());
}

}  // namespace

SphereCone sphere_cone(const V3f& to_center, float radius) {
  const float distance2 = to_center.length2();
  const float sin2 = std::min(radius * radius / distance2, 1.0f);
  SphereCone cone;
  cone.center_distance = std::sqrt(distance2);
  cone.axis = to_center * (1.0f / cone.center_distance);
  // 1 - √(1 - s²) = s² / (1 + √(1 - s²)): keeps its digits for far spheres.
  cone.one_minus_cos_max = sin2 / (1.0f + std::sqrt(1.0f - sin2));
  cone.pdf = 1.0f / (2.0f * pi * cone.one_minus_cos_max);
  return cone;
}

V3f sample_sphere_cone(const SphereCone& cone, float radius, const V2f& u, float& distance) {
  const float one_minus_cos = u.x * cone.one_minus_cos_max;
  const float cos_theta = 1.0f - one_minus_cos;
  const float sin2 = one_minus_cos * (2.0f - one_minus_cos);
  const float sin_theta = std::sqrt(std::max(sin2, 0.0f));
  const V2f across = unit_circle(u.y) * sin_theta;
  const float d = cone.center_distance;
  const float half_chord2 = radius * radius - d * d * sin2;
  distance = d * cos_theta - std::sqrt(std::max(half_chord2, 0.0f));
  return make_frame(cone.axis).to_world(V3f(across.x, across.y, cos_theta));
}

float triangle_solid_angle(const std::array<V3f, 3>& corners) {
  const V3f a = corners[0].normalized(), b = corners[1].normalized(), c = corners[2].normalized();
  // The triple product of differences keeps its digits where that of the vectors themselves
  // cancels.
  const float numerator = std::abs(a.dot((b - a).cross(c - a)));
  const float denominator = 1.0f + a.dot(b) + b.dot(c) + c.dot(a);
  const float omega = 2.0f * std::atan2(numerator, denominator);
  return omega < 0.0f ? omega + 4.0f * pi : omega;
}

V3f sample_spherical_triangle(const std::array<V3f, 3>& corners, const V2f& u) {
  const V3f a = corners[0].normalized(), b = corners[1].normalized(), c = corners[2].normalized();
  // Dihedral angles at the corners, from the normals of the planes through the origin.
  const V3f n_ab = a.cross(b).normalized(), n_bc = b.cross(c).normalized(),
            n_ca = c.cross(a).normalized();
  const float alpha = angle_between(n_ab, -n_ca);
  const float beta = angle_between(n_bc, -n_ab);
  const float gamma = angle_between(n_ca, -n_bc);
  const float area = alpha + beta + gamma - pi;
  const float target = u.x * area + pi;  // of the sub-triangle, plus π
  const float cos_alpha = std::cos(alpha), sin_alpha = std::sin(alpha);
  const float sin_phi = std::sin(target) * cos_alpha - std::cos(target) * sin_alpha;
  const float cos_phi = std::cos(target) * cos_alpha + std::sin(target) * sin_alpha;
  const float cos_c = a.dot(b);
  const float k1 = cos_phi + cos_alpha;
  const float k2 = sin_phi - sin_alpha * cos_c;
  float cos_bp = (k2 + (k2 * cos_phi - k1 * sin_phi) * cos_alpha) /
                 ((k2 * sin_phi + k1 * cos_phi) * sin_alpha);
  if (!std::isfinite(cos_bp)) cos_bp = 1.0f;
  cos_bp = std::clamp(cos_bp, -1.0f, 1.0f);
  const float sin_bp = std::sqrt(std::max(0.0f, 1.0f - cos_bp * cos_bp));
  const V3f toward_c = (c - a * c.dot(a)).normalized();
  const V3f cp = a * cos_bp + toward_c * sin_bp;
  const float cos_theta = 1.0f - u.y * (1.0f - cp.dot(b));
  const float sin_theta = std::sqrt(std::max(0.0f, 1.0f - cos_theta * cos_theta));
  const V3f toward_cp = (cp - b * cp.dot(b)).normalized();
  return (b * cos_theta + toward_cp * sin_theta).normalized();
}

SphericalRectangle spherical_rectangle(const V3f& corner, const V3f& edge_x, const V3f& edge_y) {
  SphericalRectangle r;
  const float length_x = edge_x.length(), length_y = edge_y.length();
  r.x = edge_x * (1.0f / length_x);
  r.y = edge_y * (1.0f / length_y);
  r.z = r.x.cross(r.y);
  r.z0 = corner.dot(r.z);
  if (r.z0 > 0.0f) {
    r.z = -r.z;
    r.z0 = -r.z0;
  }
  r.x0 = corner.dot(r.x);
  r.y0 = corner.dot(r.y);
  r.x1 = r.x0 + length_x;
  r.y1 = r.y0 + length_y;
  const V3f v00(r.x0, r.y0, r.z0), v01(r.x0, r.y1, r.z0), v10(r.x1, r.y0, r.z0),
      v11(r.x1, r.y1, r.z0);
  const V3f n0 = v00.cross(v10).normalized(), n1 = v10.cross(v11).normalized();
  const V3f n2 = v11.cross(v01).normalized(), n3 = v01.cross(v00).normalized();
  const float g0 = angle_between(n0, -n1), g1 = angle_between(n1, -n2);
  const float g2 = angle_between(n2, -n3), g3 = angle_between(n3, -n0);
  r.b0 = n0.z;
  r.b1 = n2.z;
  r.k = 2.0f * pi - g2 - g3;
  r.solid_angle = std::max(g0 + g1 - r.k, 0.0f);
  return r;
}

V3f sample_spherical_rectangle(const SphericalRectangle& r, const V2f& u) {
  const float au = u.x * r.solid_angle + r.k;
  const float fu = (std::cos(au) * r.b0 - r.b1) / std::sin(au);
  float cu = std::copysign(1.0f, fu) / std::sqrt(fu * fu + r.b0 * r.b0);
  cu = std::clamp(cu, -below_one, below_one);
  if (!(std::abs(cu) <= 1.0f)) cu = 0.0f;
  const float xu = std::clamp(-(cu * r.z0) / std::sqrt(1.0f - cu * cu), r.x0, r.x1);
  const float d = std::sqrt(xu * xu + r.z0 * r.z0);
  const float h0 = r.y0 / std::sqrt(d * d + r.y0 * r.y0);
  const float h1 = r.y1 / std::sqrt(d * d + r.y1 * r.y1);
  const float hv = h0 + u.y * (h1 - h0);
  const float yv = hv * hv < below_one ? (hv * d) / std::sqrt(1.0f - hv * hv) : r.y1;
  return r.x * xu + r.y * std::clamp(yv, r.y0, r.y1) + r.z * r.z0;
}

}  // namespace lumivec
