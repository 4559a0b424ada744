#include <algorithm>
#include <cmath>
#include <limits>

#include "integrator/bsdf_color.h"
#include "integrator/media.h"
#include "integrator/partition.h"
#include "integrator/path_stream.h"

namespace lumivec {
namespace {

// Two events of scattering are always traced; then a path survives with the largest channel of its
// throughput.
constexpr int first_roulette_depth = 2;
// Survivors of the roulette are at most this much brighter, which bounds the noise that it adds.
constexpr float min_survival = 0.05f;
// Paths that lose nothing, between mirrors or by total reflection, end all the same: from this
// depth on by this chance.
constexpr int endless_depth = 64;
constexpr float endless_survival = 0.99f;

float max_component(const Color& c) {
  return std::max({c.x, c.y, c.z});
}

}  // namespace

void PathStream::shade(int i) {
  Lane& lane = lanes_[i];
  const RayHit& hit = hits_[i];
  lane.even_cached = false;
  if (lane.follows_mirror) {
    lane.mirrored = hit.valid() ? 1.0f / hit.distance : 0.0f;
    lane.follows_mirror = false;
  }
  if (!hit.valid()) {
    gathered_ == Term::direct ? add_even_environment(lane) : add_environment(lane);
    lane.ended = true;
    return;
  }
  if (gathered_ == Term::direct) {
    lane.hit_depth = hit.distance;
    lane.ended = true;
    return;
  }
  const SurfacePoint point = t_.scene_.surface(hit, lane.origin, lane.direction);
  const Material& material = *point.material;
  if (results_ && lane.depth == 1 && std::isinf(lane.hit_depth)) lane.hit_depth = hit.distance;
  if (lane.camera_ray && culled(point)) {
    lane.near = next_distance(hit.distance, point.error);
    lane.ended = lane.near >= lane.far;
    return;
  }
  absorb(lane, point, hit.distance);
  lane.length += hit.distance;

  const Color emission = t_.scene_.emission(point);
  if (!is_black(emission)) add_emission(lane, point, emission);

  if (material.unlit) {
    if (lane.camera_ray) note_first_hit(lane, point, emission, point.normal);
    lane.ended = true;
    return;
  }
  const float outside_ior = lane.media.outside_ior(material, point.front);
  const SurfaceParameters parameters = t_.scene_.parameters(point, outside_ior);
  if (lane.camera_ray) note_first_hit(lane, point, parameters.base_color, parameters.normal);
  lane.camera_ray = false;
  if (t_.settings_.max_depth > 0 && lane.depth >= t_.settings_.max_depth) {
    lane.ended = true;
    return;
  }
  Bsdf bsdf(parameters, point.geometric_normal, -lane.direction, t_.scene_.albedo_tables(),
            t_.settings_.specular_roughness);
  if (lane.probe) bsdf = bsdf.with_only(kind_bit(LobeKind::specular));
  if (lane.depth == 0) split_between_mirrors(lane, bsdf);
  const bool passes = parameters.transmission > 0.0f;
  const V3f receiver = passes ? V3f(0.0f) : point.geometric_normal;
  const bool may_sample_lights = bsdf.has_non_delta() && !t_.lights_.empty() && !cache_.asks();
  if (cache_.photons && !lane.probe && !cache_.asks() && bsdf.has_non_specular())
    add_photons(lane, point, bsdf);
  const std::uint32_t kinds = lane.probe ? 0 : cached_kinds(bsdf, parameters);
  if (kinds != 0) {
    const bool cached = use_cache(lane, point, parameters, bsdf);
    if (cached || cache_.asks()) {
      shade_beside_cache(lane, point, parameters, bsdf, kinds, receiver, may_sample_lights);
      return;
    }
  }
  if (cache_.any()) split_beside_cache(lane, bsdf);
  if (may_sample_lights) sample_light(lane, point, bsdf, bsdf, receiver, 0);
  go_on(lane, point, parameters, bsdf, receiver, may_sample_lights ? 1 : 0);
}

void PathStream::absorb(Lane& lane, const SurfacePoint& point, float distance) {
  const Material* medium = lane.media.top();
  const Material& m = *point.material;
  // A path that started inside a volume finds out when it comes to its boundary.
  if (!medium && !point.front && m.transmission > 0.0f && !m.thin_walled) medium = &m;
  if (medium) lane.throughput *= volume_transmittance(*medium, distance);
}

void PathStream::note_first_hit(Lane& lane, const SurfacePoint& point, const Color& albedo,
                                const V3f& normal) {
  lane.albedo = albedo;
  lane.normal = normal;
  lane.position = point.position;
  lane.hit_depth = t_.camera_.depth(point.position);
  lane.object = point.instance;
}

void PathStream::shade_beside_cache(Lane& lane, const SurfacePoint& point,
                                    const SurfaceParameters& parameters, const Bsdf& bsdf,
                                    std::uint32_t kinds, const V3f& receiver,
                                    bool may_sample_lights) {
  // Light paths do not connect to what the eye sees in mirrors.
  const bool found_by_eye =
      t_.eye_paths_find_caustics_ || (!cache_.photons && lane.term == Term::specular);
  const bool probes = t_.lights_.leaves_caustics() && found_by_eye && !cache_.asks();
  if (probes) {
    if (may_sample_lights) sample_light(lane, point, bsdf, bsdf, receiver, kinds);
    scatter(lane, point, parameters, bsdf, receiver, may_sample_lights ? 1 : 0, kinds);
    return;
  }
  const Bsdf rest = bsdf.with_only(~kinds);
  split_beside_cache(lane, rest);
  may_sample_lights = may_sample_lights && !(bsdf.lambertian() && only_even_light(lane));
  // Beside what other continuations bring, one is enough.
  const bool continued = lane.depth > 0 && lane.splits > 1;
  if (may_sample_lights && !results_ && !lane.caustic.scattered && !continued) {
    // What it cost to come here is spread over several light samples.
    lane.light_samples = stop_light_samples;
    stop_of(lane).emplace(Stop{point, parameters, bsdf, rest, kinds, receiver});
    sample_light(lane, point, bsdf, rest, receiver, kinds);
    return;
  }
  if (may_sample_lights) sample_light(lane, point, bsdf, rest, receiver, kinds);
  go_on(lane, point, parameters, rest, receiver, may_sample_lights ? 1 : 0);
}

void PathStream::split_beside_cache(Lane& lane, const Bsdf& traced) const {
  if (!results_ && !cache_.asks() && lane.depth == 0 && traced.has_non_delta())
    lane.splits = usual_splits;
}

void PathStream::split_between_mirrors(Lane& lane, Bsdf& bsdf) const {
  if (results_ || !cache_.any() || cache_.asks()) return;
  if (bsdf.delta_lobe_count() < 2) return;
  lane.splits = mirror_splits;
  bsdf = bsdf.with_probabilities_in_parts(static_cast<int>(lane.splits));
}

void PathStream::go_on(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
                       const Bsdf& bsdf, const V3f& receiver, std::uint32_t light_samples) {
  if (lane.depth == 0 && lane.splits > 1)
    fork(lane, point, parameters, bsdf, receiver, light_samples);
  scatter(lane, point, parameters, bsdf, receiver, light_samples);
}

void PathStream::fork(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
                      const Bsdf& bsdf, const V3f& receiver, std::uint32_t light_samples) {
  lane.throughput *= 1.0f / static_cast<float>(lane.splits);
  fork_of(lane).emplace(Fork{point, parameters, bsdf, receiver, light_samples, lane.throughput,
                             lane.media, lane.length});
}

void PathStream::scatter(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
                         const Bsdf& bsdf, const V3f& receiver, std::uint32_t light_samples,
                         std::uint32_t cached_kinds) {
  lane.ended = true;
  BsdfSample s;
  float u_survival;
  if (!sample_bsdf(lane, bsdf, s, u_survival)) return;
  lane.throughput *= s.weight;
  if (is_black(lane.throughput)) return;
  const bool straight_through = s.delta && s.transmitted && parameters.thin_walled;
  const Term next = after_event(lane.term, s.kind);
  if ((reachable_terms(next) & terms_) == 0) return;
  lane.term = next;
  if (lane.probe) {
    lane.probe_bent = lane.probe_bent || !straight_through;
  } else if ((cached_kinds & kind_bit(s.kind)) != 0) {
    lane.probe = true;
    lane.probe_bent = false;
  }
  lane.caustic.event(s.kind, straight_through, next);
  if (lane.depth == 0 && s.kind == LobeKind::specular) {
    const bool refracted = s.transmitted && !parameters.thin_walled;
    lane.follows_mirror = !refracted && lane.mirrored == shows_nothing;
    if (refracted) lane.mirrored = shows_by_refraction;
  }
  ++lane.depth;
  // Shadow rays pass thin walls too: light sampling at the last vertex competes with this path
  // still, weighted by the density there, as it is itself.
  if (!straight_through || lane.light_trials <= 0.0f) {
    lane.light_trials = s.delta ? 0.0f : static_cast<float>(light_samples);
    lane.scatter_pdf = lane.depth == 1 ? s.pdf * static_cast<float>(lane.splits) : s.pdf;
    lane.vertex = point.position;
    lane.vertex_normal = receiver;
  }
  if (s.transmitted && !parameters.thin_walled) {
    lane.media.cross(*point.material, point.front);
    lane.radiance_scale *= parameters.eta * parameters.eta;
  }
  if (lane.depth >= first_roulette_depth) {
    const float survival = std::clamp(
        max_component(lane.throughput) * lane.radiance_scale * static_cast<float>(lane.splits),
        min_survival, lane.depth < endless_depth ? 1.0f : endless_survival);
    if (survival < 1.0f) {
      if (u_survival >= survival) return;
      lane.throughput *= 1.0f / survival;
    }
  }
  if (s.kind == LobeKind::diffuse) {
    lane.ray_kind = other_ray;
  } else if (!s.transmitted) {
    lane.ray_kind = mirror_ray;
  }
  lane.origin = offset_origin(point, s.wi);
  lane.direction = s.wi;
  lane.near = 0.0f;
  lane.far = std::numeric_limits<float>::infinity();
  lane.ended = false;
}

}  // namespace lumivec
