// Sampling: a lobe by its albedo, a direction by the lobe.
#include "integrator/bsdf.h"
#include "integrator/bsdf_color.h"
#include "integrator/ggx.h"
#include "integrator/sampling.h"

namespace lumivec {

bool Bsdf::sample_lambertian(const V3f& cosine_direction, BsdfSample& sample) const {
  sample.wi = frame_.to_world(cosine_direction);
  sample.weight = diffuse_ * pi;
  sample.pdf = cosine_direction.z * inv_pi;
  sample.kind = LobeKind::diffuse;
  sample.delta = false;
  sample.transmitted = false;
  return cosine_direction.z > 0.0f && sample.wi.dot(geometric_normal_) > 0.0f &&
         !is_black(diffuse_);
}

bool Bsdf::sample(float u_lobe, const V2f& u, BsdfSample& sample) const {
  if (lambertian_) return sample_lambertian(sample_cosine_hemisphere(u), sample);
  sample.delta = false;

  int chosen = -1;
  for (int lobe = 0; lobe < lobe_count; ++lobe) {
    const float p = lobes_[lobe].probability;
    if (p <= 0.0f) continue;
    chosen = lobe;  // the last one stays where rounding lets u_lobe run past the end
    if (u_lobe < p) break;
    u_lobe -= p;
  }
  if (chosen < 0) return false;
  const Lobe lobe = static_cast<Lobe>(chosen);
  sample.kind = lobes_[lobe].kind;
  if (lobes_[lobe].delta) return sample_delta(lobe, sample);

  bool transmitted = lobe == spread_through;
  V3f wi;
  switch (lobe) {
    case coat: {
      const V3f h = sample_visible_normal(coat_local_wo_, coat_.alpha, u);
      const V3f local = lumivec::reflect(coat_local_wo_, h);
      if (local.z <= 0.0f) return false;
      wi = coat_frame_.to_world(local);
      break;
    }
    case reflect: {
      V3f local;
      if (!sample_facets(u_lobe / lobes_[lobe].probability, u, local)) return false;
      transmitted = local.z < 0.0f;
      wi = frame_.to_world(local);
      break;
    }
    case spread:
      wi = frame_.to_world(sample_spread(*table_, u));
      break;
    case spread_through:
      wi = frame_.to_world(-sample_spread(thin_ ? *table_ : *beyond_, u));
      break;
    default:
      wi = frame_.to_world(sample_cosine_hemisphere(u));
  }
  sample.wi = wi.normalized();
  sample.transmitted = sample.wi.dot(geometric_normal_) < 0.0f;
  if (sample.transmitted != transmitted) return false;
  const BsdfValue value = eval(sample.wi);
  sample.pdf = value.pdf_of(sample.kind);
  if (!(sample.pdf > 0.0f)) return false;
  sample.weight = value.of(sample.kind) / sample.pdf;
  return !is_black(sample.weight);
}

// The broad lobes are as 1 − E: of smooth surfaces only what grazes, of rough ones about a cosine.
// Half the samples each.
V3f Bsdf::sample_spread(const AlbedoTable& table, const V2f& u) const {
  if (u.x < 0.5f) return sample_cosine_hemisphere(V2f(2.0f * u.x, u.y));
  const float z = table.sample_loss(2.0f * u.x - 1.0f, row_);
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const V2f azimuth = unit_circle(u.y);
  return {r * azimuth.x, r * azimuth.y, z};
}

// A facet that wo sees, and on it reflection or transmission.
bool Bsdf::sample_facets(float u_side, const V2f& u, V3f& local) const {
  const V3f& o = local_wo_;
  const V3f h = sample_visible_normal(o, alpha_, u);
  local = lumivec::reflect(o, h);
  if (facets_transmit_) {
    const FresnelShape shape = fresnel_shape(std::clamp(o.dot(h), 0.0f, 1.0f), eta_);
    const Color t = passed(shape);
    if (u_side >= reflected_share(at_least_0(reflectance_.at(shape)), t)) {
      if (is_black(t)) return false;
      // Drawn to pass, light must not end on this side, and the reverse.
      if (thin_ ? local.z <= 0.0f : shape.cos_transmitted <= 0.0f) return false;
      local = thin_ ? V3f(local.x, local.y, -local.z) : refract(o, h, eta_, shape.cos_transmitted);
      return local.z < 0.0f;
    }
  }
  return local.z > 0.0f;
}

bool Bsdf::sample_delta(Lobe lobe, BsdfSample& sample) const {
  const float p = lobes_[lobe].probability;
  const auto kept = [this](const V3f& wi) {
    return std::min(coat_transmittance_wo_, coat_transmittance(wi));
  };
  sample.delta = true;
  sample.pdf = p;
  sample.transmitted = lobe == transmit;
  if (lobe == coat) {
    sample.wi = lumivec::reflect(wo_, coat_frame_.n).normalized();
    sample.weight = Color((1.0f - coat_transmittance_wo_) / p);
  } else if (lobe == reflect) {
    sample.wi = lumivec::reflect(wo_, frame_.n).normalized();
    const Color f = at_least_0(reflectance_.at(fresnel_shape(local_wo_.z, eta_)));
    sample.weight = f * (kept(sample.wi) / p);
  } else {
    if (thin_ || rough_) {
      sample.wi = -wo_;
    } else {
      const float cos_t = fresnel_dielectric(local_wo_.z, eta_).cos_transmitted;
      sample.wi = refract(wo_, frame_.n, eta_, cos_t).normalized();
    }
    sample.weight = straight_ * (kept(sample.wi) * transport_scale_ / p);
  }
  const V3f& n = lobe == coat ? coat_frame_.n : frame_.n;
  const float side = sample.transmitted ? -1.0f : 1.0f;
  return side * sample.wi.dot(geometric_normal_) > 0.0f && side * sample.wi.dot(n) > 0.0f &&
         !is_black(sample.weight);
}

}  // namespace lumivec
