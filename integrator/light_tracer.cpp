#include "integrator/light_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrator/frame.h"
#include "integrator/media.h"
#include "integrator/partition.h"
#include "integrator/sampling.h"
#include "integrator/sobol.h"
#include "integrator/solid_angle_sampling.h"

namespace lumivec {
namespace {

constexpr int first_roulette_depth = 2;
constexpr float min_survival = 0.05f;
// Cones around casters are widened by this, so that rounding leaves no rim of the caster in the
// dark.
constexpr float caster_margin = 1.001f;
// Shadow rays to the eye end this much before it.
constexpr float eye_ray_end = 1.0f - 4e-7f;

float max_component(const Color& c) {
  return std::max({c.x, c.y, c.z});
}
float mean(const Color& c) {
  return (c.x + c.y + c.z) * (1.0f / 3.0f);
}

V3f uniform_direction(const V2f& u) {
  const float z = 1.0f - 2.0f * u.x, r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return {r * std::cos(2.0f * pi * u.y), r * std::sin(2.0f * pi * u.y), z};
}

// Light paths and eye paths see shading normals from opposite ends; this makes them agree (Veach
// 1997, eq. 5.19). from: toward where the light comes from. to: where it goes.
float shading_correction(const V3f& from, const V3f& to, const V3f& shading, const V3f& geometric) {
  const float numerator = std::abs(from.dot(shading) * to.dot(geometric));
  const float denominator = std::abs(from.dot(geometric) * to.dot(shading));
  return denominator > 0.0f ? numerator / denominator : 0.0f;
}

}  // namespace

LightTracer::LightTracer(const TracedScene& scene, const Lights& lights, const CameraView& camera,
                         const RenderSettings& settings, const std::vector<BoundingSphere>& casters)
    : scene_(scene),
      lights_(lights),
      camera_(camera),
      settings_(settings),
      casters_(casters),
      filter_(settings.filter) {
  // Photons are also found by what the eye sees in mirrors and through glass.
  std::uint32_t brings = reachable_terms(Term::caustic);
  if (settings.integrator == Integrator::light_vectors) brings |= term_bit(Term::specular);
  if (casters.empty() || (settings.terms & brings) == 0) return;
  for (std::size_t i = 0; i < lights.emitters().size(); ++i) {
    const Emitter& e = lights.emitters()[i];
    if (!e.light_traced) continue;
    Source source;
    source.emitter = static_cast<int>(i);
    float intensity = mean(e.emission);
    if (e.kind == EmitterKind::sphere) intensity *= pi * e.radius * e.radius;
    if (e.kind == EmitterKind::rectangle) intensity *= e.edge_u.cross(e.edge_v).length();
    if (e.kind == EmitterKind::triangle) intensity *= 0.5f * e.edge_u.cross(e.edge_v).length();
    add_source(source, intensity, e.origin);
  }
  for (std::size_t i = 0; i < lights.directional().size(); ++i) {
    Source source;
    source.directional = static_cast<int>(i);
    add_distant_source(source, mean(lights.directional()[i].illuminance));
  }
  add_distant_source(Source(), 4.0f * pi * lights.environment().mean_radiance() *
                                   lights.environment_light_traced_share());
  float total = 0.0f;
  for (const Source& s : sources_) total += s.probability;
  float cumulative = 0.0f;
  for (Source& s : sources_) {
    s.probability /= total;
    cumulative += s.probability;
    s.cumulative = cumulative;
  }
}

// Weighs the source and its casters by the flux that meets them.
void LightTracer::add_source(Source source, float intensity, const V3f& position) {
  float sum = 0.0f;
  for (const BoundingSphere& c : casters_) {
    const float d2 = (c.center - position).length2(), r2 = c.radius * c.radius;
    const float solid_angle = d2 <= r2 ? 4.0f * pi : 2.0f * pi * (1.0f - std::sqrt(1.0f - r2 / d2));
    // Far casters lose their solid angle to rounding; they keep their chance by the plain quotient.
    const float weight = c.worth * std::max(solid_angle, d2 > r2 ? pi * r2 / d2 : 0.0f);
    source.aim.push_back(weight);
    sum += weight;
  }
  if (!(sum > 0.0f) || !(intensity > 0.0f)) return;
  for (float& a : source.aim) a /= sum;
  source.probability = intensity * sum;
  sources_.push_back(std::move(source));
}

void LightTracer::add_distant_source(Source source, float illuminance) {
  float sum = 0.0f;
  for (const BoundingSphere& c : casters_) source.aim.push_back(pi * c.radius * c.radius);
  for (const float a : source.aim) sum += a;
  if (!(sum > 0.0f) || !(illuminance > 0.0f)) return;
  for (float& a : source.aim) a /= sum;
  source.probability = illuminance * sum;
  sources_.push_back(std::move(source));
}

// A direction toward one of the casters, and the density with which any of them would have led to
// it.
bool LightTracer::aim(const Source& source, const V3f& origin, float u_aim, const V2f& u,
                      V3f& direction, float& pdf) const {
  std::size_t chosen = 0;
  while (chosen + 1 < source.aim.size() && u_aim >= source.aim[chosen])
    u_aim -= source.aim[chosen++];
  const auto cone_to = [&](const BoundingSphere& c, V3f& to_center, float& radius) {
    to_center = c.center - origin;
    radius = c.radius * caster_margin;
    return to_center.length2() > radius * radius;
  };
  V3f to_center;
  float radius, distance;
  if (cone_to(casters_[chosen], to_center, radius)) {
    direction = sample_sphere_cone(sphere_cone(to_center, radius), radius, u, distance);
  } else {
    direction = uniform_direction(u);
  }
  pdf = 0.0f;
  for (std::size_t i = 0; i < casters_.size(); ++i) {
    if (!cone_to(casters_[i], to_center, radius)) {
      pdf += source.aim[i] / (4.0f * pi);
      continue;
    }
    const SphereCone cone = sphere_cone(to_center, radius);
    // 1 - cosθ between unit vectors as half their squared distance: exact for narrow cones.
    if (i == chosen || 0.5f * (direction - cone.axis).length2() <= cone.one_minus_cos_max) {
      pdf += source.aim[i] * cone.pdf;
    }
  }
  return pdf > 0.0f && std::isfinite(pdf);
}

bool LightTracer::start_distant(const Source& source, const V3f& toward_light,
                                const Color& illuminance, float u_aim, const V2f& u,
                                Start& out) const {
  std::size_t chosen = 0;
  while (chosen + 1 < source.aim.size() && u_aim >= source.aim[chosen])
    u_aim -= source.aim[chosen++];
  const Frame frame = make_frame(toward_light);
  const V2f disc = sample_disc(u) * (casters_[chosen].radius * caster_margin);
  const V3f through = casters_[chosen].center + frame.t * disc.x + frame.b * disc.y;
  float pdf = 0.0f;  // per unit area across the beam
  for (std::size_t i = 0; i < casters_.size(); ++i) {
    const V3f offset = through - casters_[i].center;
    const float radius = casters_[i].radius * caster_margin;
    const float across2 = (offset - toward_light * offset.dot(toward_light)).length2();
    if (i == chosen || across2 <= radius * radius) pdf += source.aim[i] / (pi * radius * radius);
  }
  // Start outside of everything; the scene lies within radius() of traced space's origin.
  const float back = scene_.radius() * 1.01f - through.dot(toward_light);
  out.origin = through + toward_light * back;
  out.direction = -toward_light;
  out.flux = illuminance * (1.0f / (pdf * source.probability));
  return max_component(out.flux) > 0.0f;
}

bool LightTracer::start(float u_source, const V2f& u_point, float u_aim, const V2f& u_direction,
                        Start& out) const {
  const auto found = std::lower_bound(sources_.begin(), sources_.end(), u_source,
                                      [](const Source& s, float u) { return s.cumulative <= u; });
  const Source& source = found == sources_.end() ? sources_.back() : *found;
  if (source.directional >= 0) {
    const DirectionalLight& light = lights_.directional()[std::size_t(source.directional)];
    return start_distant(source, light.direction, light.illuminance, u_aim, u_direction, out);
  }
  if (source.emitter < 0) {
    const EnvironmentLight& environment = lights_.environment();
    float pdf;
    const V3f direction = environment.sample(u_point, pdf);
    if (!(pdf > 0.0f) || !lights_.environment_light_traced(direction)) return false;
    return start_distant(source, direction, environment.radiance(direction) * (1.0f / pdf), u_aim,
                         u_direction, out);
  }

  const Emitter& e = lights_.emitters()[std::size_t(source.emitter)];
  V3f normal(0.0f);
  float area = 1.0f;
  out.origin = e.origin;
  switch (e.kind) {
    case EmitterKind::sphere:
      normal = uniform_direction(u_point);
      area = 4.0f * pi * e.radius * e.radius;
      out.origin = e.origin + normal * e.radius;
      break;
    case EmitterKind::rectangle:
    case EmitterKind::triangle: {
      const V3f cross = e.edge_u.cross(e.edge_v);
      const bool rectangle = e.kind == EmitterKind::rectangle;
      const float root = std::sqrt(u_point.x);
      const V2f at = rectangle ? u_point : V2f(root * (1.0f - u_point.y), root * u_point.y);
      area = cross.length() * (rectangle ? 1.0f : 0.5f);
      normal = cross.normalized();
      out.origin = e.origin + e.edge_u * at.x + e.edge_v * at.y;
      break;
    }
    case EmitterKind::point:
    case EmitterKind::spot:
      out.origin = e.origin + shadow_offset(*e.light, u_point);
      if (e.light->fade_distance > 0.0f) out.light = e.light;
      break;
    case EmitterKind::beam:
    case EmitterKind::ellipsoid:
      break;
  }
  float pdf;
  if (!aim(source, out.origin, u_aim, u_direction, out.direction, pdf)) return false;
  out.flux = e.emission * (area / (pdf * source.probability));
  if (e.kind == EmitterKind::spot) {
    out.flux *= spot_falloff(e, out.direction);
  } else if (e.kind != EmitterKind::point) {
    const float facing = normal.dot(out.direction);
    out.flux *= e.two_sided ? std::abs(facing) : std::max(0.0f, facing);
    out.origin += normal * std::copysign(e.error, facing);
  }
  return max_component(out.flux) > 0.0f;
}

void LightTracer::trace(std::uint64_t first, std::uint32_t count, std::vector<Splat>& splats,
                        RenderStatistics& statistics) const {
  const auto arrive = [&](const Arrival& a) { connect(a, splats, statistics); };
  for (std::uint32_t i = 0; i < count; ++i) trace_path(first + i, true, statistics, arrive);
  statistics.light_paths += count;
}

void LightTracer::trace(std::uint64_t first, std::uint32_t count, std::vector<Photon>& photons,
                        RenderStatistics& statistics) const {
  const auto arrive = [&](const Arrival& a) {
    Photon photon;
    photon.position = a.point.position;
    photon.direction = a.wo;
    photon.normal = a.point.geometric_normal;
    photon.flux = a.flux;
    photon.caustic = a.covered.glossy;
    photon.events = static_cast<std::uint16_t>(std::min(a.events, 65535));
    if (!(std::isfinite(a.flux.x) && std::isfinite(a.flux.y) && std::isfinite(a.flux.z))) {
      ++statistics.dropped[static_cast<std::size_t>(a.term)];
      return;
    }
    photons.push_back(photon);
  };
  for (std::uint32_t i = 0; i < count; ++i) trace_path(first + i, false, statistics, arrive);
  statistics.light_paths += count;
}

template <typename Arrive>
void LightTracer::trace_path(std::uint64_t path, bool past_broad, RenderStatistics& statistics,
                             const Arrive& arrive) const {
  // Light paths share one sequence per 2³² of them; the last block number keeps them apart from the
  // pixels' sequences.
  constexpr std::uint32_t light_path_stream = 0x11647u;
  const std::uint32_t index = static_cast<std::uint32_t>(path);
  std::uint32_t seed = hash_combine(static_cast<std::uint32_t>(settings_.seed),
                                    static_cast<std::uint32_t>(settings_.seed >> 32));
  seed =
      hash_combine(hash_combine(seed, static_cast<std::uint32_t>(path >> 32)), light_path_stream);
  std::uint32_t block = 0;
  const auto random = [&] { return sobol_point(index, hash_combine(seed, block++)); };

  const std::array<float, 4> u0 = random(), u1 = random();
  Start begin;
  if (!start(u0[2], V2f(u0[0], u0[1]), u0[3], V2f(u1[0], u1[1]), begin)) return;

  V3f origin = begin.origin, direction = begin.direction;
  Color weight(1.0f);
  MediumStack media;
  // Eye paths leave what comes of this path to it, whatever follows; or, patchy, if its last vertex
  // is one of a broad lobe.
  bool specular_caustic = false, patchy = false;
  bool diffused = false;  // a D event has been
  bool bent = false;      // an S event other than straight passage through a thin wall has been
  bool run = true;        // nothing but S and glossy D events have been
  for (int depth = 0; settings_.max_depth == 0 || depth < settings_.max_depth; ++depth) {
    const std::uint32_t ray_seed = hash_combine(hash_combine(seed, index), block);
    const RayHit hit =
        scene_.intersect(origin, direction, 0.0f, std::numeric_limits<float>::infinity(), ray_seed);
    ++statistics.rays_scatter;
    if (!hit.valid()) return;
    const SurfacePoint point = scene_.surface(hit, origin, direction);
    const Material& material = *point.material;
    if (material.unlit) return;
    // Beams that spread thin out with the square by themselves.
    if (depth == 0 && begin.light)
      weight *= faded(*begin.light, hit.distance) * hit.distance * hit.distance;
    const Material* medium = media.top();
    // A lamp inside a volume finds out where its light comes to the boundary.
    if (!medium && !point.front && material.transmission > 0.0f && !material.thin_walled) {
      medium = &material;
    }
    if (medium) weight *= volume_transmittance(*medium, hit.distance);
    const SurfaceParameters parameters =
        scene_.parameters(point, media.outside_ior(material, point.front));
    const V3f wo = -direction;
    const Bsdf bsdf(parameters, point.geometric_normal, wo, scene_.albedo_tables(),
                    settings_.specular_roughness, Transport::importance);
    const bool caustic = bent && !diffused;
    const Covered here = {patchy || specular_caustic || caustic || (run && diffused),
                          specular_caustic || caustic};
    if ((here.broad && bsdf.has_broad()) || (here.glossy && bsdf.has(LobeKind::glossy))) {
      const Term term = diffused ? Term::indirect : Term::caustic;
      arrive({point, parameters.normal, bsdf, wo, begin.flux * weight, media.top(), term, here,
              ray_seed, depth});
    }
    const std::array<float, 4> u = random();
    BsdfSample s;
    constexpr std::uint32_t sharp_kinds = kind_bit(LobeKind::glossy) | kind_bit(LobeKind::specular);
    // A broad event now would be none of this tracer's business, or is beyond it.
    const bool drawn = here.broad && past_broad
                           ? bsdf.sample(u[0], V2f(u[1], u[2]), s)
                           : bsdf.with_only(sharp_kinds).sample(u[0], V2f(u[1], u[2]), s);
    if (!drawn) return;
    if (s.kind != LobeKind::specular) {
      const bool broad = is_broad(s.kind);
      specular_caustic = here.glossy && past_broad;
      patchy = patchy || (broad && here.broad);
      run = run && !broad;
      diffused = true;
      if (!(patchy || specular_caustic || run) || (settings_.terms & term_bit(Term::indirect)) == 0)
        return;
    } else if (!(s.delta && s.transmitted && parameters.thin_walled)) {
      bent = true;
    }
    weight *= s.weight;
    if (!s.delta) weight *= shading_correction(wo, s.wi, parameters.normal, point.geometric_normal);
    if (s.transmitted && !parameters.thin_walled) media.cross(material, point.front);
    if (depth >= first_roulette_depth) {
      const float survival = std::clamp(max_component(weight), min_survival, 1.0f);
      if (u[3] >= survival) return;
      weight *= 1.0f / survival;
    }
    if (!(max_component(weight) > 0.0f)) return;
    origin = offset_origin(point, s.wi);
    direction = s.wi;
  }
}

// What the eye looks through (surface.h) hides nothing from it.
bool LightTracer::visible_to_eye(const SurfacePoint& point, const V3f& to_eye, float distance,
                                 std::uint32_t seed, RenderStatistics& statistics) const {
  const auto shown = [&](const SurfacePoint& p) {
    return (scene_.instances()[std::size_t(p.instance)].seen_by & eye_ray) != 0;
  };
  if (culled(point) || !shown(point)) return false;
  const V3f origin = offset_origin(point, to_eye);
  const float end = camera_.visible_distance(point.position, distance) * eye_ray_end;
  for (float near = 0.0f; near < end;) {
    const RayHit hit = scene_.intersect(origin, to_eye, near, end, seed, mask_of(eye_ray));
    ++statistics.rays_shadow;
    if (!hit.valid()) return true;
    const SurfacePoint between = scene_.surface(hit, origin, to_eye);
    if (!culled(*between.material, !between.front)) return false;
    near = next_distance(hit.distance, between.error);
  }
  return true;
}

// Adds what a vertex sends toward the eye, if the eye sees it.
void LightTracer::connect(const Arrival& a, std::vector<Splat>& splats,
                          RenderStatistics& statistics) const {
  if ((settings_.terms & term_bit(a.term)) == 0) return;
  V2f pixel;
  V3f to_eye;
  float distance, importance;
  if (!camera_.project(a.point.position, pixel, to_eye, distance, importance)) return;
  const BsdfValue value_to_eye = a.bsdf.eval(to_eye);
  Color f(0.0f);
  if (a.covered.broad) f += value_to_eye.of_broad();
  if (a.covered.glossy) f += value_to_eye.of(LobeKind::glossy);
  if (f == Color(0.0f)) return;
  Color value =
      a.flux * f *
      (importance * shading_correction(a.wo, to_eye, a.shading_normal, a.point.geometric_normal));
  if (a.medium) value *= volume_transmittance(*a.medium, distance);
  for (int c = 0; c < 3; ++c) {
    if (std::isfinite(value[c])) continue;
    ++statistics.dropped[static_cast<std::size_t>(a.term)];
    return;
  }
  if (!visible_to_eye(a.point, to_eye, distance, a.seed, statistics)) return;
  filter_.for_each_pixel(pixel, settings_.width, settings_.height, [&](int x, int y, float share) {
    const auto index = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(settings_.width) +
                       static_cast<std::uint32_t>(x);
    splats.push_back({index, a.term, value * share});
  });
}

}  // namespace lumivec
