// Evaluation: value and density of every lobe for one direction.
#include "integrator/bsdf.h"
#include "integrator/bsdf_color.h"
#include "integrator/ggx.h"
#include "integrator/sampling.h"

namespace lumivec {

// What the coat lets through of light from wi.
float Bsdf::coat_transmittance(const V3f& wi) const {
  if (coat_.strength <= 0.0f) return 1.0f;
  return coat_.transmittance(std::min(1.0f, std::abs(wi.dot(coat_frame_.n))));
}

// Probability that a facet that was drawn is reflected at, by the brightness of both outcomes.
float Bsdf::reflected_share(const Color& reflected, const Color& passed) const {
  if (!facets_transmit_) return 1.0f;
  const float r = mean(reflected);
  const float t = mean(passed);
  return r + t > 0.0f ? r / (r + t) : 0.0f;
}

// Share and tint of the light that a facet lets through.
Color Bsdf::passed(const FresnelShape& shape) const {
  if (!facets_transmit_ || (!thin_ && shape.total > 0.0f)) return Color(0.0f);
  return at_least_0(passing_ * (white() - dielectric_f0_ - dielectric_rise_ * shape.exact));
}

void Bsdf::add(BsdfValue& value, Lobe lobe, const Color& f_cos, float pdf) const {
  const auto kind = static_cast<std::size_t>(lobes_[lobe].kind);
  value.f_cos[kind] += f_cos;
  value.pdf[kind] += lobes_[lobe].probability * pdf;
}

float Bsdf::spread_pdf(const AlbedoTable& table, AlbedoColumn column, float cos_theta) const {
  return 0.5f * (cosine_hemisphere_pdf(cos_theta) + table.loss_pdf(column, row_));
}

BsdfValue Bsdf::eval(const V3f& wi) const {
  BsdfValue value;
  const float side = wi.dot(geometric_normal_);
  if (lambertian_) {
    const float cos_i = wi.dot(frame_.n);
    if (side <= 0.0f || cos_i <= 0.0f) return value;
    constexpr auto kind = static_cast<std::size_t>(LobeKind::diffuse);
    value.f_cos[kind] = diffuse_ * cos_i;
    value.pdf[kind] = cos_i * inv_pi;
    return value;
  }
  const V3f local = frame_.to_local(wi);
  if (side > 0.0f) {
    if (lobes_[coat].probability > 0.0f && !lobes_[coat].delta) eval_coat(wi, value);
    if (local.z > 0.0f) eval_reflection(wi, local, value);
  } else if (side < 0.0f && local.z < 0.0f && facets_transmit_) {
    if (thin_) {
      eval_thin_transmission(wi, local, value);
    } else {
      eval_refraction(wi, local, value);
    }
  }
  return value;
}

// f = F D G2 / (4 cos_o cos_i), of whose cosines only that of wo is left here.
void Bsdf::eval_coat(const V3f& wi, BsdfValue& value) const {
  const V3f i = coat_frame_.to_local(wi);
  const V3f& o = coat_local_wo_;
  if (i.z <= 0.0f) return;
  const V3f h = (o + i).normalized();
  const float density = ggx_density(h, coat_.alpha);
  const float f =
      coat_.strength * fresnel_dielectric(std::min(1.0f, o.dot(h)), coat_index).reflectance;
  const float f_cos = 0.25f * f * density * i.z *
                      smith_g2_over_cosines(o.z, coat_root_wo_, i.z, smith_root(i.z, coat_.alpha));
  add(value, coat, Color(f_cos), reflected_facet_pdf(density, o.z, coat_root_wo_));
}

Color Bsdf::diffuse_brdf(const V3f& wi) const {
  if (lambertian_) return diffuse_;
  const float cosine = std::min(1.0f, wi.dot(frame_.n));
  if (cosine <= 0.0f || lobes_[diffuse].probability <= 0.0f) return Color(0.0f);
  return diffuse_ * dielectric_remainder(base_albedo(cosine)) * coat_transmittance(wi);
}

void Bsdf::eval_reflection(const V3f& wi, const V3f& i, BsdfValue& value) const {
  const V3f& o = local_wo_;
  const float kept_i = coat_transmittance(wi);
  const float kept = std::min(coat_transmittance_wo_, kept_i);  // see couple_with_coat
  if (rough_ && lobes_[reflect].probability > 0.0f) {
    const V3f h = (o + i).normalized();
    const FresnelShape shape = fresnel_shape(std::min(1.0f, o.dot(h)), eta_);
    const Color f = at_least_0(reflectance_.at(shape));
    const float density = ggx_density(h, alpha_);
    const float f_cos = 0.25f * kept * density * i.z *
                        smith_g2_over_cosines(o.z, root_wo_, i.z, smith_root(i.z, alpha_));
    add(value, reflect, f * f_cos,
        reflected_share(f, passed(shape)) * reflected_facet_pdf(density, o.z, root_wo_));
  }
  const bool spreads = lobes_[spread].probability > 0.0f;
  const bool diffuses = lobes_[diffuse].probability > 0.0f;
  if (!spreads && !diffuses) return;
  const Albedo a = base_albedo(i.z);
  if (diffuses)
    add(value, diffuse, diffuse_ * dielectric_remainder(a) * (kept_i * i.z),
        cosine_hemisphere_pdf(i.z));
  if (spreads) {
    Color f = spread_ * (kept_i * std::max(0.0f, 1.0f - a.reflected));
    if (facets_transmit_ && !thin_) f += spread_glass_ * lost_in_glass(a) * kept;
    add(value, spread, f * i.z, spread_pdf(*table_, table_->column_of(i.z), i.z));
  }
}

// A sheet does not bend: its facets' reflection, mirrored through it, with what their reflection
// leaves.
void Bsdf::eval_thin_transmission(const V3f& wi, const V3f& i, BsdfValue& value) const {
  const V3f& o = local_wo_;
  const float kept = std::min(coat_transmittance_wo_, coat_transmittance(wi));
  const V3f h = V3f(o.x + i.x, o.y + i.y, o.z - i.z).normalized();
  const FresnelShape shape = fresnel_shape(std::min(1.0f, o.dot(h)), eta_);
  const Color f = at_least_0(reflectance_.at(shape));
  const Color t = passed(shape);
  const float density = ggx_density(h, alpha_);
  const float f_cos = 0.25f * kept * density * -i.z *
                      smith_g2_over_cosines(o.z, root_wo_, -i.z, smith_root(i.z, alpha_));
  add(value, reflect, t * f_cos,
      (1.0f - reflected_share(f, t)) * reflected_facet_pdf(density, o.z, root_wo_));
  if (lobes_[spread_through].probability <= 0.0f) return;
  const AlbedoColumn column = table_->column_of(-i.z);
  const float lost = std::max(0.0f, 1.0f - table_->at(column, row_).reflected);
  add(value, spread_through, spread_through_ * (kept * lost * -i.z),
      spread_pdf(*table_, column, -i.z));
}

// Walter et al. 2007, equations 17 and 21. The half vector there is −(o + η i), and the squared sum
// of the two products with it is its squared length.
void Bsdf::eval_refraction(const V3f& wi, const V3f& i, BsdfValue& value) const {
  const V3f& o = local_wo_;
  const float kept = std::min(coat_transmittance_wo_, coat_transmittance(wi)) * transport_scale_;
  if (lobes_[spread_through].probability > 0.0f) {
    const AlbedoColumn column = beyond_->column_of(-i.z);
    const Color f = spread_through_ * lost_in_glass(beyond_->at(column, row_));
    add(value, spread_through, f * (kept * -i.z), spread_pdf(*beyond_, column, -i.z));
  }
  const V3f sum = o + eta_ * i;
  const float length2 = sum.length2();
  if (length2 <= 0.0f) return;
  V3f h = sum / std::sqrt(length2);
  if (h.z < 0.0f) h = -h;
  const float o_h = std::min(1.0f, o.dot(h));
  const float i_h = -i.dot(h);
  if (o_h <= 0.0f || i_h <= 0.0f) return;
  const FresnelShape shape = fresnel_shape(o_h, eta_);
  const Color f = at_least_0(reflectance_.at(shape));
  const Color t = passed(shape);
  const float pdf =
      visible_normal_pdf(o_h, ggx_density(h, alpha_), o.z, root_wo_) * eta_ * eta_ * i_h / length2;
  add(value, reflect, t * (kept * pdf * smith_g1(-i.z, smith_root(i.z, alpha_))),
      (1.0f - reflected_share(f, t)) * pdf);
}

}  // namespace lumivec
