// How much of the light a boundary reflects, as a function of the angle.
//
// Dielectrics follow Fresnel's exact equations, metals Schlick's approximation. An artist's
// strength and tint reshape the dielectric's curve between its two ends: F(c) = f0 + (f90 − f0) ·
// t(c), where t runs from 0 at normal to 1 at grazing incidence and has the exact curve's shape.
// Everything is linear in t, so that albedos of reshaped curves follow from tables that know the
// index alone.
#pragma once

#include <algorithm>
#include <cmath>

#include "loader/scene.h"

namespace lumivec {

// Reflectance of unpolarised light and the cosine of the refracted direction, > 0; 0: total
// internal reflection.
struct Refraction {
  float reflectance;
  float cos_transmitted;
};

// Fresnel's equations at a boundary of relative index eta > 0 (beyond over before), cos_incident in
// [0, 1]. Source: Born and Wolf, Principles of Optics, 1.5.2. Snell's law is written with η² − 1,
// which keeps its digits where the indices are nearly equal.
inline Refraction fresnel_dielectric(float cos_incident, float eta) {
  cos_incident = std::max(cos_incident, 0.0f);  // of a half vector, it may be negative by rounding
  const float s = (eta - 1.0f) * (eta + 1.0f) + cos_incident * cos_incident;  // η² cos²θt
  if (s <= 0.0f) return {1.0f, 0.0f};
  const float cos_t = std::sqrt(s) / eta;
  const float parallel = (eta * cos_incident - cos_t) / (eta * cos_incident + cos_t);
  const float perpendicular = (cos_incident - eta * cos_t) / (cos_incident + eta * cos_t);
  return {0.5f * (parallel * parallel + perpendicular * perpendicular), cos_t};
}

// Reflectance at normal incidence; 1 for eta == 0, which stands for a boundary that reflects
// everything.
inline float normal_reflectance(float eta) {
  const float r = (eta - 1.0f) / (eta + 1.0f);
  return r * r;
}

// Source: Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering".
inline float schlick_weight(float cos_incident) {
  const float x = std::clamp(1.0f - cos_incident, 0.0f, 1.0f);
  const float x2 = x * x;
  return x2 * x2 * x;
}

// The functions of the angle that every Fresnel curve here is a combination of, besides the
// constant 1.
struct FresnelShape {
  float exact;            // t: 0 at normal, 1 at grazing incidence and where reflection is total
  float schlick;          // (1 − c)⁵
  float total;            // 1 where reflection is total, 0 elsewhere
  float cos_transmitted;  // as in Refraction
};

// eta == 0: t is Schlick's, since no exact curve starts at F0 = 1.
inline FresnelShape fresnel_shape(float cos_incident, float eta) {
  const float schlick = schlick_weight(cos_incident);
  if (eta == 0.0f) return {schlick, schlick, 0.0f, 0.0f};
  const float f0 = normal_reflectance(eta);
  const Refraction r = fresnel_dielectric(cos_incident, eta);
  return {(r.reflectance - f0) / (1.0f - f0), schlick, r.cos_transmitted > 0.0f ? 0.0f : 1.0f,
          r.cos_transmitted};
}

// A combination of the functions of FresnelShape; linear, so that its albedos are combinations of
// theirs.
struct FresnelCurve {
  Color constant;
  Color exact;
  Color schlick;
  Color total;

  Color at(const FresnelShape& shape) const {
    return constant + exact * shape.exact + schlick * shape.schlick + total * shape.total;
  }
};

}  // namespace lumivec
