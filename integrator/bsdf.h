// How a surface scatters light at a point: coat over (metal | dielectric reflection over (diffuse |
// transmission)).
//
// eval, pdf and sample agree with each other (χ²-tested). Every lobe has one kind, non-specular (D:
// broad or glossy) or specular (S), which decides the term that the light it scatters belongs to;
// the kinds are evaluated and sampled apart, so that a path's term follows from the kinds of its
// events. Reciprocal; what does not absorb loses nothing but, under a coat, a few per cent of rough
// reflection and transmission.
//
// Source: Walter et al. 2007 (GGX, rough refraction), Heitz 2018 (visible normals), Kulla and Conty
// 2017 (energy). Parameters are those of glTF 2.0's metallic-roughness material and its extensions.
// A purely diffuse hit costs about 30 ns (construct, eval, sample), a rough dielectric 250 ns,
// rough glass 400 ns.
#pragma once

#include <array>
#include <cstdint>

#include "integrator/albedo_tables.h"
#include "integrator/frame.h"
#include "integrator/fresnel.h"
#include "loader/scene.h"

namespace lumivec {

// All but specular lobes are non-specular (D). Glossy are those that are sharp enough to throw
// light in patches that paths from the eye find badly; diffuse is the one lobe that hardly depends
// on the view.
enum class LobeKind : std::uint8_t { diffuse, broad, glossy, specular };
constexpr std::size_t lobe_kind_count = 4;
constexpr bool is_broad(LobeKind kind) {
  return kind == LobeKind::diffuse || kind == LobeKind::broad;
}
// Reflections that are not specular are glossy below this perceptual roughness, if they return at
// least this share of the light at normal incidence: weaker ones throw patches that nobody sees.
constexpr float glossy_roughness = 0.35f;
constexpr float glossy_reflectance = 0.1f;

// Radiance is scaled by the squared ratio of indices where it crosses a boundary, importance (light
// paths) is not.
constexpr std::uint32_t kind_bit(LobeKind kind) {
  return 1u << static_cast<unsigned>(kind);
}

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
  // Index of refraction beyond the surface over that on wo's side, > 0; 0: F0 = 1. Ratios of the
  // indices that tables were made of are exact. A thin wall has the same index seen from either
  // side.
  float eta = 1.5f;
};

// f · |cosθ| and the density of sample(), per kind. Delta lobes have neither.
struct BsdfValue {
  std::array<Color, lobe_kind_count> f_cos;
  std::array<float, lobe_kind_count> pdf{};  // sr⁻¹, includes the probability of choosing the kind

  BsdfValue() { f_cos.fill(Color(0.0f)); }
  const Color& of(LobeKind kind) const { return f_cos[static_cast<std::size_t>(kind)]; }
  float pdf_of(LobeKind kind) const { return pdf[static_cast<std::size_t>(kind)]; }
  Color of_broad() const { return of(LobeKind::diffuse) + of(LobeKind::broad); }
  Color non_specular() const { return of_broad() + of(LobeKind::glossy); }
};

struct BsdfSample {
  V3f wi;              // world space, unit
  Color weight{0.0f};  // f · |cosθ| / pdf of the sampled kind alone
  // sr⁻¹, of the sampled kind, includes the probability of choosing it; delta: the probability of
  // choosing that lobe.
  float pdf = 0.0f;
  LobeKind kind = LobeKind::diffuse;
  bool delta = false;        // no density: eval and light sampling cannot find this direction
  bool transmitted = false;  // wi is on the other side of the surface
};

// The scattering of one hit: the material at a point, seen from wo. Plain value, built once per
// hit, no allocation.
//
// The lobes, each with one kind: the coat's reflection by the coat's roughness; the base's
// reflection and transmission by the base's; the diffuse lobe is always non-specular. What
// microfacets lose by single scattering comes back in two broad lobes that belong to the base's
// reflection and transmission and have their kind.
class Bsdf {
 public:
  // geometric_normal: unit, on wo's side. wo: unit, away from the surface. A direction is reflected
  // or transmitted by the geometric normal; where the shading normal disagrees the value is 0.
  // Shading normals that wo is not above are bent towards it. tables must outlive this.
  // specular_roughness as in RenderSettings.
  Bsdf(const SurfaceParameters& surface, const V3f& geometric_normal, const V3f& wo,
       const AlbedoTables& tables, float specular_roughness,
       Transport transport = Transport::radiance);

  // f · |cosθ| for light from unit direction wi, and the density with which sample() finds wi,
  // without delta lobes.
  BsdfValue eval(const V3f& wi) const;

  // Draws a direction; u_lobe and u in [0, 1). False: absorbed, and the path ends there.
  bool sample(float u_lobe, const V2f& u, BsdfSample& sample) const;
  // The same for lambertian surfaces, of what sample_cosine_hemisphere makes of u.
  bool sample_lambertian(const V3f& cosine_direction, BsdfSample& sample) const;

  // The same surface with the lobes of some kinds alone, bit 1 << kind each: eval leaves out
  // others, sample never draws them.
  Bsdf with_only(std::uint32_t kinds) const;

  // How many lobes there are if all of them are delta lobes, else 0.
  int delta_lobe_count() const;
  // The same surface, of delta lobes alone: sample draws each of them with a probability that is a
  // multiple of 1/parts, near its share of the light and never 0. So `parts` samples with evenly
  // spread u_lobe find every lobe. parts: at least delta_lobe_count().
  Bsdf with_probabilities_in_parts(int parts) const;

  // f of the diffuse lobe for light from unit direction wi, sr⁻¹; 0 below its normal.
  Color diffuse_brdf(const V3f& wi) const;
  // The shading normal, unit, as it was bent to the view.
  const V3f& normal() const { return frame_.n; }

  // Whether any lobe of that kind is there, delta lobes included.
  bool has(LobeKind kind) const;
  bool has_broad() const { return has(LobeKind::diffuse) || has(LobeKind::broad); }
  bool has_non_specular() const { return has_broad() || has(LobeKind::glossy); }

  // Whether there is nothing but the diffuse lobe, with a constant f.
  bool lambertian() const { return lambertian_; }

  // Whether eval can differ from 0: light sampling may find something here.
  bool has_non_delta() const;

  // Weight of the straight-through delta lobe of a smooth thin wall, 0 if there is none.
  Color thin_transmittance() const;

 private:
  // What sample() chooses between. reflect and transmit are one choice where both are rough: the
  // facet that was drawn decides.
  enum Lobe : std::uint8_t { coat, reflect, transmit, spread, spread_through, diffuse, lobe_count };

  struct LobeState {
    float probability;  // 0: the lobe is not there
    LobeKind kind;
    bool delta = false;
  };

  struct Coat {
    float strength;  // 0: none, and nothing else is set
    float alpha;
    AlbedoRow row;
    const AlbedoTable* table;

    // Directional albedo, and what light of that direction keeps when it crosses.
    float reflectance(float cos_theta) const;
    float transmittance(float cos_theta) const;
  };

  // Single-bounce albedos of the base at one direction, and what follows from them: what its
  // dielectric reflection leaves; what is neither reflected nor transmitted by one bounce.
  Albedo base_albedo(float cos_theta) const;
  Color dielectric_remainder(const Albedo& a) const;
  Color lost_in_glass(const Albedo& a) const;

  using Weights = std::array<float, lobe_count>;  // albedos of the lobes as wo sees them

  void set_coat(const SurfaceParameters& surface, const AlbedoTables& tables, Weights& weights);
  void set_base(const SurfaceParameters& surface, const AlbedoTables& tables, Weights& weights);
  void set_spread(const SurfaceParameters& surface, const Albedo& at_wo, const Albedo& average,
                  Weights& weights);
  void set_glass_spread(const SurfaceParameters& surface, const Albedo& at_wo,
                        const Albedo& average, Weights& weights);
  void couple_with_coat(const Color& remainder, const Albedo& average);
  void set_lobes(const SurfaceParameters& surface, float specular_roughness,
                 const Weights& weights);

  float coat_transmittance(const V3f& wi) const;
  float reflected_share(const Color& reflected, const Color& passed) const;
  Color passed(const FresnelShape& shape) const;
  void add(BsdfValue& value, Lobe lobe, const Color& f_cos, float pdf) const;
  void eval_coat(const V3f& wi, BsdfValue& value) const;
  void eval_reflection(const V3f& wi, const V3f& local, BsdfValue& value) const;
  void eval_thin_transmission(const V3f& wi, const V3f& local, BsdfValue& value) const;
  void eval_refraction(const V3f& wi, const V3f& local, BsdfValue& value) const;
  bool sample_facets(float u_side, const V2f& u, V3f& local) const;
  V3f sample_spread(const AlbedoTable& table, const V2f& u) const;
  float spread_pdf(const AlbedoTable& table, AlbedoColumn column, float cos_theta) const;
  bool sample_delta(Lobe lobe, BsdfSample& sample) const;

  V3f geometric_normal_;
  V3f wo_;
  Frame frame_;      // around the base's shading normal
  Color diffuse_;    // f of the diffuse lobe, but for what depends on wi
  bool lambertian_;  // nothing but the diffuse lobe: the rest is not set

  bool thin_ = false;
  bool rough_ = false;            // the base has microfacets
  bool facets_transmit_ = false;  // … through which light passes
  V3f local_wo_;
  float alpha_;
  float root_wo_;  // smith_root
  float eta_;
  AlbedoRow row_;
  const AlbedoTable* table_;
  const AlbedoTable* beyond_;  // of 1 / eta_
  Color dielectric_f0_;
  Color dielectric_rise_;     // F90 − F0
  Color dielectric_spread_;   // share of what facets lose that their dielectric reflection returns
  FresnelCurve reflectance_;  // of dielectric and metal, by their shares
  Color passing_;             // share and tint of the light that passes the boundary
  Color straight_;            // f · |cosθ| of the delta lobe of transmission below the coat
  float transport_scale_;     // of light that crosses into the other index
  Color spread_;              // f of the broad lobes, but for what depends on wi
  Color spread_glass_;
  Color spread_through_;

  Coat coat_;
  Frame coat_frame_;
  V3f coat_local_wo_;
  float coat_root_wo_;
  float coat_transmittance_wo_;

  LobeState lobes_[lobe_count];
};

}  // namespace lumivec
