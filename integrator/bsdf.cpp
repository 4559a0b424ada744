// Construction: from a material's parameters to the lobes, their factors and the probabilities of
// choosing them.
#include "integrator/bsdf.h"

#include <cmath>
#include <limits>

#include "integrator/bsdf_color.h"
#include "integrator/ggx.h"
#include "integrator/sampling.h"

namespace lumivec {

namespace {

// Below this, what facets lose is noise of the tables and is not given back.
constexpr float smallest_loss = 1e-5f;

// Cosine-weighted mean of (1 − c)⁵: 2 ∫ (1 − μ)⁵ μ dμ.
constexpr float schlick_average = 1.0f / 21.0f;

// Microfacets of a boundary whose index is nearly matched reflect little and bend little: the
// transmitted lobe is as much narrower than the facets' slopes as 1 − 1/n is small. It is a delta
// lobe where it is narrower than that of an index of 1.5 at delta_roughness.
constexpr float common_bending = 1.0f - 1.0f / coat_index;

// The reflection is chosen at least this often: its albedo may be all but 0 where single
// directions are not.
constexpr float least_probability = 0.02f;

bool transmits_straight(float alpha, float eta) {
  const float bending = 1.0f - std::min(eta, 1.0f / eta);
  return alpha * std::min(1.0f, bending / common_bending) < delta_roughness * delta_roughness;
}

// The direction nearest to n that wo is above.
V3f bend_to_view(const V3f& n, const V3f& wo, const V3f& geometric_normal) {
  if (n.dot(wo) >= min_view_cosine) return n;
  constexpr float parallel = 1e-6f;
  V3f across = n - n.dot(wo) * wo;
  if (across.length2() < parallel) across = geometric_normal - geometric_normal.dot(wo) * wo;
  if (across.length2() < parallel) return wo;
  constexpr float target = 2.0f * min_view_cosine;  // above the limit by more than rounding
  return (across.normalized() * std::sqrt(1.0f - target * target) + target * wo).normalized();
}

// The normal nearest to n about which wo is mirrored to above the surface: where interpolated or
// mapped normals would send a reflection below it, smooth surfaces would be black. The mirror
// direction is lifted to just above the surface, and the normal is half way from it to wo.
V3f bend_to_reflect(const V3f& n, const V3f& wo, const V3f& geometric_normal) {
  constexpr float lowest_elevation = 0.01f;
  const float wo_elevation = wo.dot(geometric_normal);
  const float lowest = std::min(lowest_elevation, 0.9f * wo_elevation);
  const V3f mirrored = 2.0f * n.dot(wo) * n - wo;
  const float elevation = mirrored.dot(geometric_normal);
  if (elevation >= lowest) return n;
  const V3f flat = mirrored - elevation * geometric_normal;
  const float length2 = flat.length2();
  if (length2 <= 0.0f) return geometric_normal;
  const V3f lifted =
      flat * std::sqrt((1.0f - lowest * lowest) / length2) + lowest * geometric_normal;
  const V3f half = wo + lifted;
  const float half_length2 = half.length2();
  // Opposite directions along the surface: halfway between them is the surface's own normal.
  if (half_length2 < min_view_cosine * min_view_cosine) return geometric_normal;
  return half / std::sqrt(half_length2);
}

// Reflectance of all bounces but the first, over what the first loses: with average facet
// reflectance F and average single-bounce albedo E, the series F (1 − E) F E + … divided by 1 − E.
// Source: Kulla and Conty 2017.
Color multiple_bounces(const Color& f, float albedo_average) {
  const Color lost = f * (1.0f - albedo_average);
  return at_most_1(f * f * albedo_average / (white() - lost));
}

}  // namespace

float Bsdf::Coat::reflectance(float cos_theta) const {
  if (row.row == 0) return fresnel_dielectric(cos_theta, coat_index).reflectance;
  const float f0 = normal_reflectance(coat_index);
  const Albedo a = table->at(table->column_of(cos_theta), row);
  return f0 * a.reflected + (1.0f - f0) * a.reflected_exact;
}

// Light that diffuses beneath passes the coat twice, and each crossing keeps 1 − E of its
// direction, which is reciprocal.
float Bsdf::Coat::transmittance(float cos_theta) const {
  return std::max(0.0f, 1.0f - strength * reflectance(cos_theta));
}

Albedo Bsdf::base_albedo(float cos_theta) const {
  if (!rough_) return smooth_albedo(cos_theta, eta_);
  Albedo a = table_->at(table_->column_of(cos_theta), row_);
  if (eta_ == 0.0f) a.reflected_exact = a.reflected_schlick;
  return a;
}

Color Bsdf::dielectric_remainder(const Albedo& a) const {
  return at_least_0(white() - dielectric_f0_ * a.reflected - dielectric_rise_ * a.reflected_exact -
                    dielectric_spread_ * (1.0f - a.reflected));
}

Color Bsdf::lost_in_glass(const Albedo& a) const {
  const float left = 1.0f - a.reflected_total - a.transmitted;
  return at_least_0(
      Color(left) - dielectric_f0_ * (a.reflected - a.reflected_total - a.transmitted) -
      dielectric_rise_ * (a.reflected_exact - a.reflected_total - a.transmitted_exact));
}

Bsdf::Bsdf(const SurfaceParameters& surface, const V3f& geometric_normal, const V3f& wo,
           const AlbedoTables& tables, float specular_roughness, Transport transport)
    : geometric_normal_(geometric_normal), wo_(wo) {
  const V3f normal = bend_to_view(surface.normal, wo, geometric_normal);
  lambertian_ = surface.specular == 0.0f && surface.metallic == 0.0f &&
                surface.transmission == 0.0f && surface.clearcoat == 0.0f;
  frame_ = make_frame(lambertian_ ? normal
                                  : bend_to_view(bend_to_reflect(normal, wo, geometric_normal), wo,
                                                 geometric_normal));
  if (lambertian_) {
    diffuse_ = at_most_1(surface.base_color) * inv_pi;
    return;
  }
  eta_ = surface.eta;
  transport_scale_ = transport == Transport::radiance && !surface.thin_walled && eta_ > 0.0f
                         ? 1.0f / (eta_ * eta_)
                         : 1.0f;
  Weights weights{};
  set_coat(surface, tables, weights);
  set_base(surface, tables, weights);
  set_lobes(surface, specular_roughness, weights);
}

void Bsdf::set_coat(const SurfaceParameters& surface, const AlbedoTables& tables,
                    Weights& weights) {
  coat_.strength = surface.clearcoat;
  coat_transmittance_wo_ = 1.0f;
  if (coat_.strength <= 0.0f) return;
  const V3f normal = bend_to_view(surface.coat_normal, wo_, geometric_normal_);
  coat_frame_ = make_frame(
      bend_to_view(bend_to_reflect(normal, wo_, geometric_normal_), wo_, geometric_normal_));
  coat_local_wo_ = coat_frame_.to_local(wo_);
  const float roughness = std::min(surface.clearcoat_roughness, 1.0f);
  coat_.alpha = roughness * roughness;
  coat_.row = AlbedoTable::row_of(roughness);
  coat_.table = &tables.nearest(coat_index);
  coat_root_wo_ = smith_root(coat_local_wo_.z, coat_.alpha);
  coat_transmittance_wo_ = coat_.transmittance(coat_local_wo_.z);
  weights[coat] = 1.0f - coat_transmittance_wo_;
}

void Bsdf::set_base(const SurfaceParameters& surface, const AlbedoTables& tables,
                    Weights& weights) {
  const float metal = surface.metallic;
  const float dielectric = 1.0f - metal;
  const float roughness = std::min(surface.roughness, 1.0f);
  const Color base = at_most_1(surface.base_color);
  thin_ = surface.thin_walled;
  rough_ = roughness >= delta_roughness;
  alpha_ = roughness * roughness;
  row_ = AlbedoTable::row_of(roughness);
  local_wo_ = frame_.to_local(wo_);
  root_wo_ = smith_root(local_wo_.z, alpha_);
  table_ = &tables.nearest(eta_);
  beyond_ = !thin_ && eta_ > 0.0f ? &tables.nearest(1.0f / eta_) : table_;

  dielectric_f0_ = at_most_1(surface.specular_color * normal_reflectance(eta_)) * surface.specular;
  dielectric_rise_ = eta_ == 1.0f ? Color(0.0f) : Color(surface.specular) - dielectric_f0_;
  // A boundary that reflects everything has no index to refract with.
  const bool passes = thin_ || eta_ > 0.0f;
  passing_ = passes ? base * (dielectric * surface.transmission) : Color(0.0f);
  const bool bends = !thin_ && passes && !(rough_ && transmits_straight(alpha_, eta_));
  facets_transmit_ = rough_ && (thin_ || bends) && !is_black(passing_);
  // Where refraction is impossible, light that would be transmitted is reflected whatever the
  // strength of the reflection.
  const float total = bends ? dielectric * surface.transmission * (1.0f - surface.specular) : 0.0f;
  reflectance_ = {dielectric_f0_ * dielectric + base * metal, dielectric_rise_ * dielectric,
                  (white() - base) * metal, Color(total)};

  const Albedo at_wo = base_albedo(local_wo_.z);
  Albedo average = table_->average(row_);
  if (eta_ == 0.0f) average.reflected_exact = average.reflected_schlick;
  set_spread(surface, at_wo, average, weights);

  Color remainder_wo(0.0f), remainder(0.0f);
  diffuse_ = Color(0.0f);
  if (dielectric > 0.0f) {
    remainder_wo = dielectric_remainder(at_wo);
    remainder = dielectric_remainder(average);
    const Color diffused = base * remainder_wo * (dielectric * (1.0f - surface.transmission));
    diffuse_ = quotient(diffused * inv_pi, remainder);
    weights[diffuse] = mean(diffused) * coat_transmittance_wo_;
  }

  float facets = mean(reflectance_.constant) * at_wo.reflected +
                 mean(reflectance_.exact) * at_wo.reflected_exact +
                 mean(reflectance_.schlick) * at_wo.reflected_schlick +
                 mean(reflectance_.total) * at_wo.reflected_total;
  if (facets_transmit_) {
    const float one = thin_ ? at_wo.reflected : at_wo.transmitted;
    const float exact = thin_ ? at_wo.reflected_exact : at_wo.transmitted_exact;
    facets += mean(passing_ * ((white() - dielectric_f0_) * one - dielectric_rise_ * exact));
  } else {
    const bool refuses = bends && at_wo.reflected_total > 0.0f;
    straight_ = refuses ? Color(0.0f) : passing_ * remainder_wo;
    weights[transmit] = mean(straight_) * coat_transmittance_wo_;
  }
  weights[reflect] = std::max(0.0f, facets) * coat_transmittance_wo_;
  if (coat_.strength > 0.0f) couple_with_coat(remainder, average);
}

// What facets lose by single scattering goes into a broad lobe (1 − E(o)) (1 − E(i)) / (π (1 −
// Eavg)), which is reciprocal and loses nothing where nothing is absorbed. Source: Kulla and Conty
// 2017.
void Bsdf::set_spread(const SurfaceParameters& surface, const Albedo& at_wo, const Albedo& average,
                      Weights& weights) {
  dielectric_spread_ = spread_ = spread_glass_ = spread_through_ = Color(0.0f);
  const float lost = 1.0f - average.reflected;
  if (!rough_ || lost < smallest_loss) return;
  const float lost_wo = std::max(0.0f, 1.0f - at_wo.reflected);
  const float metal = surface.metallic;
  const bool glass = facets_transmit_ && !thin_;
  const float dielectric = (1.0f - metal) * (glass ? 1.0f - surface.transmission : 1.0f);
  const Color base = at_most_1(surface.base_color);
  Color returned(0.0f);
  if (metal < 1.0f) {
    const float exact_average =
        eta_ == 0.0f ? schlick_average : table_->average(AlbedoRow()).reflected_exact;
    dielectric_spread_ =
        multiple_bounces(dielectric_f0_ + dielectric_rise_ * exact_average, average.reflected);
    returned = dielectric_spread_ * (dielectric * lost_wo);
  }
  if (metal > 0.0f) {
    const Color metal_spread =
        multiple_bounces(base + (white() - base) * schlick_average, average.reflected);
    returned += metal_spread * (metal * lost_wo);
  }
  spread_ = returned * (inv_pi / lost);
  weights[spread] = mean(returned) * coat_transmittance_wo_;
  if (!facets_transmit_) return;
  if (thin_) {
    const Color passed = passing_ * (white() - dielectric_spread_) * lost_wo;
    spread_through_ = passed * (inv_pi / lost);
    weights[spread_through] = mean(passed) * coat_transmittance_wo_;
  } else {
    set_glass_spread(surface, at_wo, average, weights);
  }
}

// Of a clear boundary, light is lost by reflection and transmission together, differently on its
// two sides. What is lost on this side, M(o), leaves on both: by M(o) M(i) / Mavg on this one, M(o)
// M'(i) / M'avg on the other. Reciprocity across the boundary asks that the shares that pass be in
// the ratio η² M'avg : Mavg; the average transmittances of smooth boundaries are as η² : 1, so that
// the share is the transmittance on the side that loses most, and less on the other.
void Bsdf::set_glass_spread(const SurfaceParameters& surface, const Albedo& at_wo,
                            const Albedo& average, Weights& weights) {
  const Color lost_wo = lost_in_glass(at_wo);
  const Color here = lost_in_glass(average);
  const Color there = lost_in_glass(beyond_->average(row_));
  const AlbedoTable& outer = eta_ >= 1.0f ? *table_ : *beyond_;
  const Color transmittance =
      (white() - dielectric_f0_ - dielectric_rise_ * outer.average(AlbedoRow()).reflected_exact) *
      (eta_ >= 1.0f ? 1.0f : eta_ * eta_);
  const Color larger = at_least(here, there);
  const Color share = quotient(transmittance * there, larger);
  const float glass = (1.0f - surface.metallic) * surface.transmission;
  const Color returned = (white() - share) * lost_wo * glass;
  spread_glass_ = quotient(returned * inv_pi, here);
  spread_through_ = quotient(passing_ * transmittance * lost_wo * inv_pi, larger);
  weights[spread] += mean(returned) * coat_transmittance_wo_;
  weights[spread_through] = mean(passing_ * share * lost_wo) * coat_transmittance_wo_;
}

// A coat is alike on both faces of what it covers. Light that comes from o and leaves in direction
// i passes it twice. Lobes that forget where light came from take the factor (1 − Ec(o)) (1 −
// Ec(i)) / N, in which N, the average of 1 − Ec(i) over the lobe, accounts for the light between
// coat and base: nothing is lost. The others take the smaller of both transmittances, which is
// right where the directions are mirrored and never gains.
void Bsdf::couple_with_coat(const Color& remainder, const Albedo& average) {
  CoatedAlbedo both = table_->coated_average(row_, coat_.row);
  if (eta_ == 0.0f) both.reflected_exact = both.reflected_schlick;
  // Where the coat's normal is another the averages do not hold; the largest transmittance is then
  // the safe N. From half a radian on nothing of the averages is left; in between a blend keeps
  // surfaces smooth.
  const float tilt = std::min(1.0f, 2.0f * (coat_frame_.n - frame_.n).length());
  const float largest = coat_.transmittance(1.0f);
  const auto normalised = [&](const Color& kept) {
    return kept * (1.0f - tilt) + Color(tilt * largest);
  };
  const Color diffuse_loss = quotient(both.coat * (white() - dielectric_spread_) -
                                          (dielectric_f0_ - dielectric_spread_) * both.reflected -
                                          dielectric_rise_ * both.reflected_exact,
                                      remainder);
  diffuse_ = quotient(diffuse_ * coat_transmittance_wo_,
                      normalised(white() - diffuse_loss * coat_.strength));
  const float lost = 1.0f - average.reflected;
  if (is_black(spread_)) return;
  const float spread_loss = (both.coat - both.reflected) / lost;
  spread_ = quotient(spread_ * coat_transmittance_wo_,
                     normalised(Color(1.0f - spread_loss * coat_.strength)));
}

void Bsdf::set_lobes(const SurfaceParameters& surface, float specular_roughness,
                     const Weights& weights) {
  const float others = weights[coat] + weights[transmit] + weights[spread] +
                       weights[spread_through] + weights[diffuse];
  const bool reflects = !is_black(reflectance_.constant) || !is_black(reflectance_.exact) ||
                        !is_black(reflectance_.schlick);
  const float facets =
      reflects ? std::max(weights[reflect], least_probability * (others + weights[reflect]))
               : weights[reflect];
  const float total = others + facets;
  const float scale = total > 0.0f ? 1.0f / total : 0.0f;
  const bool returns_much =
      reflects &&
      mean(at_least_0(reflectance_.at(fresnel_shape(1.0f, eta_)))) >= glossy_reflectance;
  const auto kind = [=](float roughness, bool strong) {
    const bool specular = roughness < std::max(specular_roughness, delta_roughness);
    if (specular) return LobeKind::specular;
    return roughness < glossy_roughness && strong ? LobeKind::glossy : LobeKind::broad;
  };
  const LobeKind base = kind(surface.roughness, returns_much || facets_transmit_);
  const LobeKind base_spread = base == LobeKind::specular ? base : LobeKind::broad;
  const bool smooth_coat = surface.clearcoat_roughness < delta_roughness;
  lobes_[coat] = {weights[coat] * scale, kind(surface.clearcoat_roughness, false), smooth_coat};
  lobes_[reflect] = {facets * scale, base, !rough_};
  lobes_[transmit] = {weights[transmit] * scale, LobeKind::specular, true};
  lobes_[spread] = {weights[spread] * scale, base_spread, false};
  lobes_[spread_through] = {weights[spread_through] * scale, base_spread, false};
  lobes_[diffuse] = {weights[diffuse] * scale, LobeKind::diffuse, false};
}

Bsdf Bsdf::with_only(std::uint32_t kinds) const {
  Bsdf result = *this;
  if (lambertian_) {
    if ((kinds & kind_bit(LobeKind::diffuse)) == 0) result.diffuse_ = Color(0.0f);
    return result;
  }
  float kept = 0.0f;
  for (LobeState& lobe : result.lobes_) {
    if ((kinds & kind_bit(lobe.kind)) == 0) lobe.probability = 0.0f;
    kept += lobe.probability;
  }
  const float scale = kept > 0.0f ? 1.0f / kept : 0.0f;
  for (LobeState& lobe : result.lobes_) lobe.probability *= scale;
  return result;
}

int Bsdf::delta_lobe_count() const {
  if (lambertian_) return 0;
  int count = 0;
  for (const LobeState& lobe : lobes_) {
    if (lobe.probability <= 0.0f) continue;
    if (!lobe.delta) return 0;
    ++count;
  }
  return count;
}

Bsdf Bsdf::with_probabilities_in_parts(int parts) const {
  Bsdf result = *this;
  std::array<int, lobe_count> has{};
  int left = parts;
  for (std::size_t i = 0; i < lobe_count; ++i) {
    has[i] = lobes_[i].probability > 0.0f ? 1 : 0;
    left -= has[i];
  }
  // Each further part to the lobe that is furthest below its share.
  for (; left > 0; --left) {
    std::size_t neediest = 0;
    float need = -std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < lobe_count; ++i) {
      const float missing =
          lobes_[i].probability * static_cast<float>(parts) - static_cast<float>(has[i]);
      if (lobes_[i].probability <= 0.0f || missing <= need) continue;
      need = missing;
      neediest = i;
    }
    ++has[neediest];
  }
  for (std::size_t i = 0; i < lobe_count; ++i)
    result.lobes_[i].probability = static_cast<float>(has[i]) / static_cast<float>(parts);
  return result;
}

bool Bsdf::has(LobeKind kind) const {
  if (lambertian_) return kind == LobeKind::diffuse && !is_black(diffuse_);
  for (const LobeState& lobe : lobes_)
    if (lobe.probability > 0.0f && lobe.kind == kind) return true;
  return false;
}

bool Bsdf::has_non_delta() const {
  if (lambertian_) return !is_black(diffuse_);
  for (const LobeState& lobe : lobes_)
    if (lobe.probability > 0.0f && !lobe.delta) return true;
  return false;
}

Color Bsdf::thin_transmittance() const {
  if (lambertian_ || !thin_ || lobes_[transmit].probability <= 0.0f) return Color(0.0f);
  return straight_ * coat_transmittance_wo_;
}

}  // namespace lumivec
