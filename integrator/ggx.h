// The GGX microfacet distribution with Smith's masking, isotropic, in the local frame (z along the
// normal).
//
// Everything is written so that it holds in single precision from α = 1e-3 (mirror-like) to 1 and
// from normal to grazing directions: no 1 − cos², no quotient of two vanishing cosines. Source:
// Walter et al. 2007 (distribution, refraction), Heitz 2014 (masking), Heitz 2018 (visible
// normals).
#pragma once

#include <algorithm>
#include <cmath>

#include "integrator/sampling.h"

namespace lumivec {

// Smallest cosine of the view with its shading normal: normals that turn further away are bent back
// to it. Far below what a picture resolves, far above what single precision loses.
constexpr float min_view_cosine = 1e-4f;

// D(h): area of facets with unit normal h, per area of surface and solid angle. Tangents instead of
// 1 − cos²: that difference has no digits left where α is small.
inline float ggx_density(const V3f& h, float alpha) {
  if (h.z <= 0.0f) return 0.0f;
  const float a2 = alpha * alpha;
  const float d = h.x * h.x + h.y * h.y + a2 * h.z * h.z;
  return a2 / (pi * d * d);
}

// √(α² + (1 − α²) cos²) = cos · (1 + 2Λ): Smith's Λ without the division by the cosine.
inline float smith_root(float cos_theta, float alpha) {
  const float a2 = alpha * alpha;
  return std::sqrt(a2 + (1.0f - a2) * cos_theta * cos_theta);
}

// Masking of one direction, G1 = 1 / (1 + Λ).
inline float smith_g1(float cos_theta, float root) {
  return 2.0f * cos_theta / (cos_theta + root);
}

// Height-correlated masking and shadowing over the cosines of both directions, G2 / (cos_o cos_i) =
// 1 / ((1 + Λo + Λi) cos_o cos_i). Source: Heitz 2014, equation 99.
inline float smith_g2_over_cosines(float cos_o, float root_o, float cos_i, float root_i) {
  return 2.0f / (cos_o * root_i + cos_i * root_o);
}

// Density of sample_visible_normal, G1(o) (o·h) D(h) / cos_o.
inline float visible_normal_pdf(float o_dot_h, float density, float cos_o, float root_o) {
  return 2.0f * o_dot_h * density / (cos_o + root_o);
}

// Density of the reflection of wo at such a normal: visible_normal_pdf / (4 o·h).
inline float reflected_facet_pdf(float density, float cos_o, float root_o) {
  return 0.5f * density / (cos_o + root_o);
}

// A facet normal as wo (unit, z > 0) sees them: uniform on the spherical cap of reflected
// directions of the hemisphere that wo sees after stretching, which is the distribution of Heitz
// 2018. Source: Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps".
inline V3f sample_visible_normal(const V3f& wo, float alpha, const V2f& u) {
  const V3f o = V3f(alpha * wo.x, alpha * wo.y, wo.z).normalized();
  const V2f azimuth = unit_circle(u.x);
  const float up =
      (1.0f - u.y) * (1.0f + o.z);  // height of the cap's point above its lower edge, > 0
  const float z = up - o.z;
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return V3f(alpha * (o.x + r * azimuth.x), alpha * (o.y + r * azimuth.y), up).normalized();
}

inline V3f reflect(const V3f& wo, const V3f& h) {
  return 2.0f * wo.dot(h) * h - wo;
}

// Snell's law in vector form: the direction beyond the boundary of relative index eta that light
// takes along wo.
inline V3f refract(const V3f& wo, const V3f& h, float eta, float cos_transmitted) {
  return (wo.dot(h) / eta - cos_transmitted) * h - wo / eta;
}

}  // namespace lumivec
