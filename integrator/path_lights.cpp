#include <algorithm>
#include <limits>

#include "integrator/bsdf_color.h"
#include "integrator/media.h"
#include "integrator/partition.h"
#include "integrator/path_stream.h"
#include "integrator/sampling.h"
#include "integrator/sobol.h"

namespace lumivec {
namespace {

constexpr std::uint32_t sky_stream = 0x5c7eau;

// Veach's power heuristic with exponent two, safe for any finite densities.
float power_heuristic(float taken, float other) {
  if (other <= 0.0f) return 1.0f;
  const float ratio = other / taken;
  return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace

void PathStream::sample_light(Lane& lane, const SurfacePoint& point, const Bsdf& bsdf,
                              const Bsdf& scattered, const V3f& receiver,
                              std::uint32_t alone_kinds) {
  const std::array<float, 4> u = random_for_lights(lane);
  LightSample light;
  if (!t_.lights_.sample(point.position, receiver, u[0], V2f(u[1], u[2]), light)) return;
  // Scattering competes with as many samples as there are continuations, for each of these.
  const float trials = (lane.depth == 0 ? static_cast<float>(lane.splits) : 1.0f) /
                       static_cast<float>(lane.light_samples);
  // The diffuse lobe alone, where it is cached, with those of the environment.
  const bool sky = light.environment && stop_of(lane) && stop_of(lane)->samples_sky();
  const float sky_trials = sky ? float(stop_sky_samples) / float(stop_light_samples) : 0.0f;
  Color arriving = lane.throughput * light.radiance *
                   (1.0f / (light.pdf * static_cast<float>(lane.light_samples)));
  if (const Material* medium = lane.media.top())
    arriving *= volume_transmittance(*medium, light.distance);
  lane.shadow_term[0] = after_event(lane.term, LobeKind::diffuse);
  lane.shadow_term[1] = after_event(lane.term, LobeKind::specular);
  lane.shadow_even = Color(0.0f);
  if (bsdf.lambertian()) {  // the same as below, in a fraction of its time
    const float cosine = light.direction.dot(bsdf.normal());
    if (cosine <= 0.0f || light.direction.dot(point.geometric_normal) <= 0.0f) return;
    const bool alone = light.delta || alone_kinds != 0;
    const float weight =
        power_heuristic(light.pdf, (alone ? sky_trials : trials) * cosine * inv_pi);
    lane.shadow_light[0] = arriving * bsdf.diffuse_brdf(light.direction) * (cosine * weight);
    lane.shadow_light[1] = Color(0.0f);
    if (lane.even_cached && light.environment)
      take_even(lane, lane.shadow_light[0], light.radiance);
  } else {
    add_scattered(lane, bsdf, scattered, light, arriving, trials, sky_trials, alone_kinds);
  }
  lane.shadow = any_shadow_light(lane);
  lane.shadow_origin = offset_origin(point, light.direction);
  lane.shadow_target = light.target;
  lane.shadow_mask = !light.shadowed ? 0 : mask_of(light.delta ? shadow_ray : other_ray);
}

void PathStream::add_scattered(Lane& lane, const Bsdf& bsdf, const Bsdf& scattered,
                               const LightSample& light, const Color& arriving, float trials,
                               float sky_trials, std::uint32_t alone_kinds) const {
  const BsdfValue f = bsdf.eval(light.direction);
  const BsdfValue competing = &scattered == &bsdf ? f : scattered.eval(light.direction);
  const auto weighted = [&](LobeKind kind) {
    if (light.light_traced && lane.caustic.left_to_light_paths(kind)) return Color(0.0f);
    const bool alone = light.delta || (alone_kinds & kind_bit(kind)) != 0;
    const float other = alone
                            ? sky_trials * cosine_hemisphere_pdf(bsdf.normal().dot(light.direction))
                            : trials * competing.pdf_of(kind);
    return f.of(kind) * power_heuristic(light.pdf, other);
  };
  const Color diffuse = arriving * weighted(LobeKind::diffuse);
  lane.shadow_light[0] =
      diffuse + arriving * (weighted(LobeKind::broad) + weighted(LobeKind::glossy));
  lane.shadow_light[1] = arriving * weighted(LobeKind::specular);
  if (lane.even_cached && light.environment) take_even(lane, diffuse, light.radiance);
}

void PathStream::trace_further_shadows() {
  bool any = false;
  for (const std::optional<Stop>& stop : stops_) any = any || stop.has_value();
  if (!any) return;
  for (std::uint32_t k = 1; k < stop_light_samples; ++k) {
    for (Lane& lane : lanes_) {
      const std::optional<Stop>& stop = stop_of(lane);
      if (!stop) continue;
      lane.light_sample = k;
      sample_light(lane, stop->point, stop->bsdf, stop->rest, stop->receiver, stop->cached_kinds);
    }
    trace_shadows();
  }
  const bool sky = !t_.lights_.environment().black();
  for (std::uint32_t k = 0; sky && k < stop_sky_samples; ++k) {
    for (Lane& lane : lanes_) {
      const std::optional<Stop>& stop = stop_of(lane);
      if (stop && stop->samples_sky() && !only_even_light(lane)) sample_sky(lane, *stop, k);
    }
    trace_shadows();
  }
  for (Lane& lane : lanes_) {
    std::optional<Stop>& stop = stop_of(lane);
    if (!stop) continue;
    go_on(lane, stop->point, stop->parameters, stop->rest, stop->receiver, stop_light_samples);
    lane.light_samples = 1;
    lane.light_sample = 0;
    stop.reset();
  }
}

bool PathStream::only_even_light(const Lane& lane) const {
  return lane.even_cached && t_.lights_.environment_alone() &&
         !t_.lights_.environment().has_peaks() && !t_.scene_.has_filters();
}

void PathStream::sample_sky(Lane& lane, const Stop& stop, std::uint32_t number) {
  const std::uint32_t block = lane.scatter_block();
  const std::array<float, 4> u =
      sobol_point(lane.index_of(block, stop_sky_samples, number),
                  hash_combine(hash_combine(lane.seed, block), sky_stream));
  const V3f local = sample_cosine_hemisphere(V2f(u[0], u[1]));
  const V3f direction = make_frame(stop.bsdf.normal()).to_world(local);
  if (direction.dot(stop.point.geometric_normal) <= 0.0f) return;
  const Lights& lights = t_.lights_;
  const float by_lights = lights.pdf_environment(stop.point.position, stop.receiver, direction);
  const float weight = power_heuristic(stop_sky_samples * cosine_hemisphere_pdf(local.z),
                                       stop_light_samples * by_lights);
  const Color radiance = lights.environment().radiance(direction);
  Color light = lane.throughput * stop.bsdf.diffuse_brdf(direction) * radiance *
                (pi * weight / stop_sky_samples);
  if (const Material* medium = lane.media.top())
    light *= volume_transmittance(*medium, std::numeric_limits<float>::infinity());
  lane.shadow_term[0] = after_event(lane.term, LobeKind::diffuse);
  lane.shadow_light[0] = light;
  lane.shadow_light[1] = lane.shadow_even = Color(0.0f);
  if (lane.even_cached) take_even(lane, light, radiance);
  lane.shadow = any_shadow_light(lane);
  lane.shadow_origin = offset_origin(stop.point, direction);
  lane.shadow_target = lights.far_along(stop.point.position, direction);
  lane.shadow_mask = mask_of(other_ray);
}

void PathStream::take_even(Lane& lane, const Color& diffuse, const Color& radiance) const {
  const Color even = diffuse * (1.0f - t_.lights_.environment().peak_share(radiance));
  lane.shadow_light[0] -= even;
  for (int c = 0; c < 3; ++c)
    lane.shadow_light[0][c] = std::max(0.0f, lane.shadow_light[0][c]);  // of rounding
  if (t_.scene_.has_filters()) lane.shadow_even = even;
}

bool PathStream::any_shadow_light(const Lane& lane) const {
  const auto terms = [](const Color& light, Term term) {
    return is_black(light) ? 0u : reachable_terms(term);
  };
  return ((terms(lane.shadow_light[0], lane.shadow_term[0]) |
           terms(lane.shadow_even, lane.shadow_term[0]) |
           terms(lane.shadow_light[1], lane.shadow_term[1])) &
          terms_) != 0;
}

void PathStream::add_environment(Lane& lane) {
  const EnvironmentLight& environment = t_.lights_.environment();
  if (environment.black() || (lane.probe && !lane.probe_bent)) return;
  if (lane.caustic.left_to_light_paths() && t_.lights_.environment_light_traced(lane.direction))
    return;
  float weight = 1.0f;
  if (lane.light_trials > 0.0f) {
    weight = power_heuristic(
        lane.scatter_pdf, lane.light_trials * t_.lights_.pdf_environment(
                                                  lane.vertex, lane.vertex_normal, lane.direction));
  }
  lane.add(lane.term, lane.throughput * environment.radiance(lane.direction) * weight);
}

void PathStream::add_even_environment(Lane& lane) {
  const EnvironmentLight& environment = t_.lights_.environment();
  const Color radiance = environment.radiance(lane.direction);
  lane.add(lane.term, radiance * (1.0f - environment.peak_share(radiance)));
}

void PathStream::add_emission(Lane& lane, const SurfacePoint& point, const Color& emission) {
  if (lane.probe && !lane.probe_bent) return;
  if (lane.caustic.left_to_light_paths() && t_.lights_.light_traced(point)) return;
  float weight = 1.0f;
  if (lane.light_trials > 0.0f) {
    weight =
        power_heuristic(lane.scatter_pdf,
                        lane.light_trials * t_.lights_.pdf(lane.vertex, lane.vertex_normal, point));
  }
  lane.add(lane.term, lane.throughput * emission * weight);
}

}  // namespace lumivec
