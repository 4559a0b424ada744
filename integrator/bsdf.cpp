#include "integrator/bsdf.h"

#include "integrator/sampling.h"

namespace lumivec {

Bsdf::Bsdf(const SurfaceParameters& surface, const V3f& geometric_normal, const V3f& /*wo*/,
           const AlbedoTables& /*tables*/, float /*specular_roughness*/, Transport /*transport*/)
    : geometric_normal_(geometric_normal), normal_(surface.normal), diffuse_(surface.base_color) {}

BsdfValue Bsdf::eval(const V3f& wi) const {
  BsdfValue value;
  const float cos_i = wi.dot(normal_);
  if (cos_i <= 0.0f || wi.dot(geometric_normal_) <= 0.0f) return value;
  value.non_specular = diffuse_ * (cos_i * inv_pi);
  value.pdf_non_specular = cos_i * inv_pi;
  return value;
}

bool Bsdf::sample(float /*u_lobe*/, const V2f& u, BsdfSample& sample) const {
  const V3f wi = sample_cosine_hemisphere(u);
  sample.wi = make_frame(normal_).to_world(wi);
  sample.weight = diffuse_;
  sample.pdf = cosine_hemisphere_pdf(wi.z);
  sample.kind = LobeKind::non_specular;
  sample.delta = false;
  sample.transmitted = false;
  return wi.z > 0.0f && sample.wi.dot(geometric_normal_) > 0.0f;
}

bool Bsdf::has(LobeKind kind) const {
  return kind == LobeKind::non_specular;
}

bool Bsdf::has_non_delta() const {
  return true;
}

Color Bsdf::thin_transmittance() const {
  return Color(0.0f);
}

}  // namespace lumivec
