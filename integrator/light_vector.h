// A light vector: one virtual source that stands for all the light that a term brings to a point,
// a direction D and a magnitude M (paper, eq. 2.2 and 2.3):
//
//   D = ∫ L ω dω        M = ∫ f L cosθ dω / (f(D) cos(n, D))
//
// At the point and for the view it was made for, it reproduces the term exactly; nearby it is lit
// again by the BSDF there. Making one takes one to three evaluations of the BSDF, re-lighting it
// one.
//
// Where f(D) cos(n, D) is small against what was reflected, the source would have to be brighter
// than all light there is, and re-lighting would magnify it; another direction is then taken. Every
// stored value is finite, and no magnitude is negative.
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "integrator/settings.h"
#include "loader/scene.h"

namespace lumivec {

struct LightVector {
  V3f direction{0.0f, 0.0f, 1.0f};  // unit, from the surface
  // W·m⁻², ≥ 0: per channel; of form radiance, W·sr⁻¹·m⁻².
  Color magnitude{0.0f};
  LightVectorForm form = LightVectorForm::exact;
};

// The integrals that a light vector is made of, over the light that arrives at a point.
struct LightIntegrals {
  V3f vector{0.0f};            // D: ∫ L ω dω, L the mean of the channels
  V3f reflected_vector{0.0f};  // ∫ f L cosθ ω dω, likewise
  Color incident{0.0f};        // ∫ L dω, W·m⁻²
  Color reflected{0.0f};       // ∫ f L cosθ dω, W·sr⁻¹·m⁻²

  // Light from unit direction wi: its radiance times its solid angle (or over its density), and the
  // BSDF times the cosine there. The albedo of a texture may be left out of f_cos here, and has
  // then to be left out wherever the light vector is used.
  void add(const V3f& wi, const Color& light, const Color& f_cos);
};

// Sources brighter than this times all arriving light are in the tail of a lobe: they owe their
// brightness to a small f cosθ, which doubles or vanishes a step further. A diffuse surface never
// exceeds 1, a lobe whose light comes from where its peak is neither.
constexpr float max_brightening = 4.0f;

// Whether a source in a direction where the BSDF times the cosine is f_cos can stand for the light;
// its magnitude.
bool light_vector_magnitude(const LightIntegrals& light, const Color& f_cos, Color& magnitude);

// v as a unit vector. False: it has no direction, and `unit` is as before.
bool unit_direction(const V3f& v, V3f& unit);

// The light vector of finite integrals, non-negative but for the vectors. normal: unit.
// f_cos(direction): BSDF times cosine, a Color ≥ 0, at the point for the view and a unit direction
// of light.
template <typename FCos>
LightVector make_light_vector(const LightIntegrals& light, const V3f& normal, const FCos& f_cos) {
  LightVector v;
  v.direction = normal;
  // An extinct term is black from any direction.
  if (light.reflected == Color(0.0f)) {
    unit_direction(light.vector, v.direction);
    return v;
  }
  const V3f candidates[] = {light.vector, light.reflected_vector, normal};
  for (int i = 0; i < 3; ++i) {
    V3f direction(0.0f);
    if (!unit_direction(candidates[i], direction)) continue;
    if (!light_vector_magnitude(light, f_cos(direction), v.magnitude)) continue;
    v.direction = direction;
    v.form = static_cast<LightVectorForm>(i);
    return v;
  }
  v.magnitude = light.reflected;
  v.form = LightVectorForm::radiance;
  return v;
}

// The radiance (W·sr⁻¹·m⁻²) that a light vector causes where the BSDF times the cosine, for the
// view there and light from v.direction, is f_cos; v.form radiance does not need it.
inline Color relit(const LightVector& v, const Color& f_cos) {
  return v.form == LightVectorForm::radiance ? v.magnitude : v.magnitude * f_cos;
}

}  // namespace lumivec
