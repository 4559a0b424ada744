// How a surface scatters light at a point: coat over (metal | dielectric reflection over (diffuse |
// transmission)).
//
// eval, pdf and sample agree with each other (χ²-tested). Every lobe has one kind, non-specular (D)
// or specular (S), which decides the term that the light it scatters belongs to; the two kinds are
// evaluated and sampled apart, so that a path's term follows from the kinds of its events. Source:
// Walter et al. 2007 (GGX, rough refraction), Heitz 2018 (visible normals), Kulla and Conty 2017
// (energy).
#pragma once

#include <cstdint>

#include "integrator/albedo_tables.h"
#include "integrator/frame.h"
#include "loader/scene.h"

namespace lumivec {

enum class LobeKind : std::uint8_t { non_specular, specular };

// Radiance is scaled by the squared ratio of indices where it crosses a boundary, importance (light
// paths) is not.
enum class Transport : std::uint8_t { radiance, importance };

// A material at a point, textures applied. Ranges as in Material; colours clamped to [0, 1] where
// they are reflectances.
struct SurfaceParameters {
  V3f normal;       // unit shading normal on the side that wo is on
  V3f coat_normal;  // likewise, of the coat
  Color base_color{1.0f};
  float metallic = 0.0f;
  float roughness = 1.0f;
  float specular = 1.0f;
  Color specular_color{1.0f};
  float transmission = 0.0f;
  bool thin_walled = true;
  float clearcoat = 0.0f;
  float clearcoat_roughness = 0.0f;
  float eta =
      1.5f;  // index of refraction beyond the surface over that on wo's side, > 0; 0: F0 = 1
};

// f · |cosθ| and the density of sample(), per kind. Delta lobes have neither.
struct BsdfValue {
  Color non_specular{0.0f};
  Color specular{0.0f};
  float pdf_non_specular = 0.0f;  // sr⁻¹, includes the probability of choosing the kind
  float pdf_specular = 0.0f;      // likewise
};

struct BsdfSample {
  V3f wi;              // world space, unit
  Color weight{0.0f};  // f · |cosθ| / pdf of the sampled kind alone
  float pdf = 0.0f;  // sr⁻¹, of the sampled kind, includes the probability of choosing it; delta:
                     // that probability
  LobeKind kind = LobeKind::non_specular;
  bool delta = false;        // no density: eval and light sampling cannot find this direction
  bool transmitted = false;  // wi is on the other side of the surface
};

// The scattering of one hit: the material at a point, seen from wo. Plain value, built once per
// hit, no allocation.
class Bsdf {
 public:
  // geometric_normal: unit, on wo's side. wo: unit, away from the surface. A direction is reflected
  // or transmitted by the geometric normal; where the shading normal disagrees the value is 0.
  // specular_roughness as in RenderSettings. tables must outlive this.
  Bsdf(const SurfaceParameters& surface, const V3f& geometric_normal, const V3f& wo,
       const AlbedoTables& tables, float specular_roughness,
       Transport transport = Transport::radiance);

  // f · |cosθ| for light from unit direction wi, and the density with which sample() finds wi,
  // without delta lobes.
  BsdfValue eval(const V3f& wi) const;

  // Draws a direction; u_lobe and u in [0, 1). False: absorbed, and the path ends there.
  bool sample(float u_lobe, const V2f& u, BsdfSample& sample) const;

  // Whether any lobe of that kind is there, delta lobes included.
  bool has(LobeKind kind) const;

  // Whether eval can differ from 0: light sampling may find something here.
  bool has_non_delta() const;

  // Weight of the straight-through delta lobe of a smooth thin wall, 0 if there is none.
  Color thin_transmittance() const;

 private:
  V3f geometric_normal_;
  V3f normal_;
  Color diffuse_;
};

}  // namespace lumivec
