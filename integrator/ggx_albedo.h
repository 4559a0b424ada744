// Share of the light that one bounce off, or one passage through, a rough GGX boundary lets go
// again.
#pragma once

#include "integrator/fresnel.h"

namespace lumivec {

// Directional albedos ∫ f |cosθ| dω of a boundary, one for each of the functions that a Fresnel
// curve consists of (FresnelShape): the albedo of a curve is the same combination of these. Aligned
// so that one is a vector register.
struct alignas(32) Albedo {
  float reflected = 0.0f;          // of F = 1
  float reflected_exact = 0.0f;    // of F = t
  float reflected_schlick = 0.0f;  // of F = (1 − c)⁵
  float reflected_total = 0.0f;    // of F = 1 where reflection is total
  float transmitted = 0.0f;  // of T = 1 where refraction is possible; in power, not in radiance
  float transmitted_exact = 0.0f;  // of T = t there
  float unused[2] = {0.0f, 0.0f};
};

// Of a smooth boundary; cos_o in [0, 1], eta as for fresnel_shape.
inline Albedo smooth_albedo(float cos_o, float eta) {
  const FresnelShape shape = fresnel_shape(cos_o, eta);
  Albedo albedo;
  albedo.reflected = 1.0f;
  albedo.reflected_exact = shape.exact;
  albedo.reflected_schlick = shape.schlick;
  albedo.reflected_total = shape.total;
  albedo.transmitted = 1.0f - shape.total;
  albedo.transmitted_exact = shape.exact * (1.0f - shape.total);
  return albedo;
}

// By quadrature over the visible normals, to about 1e-3. cos_o in [0, 1]; alpha 0 (smooth) to 1;
// eta > 0. Reflection has height-correlated masking, transmission separable masking as in Walter et
// al. 2007.
Albedo ggx_albedo(float cos_o, float alpha, float eta);

}  // namespace lumivec
