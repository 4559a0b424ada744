#include "integrator/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "integrator/bsdf_color.h"
#include "integrator/caustic_state.h"
#include "integrator/media.h"
#include "integrator/partition.h"
#include "integrator/ray_packet.h"
#include "integrator/sampling.h"
#include "integrator/sobol.h"

namespace lumivec {
namespace {

// Paths take turns: all are traced, then all shaded, so that each piece of code stays in the
// instruction cache for a while and packets are full. On the Cornell box 4 to 12 packets take some
// 5% less time than one.
constexpr int lane_count = 8 * packet_size;

// Continuations of each path from its first vertex on. Light from further away has nearly all of
// the variance, and what leads to the first vertex (the eye's ray, light sampling there) need not
// be traced anew for it. On the Cornell boxes four have the squared error of four paths for the
// time of two and a half (Arvo and Kirk 1990).
constexpr std::uint32_t usual_splits = 4;
// Random numbers for the pixel's position and light sampling at the first vertex are drawn once a
// path, others once a continuation.
constexpr std::uint32_t first_continued_block = 2;

// Two events of scattering are always traced; then a path survives with the largest channel of its
// throughput.
constexpr int first_roulette_depth = 2;
// Light samples of a vertex that the eye sees and whose indirect light is cached. On the Cornell
// box four cost a third more than one.
constexpr std::uint32_t stop_light_samples = 4;
// There, besides, so many directions by the cosine toward the environment, whose even parts light
// sampling finds badly beside a sun: no path goes on by the diffuse lobe.
constexpr std::uint32_t stop_sky_samples = 2;
constexpr std::uint32_t sky_stream = 0x5c7eau;
// A pixel's size grows so many times over where a path that has been scattered lands.
constexpr float scattered_footprint = 4.0f;
// Discs of photons that the eye sees have a radius of so many pixels, others of one footprint;
// none is larger than this share of the scene's radius.
constexpr float photon_pixels = 2.5f;
constexpr float longest_photon_radius = 0.05f;
constexpr std::uint32_t photon_stream = 0x9407u;
// Survivors of the roulette are at most this much brighter, which bounds the noise that it adds.
constexpr float min_survival = 0.05f;
// Paths that lose nothing, between mirrors or by total reflection, end all the same: from this
// depth on by this chance.
constexpr int endless_depth = 64;
constexpr float endless_survival = 0.99f;

float max_component(const Color& c) {
  return std::max({c.x, c.y, c.z});
}

bool is_finite(const Color& c) {
  return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
}

// Veach's power heuristic with exponent two, safe for any finite densities.
float power_heuristic(float taken, float other) {
  if (other <= 0.0f) return 1.0f;
  const float ratio = other / taken;
  return 1.0f / (1.0f + ratio * ratio);
}

// What a diffuse lobe makes of cached light. The lobe's dependence on the direction of light is
// taken where the source stands, and for the sky at its mean cosine.
Color reflected_diffusely(const Bsdf& bsdf, const CachedLight& cached) {
  const V3f& normal = bsdf.normal();
  // Sky and source together are the irradiance where the normal is not bent.
  if (bsdf.lambertian() && normal == cached.sky_normal)
    return bsdf.diffuse_brdf(normal) * cached.light.irradiance(normal);
  const SkyAndSource light = split_light(cached.light, cached.sky_normal);
  const Color sky = light.sky_irradiance(cached.sky_normal, normal);
  const Color source = light.source_irradiance(normal);
  if (bsdf.lambertian()) return bsdf.diffuse_brdf(normal) * (sky + source);
  constexpr float sky_cosine = 2.0f / 3.0f;
  const V3f oblique =
      sky_cosine * normal + std::sqrt(1.0f - sky_cosine * sky_cosine) * make_frame(normal).t;
  return bsdf.diffuse_brdf(oblique) * sky + bsdf.diffuse_brdf(light.mean_direction) * source;
}

// The first vertex of a path, kept until all of the path's continuations have left it.
struct Fork {
  SurfacePoint point;
  SurfaceParameters parameters;
  Bsdf bsdf;
  V3f receiver;
  std::uint32_t light_samples;  // that were taken there
  Color throughput;
  MediumStack media;
  float length;  // of the path from the eye
};

// A vertex with cached light, where the path stays for several light samples before it goes on by
// the lobes that are left.
struct Stop {
  SurfacePoint point;
  SurfaceParameters parameters;
  Bsdf bsdf;
  Bsdf rest;  // without the lobes whose light is cached
  std::uint32_t cached_kinds;
  V3f receiver;

  // Whether the cached lobe is the diffuse one alone, which is easily sampled by itself.
  bool samples_sky() const { return cached_kinds == kind_bit(LobeKind::diffuse); }
};

struct Lane {
  bool active = false;
  bool camera_ray = false;
  bool ended = false;       // nothing more to trace but perhaps a shadow ray
  std::uint32_t pixel = 0;  // of the tile
  std::uint32_t sample = 0;
  std::uint32_t seed = 0;          // of the pixel
  std::uint32_t continuation = 0;  // of the splits that leave the first vertex
  std::uint32_t splits = usual_splits;
  bool probe = false;  // left a diffuse lobe whose other light is cached: brings caustics alone
  bool probe_bent = false;  // since then an S event other than straight through a thin wall
  float length = 0.0f;      // of the path from the eye, scene units
  int depth = 0;            // scattering events so far

  V3f origin{0.0f}, direction{0.0f};
  float near = 0.0f, far = std::numeric_limits<float>::infinity();
  Color throughput{0.0f};
  float radiance_scale =
      1.0f;  // product of squared ratios of indices: what throughput owes to refraction alone
  Term term = Term::emitted;
  MediumStack media;
  CausticState caustic;

  // How light sampling at the last vertex could have found what this ray finds.
  float light_trials = 0.0f;  // light samples there; 0: none
  V3f vertex{0.0f}, vertex_normal{0.0f};
  float scatter_pdf = 0.0f;

  std::uint32_t light_samples = 1, light_sample = 0;  // of the vertex, and which of them is next
  // The diffuse lobe has the direct light of the environment's even part there.
  bool even_cached = false;
  bool shadow = false;
  V3f shadow_origin{0.0f}, shadow_target{0.0f};
  // If nothing is in between: of non-specular and of specular lobes.
  Color shadow_light[2] = {Color(0.0f), Color(0.0f)};
  // Besides, of the diffuse lobe, if thin walls are in between and nothing else: what is cached
  // otherwise.
  Color shadow_even{0.0f};
  Term shadow_term[2] = {Term::direct, Term::specular};

  std::array<Color, term_count> radiance;
  float photons = 0.0f;  // brightness that photons brought
  Color albedo{0.0f};
  V3f normal{0.0f}, position{0.0f};
  float hit_depth = 0.0f;
  std::int32_t object = -1;
  bool follows_mirror =
      false;  // left the first hit by a specular lobe, until it hits what that shows
  float mirrored = shows_nothing;

  Lane() { radiance.fill(Color(0.0f)); }

  void add(Term to, const Color& light) { radiance[static_cast<std::size_t>(to)] += light; }

  // Continuations have a sequence of their own, of which each takes a point, so that those of one
  // pixel are spread evenly over all of its samples. So do further samples of a use.
  std::uint32_t index_of(std::uint32_t block, std::uint32_t uses = 1, std::uint32_t use = 0) const {
    const bool continued = block >= first_continued_block;
    const std::uint32_t index = sample * (continued ? splits : 1) + (continued ? continuation : 0);
    return index * uses + use;
  }
  // Blocks of random numbers for light sampling at the path's last vertex and for scattering there.
  std::uint32_t light_block() const { return 1 + 2 * static_cast<std::uint32_t>(depth); }
  std::uint32_t scatter_block() const { return light_block() + 1; }
};

// A block of random numbers of each of eight lanes.
struct DrawnBlocks {
  Lanes8 index, block;
  std::array<std::array<float, 4>, 8> points;
};

// What the lanes draw ahead.
struct DrawnNumbers {
  DrawnBlocks for_lights, to_scatter;
  std::array<V3f, 8> directions;  // by the cosine, of to_scatter
};

}  // namespace

// The lanes of one tile.
class PathStream {
 public:
  PathStream(const PathTracer& tracer, const Tile& tile, std::uint32_t first_sample,
             std::uint32_t sample_count, std::vector<PixelSums>& sums, RenderStatistics& statistics,
             const CacheUse& cache)
      : t_(tracer),
        tile_(tile),
        first_sample_(first_sample),
        pixel_count_(static_cast<std::uint32_t>(tile.width) *
                     static_cast<std::uint32_t>(tile.height)),
        path_count_(std::uint64_t(pixel_count_) * sample_count),
        cache_(cache),
        terms_(tracer.settings_.terms),
        sums_(&sums),
        statistics_(statistics) {}

  // ranges: none empty.
  PathStream(const PathTracer& tracer, const Tile& tile, const std::vector<SampleRange>& ranges,
             std::vector<PixelSums>& sums, RenderStatistics& statistics, const CacheUse& cache)
      : t_(tracer),
        tile_(tile),
        path_count_(count(ranges)),
        cache_(cache),
        terms_(tracer.settings_.terms),
        sums_(&sums),
        ranges_(&ranges),
        statistics_(statistics) {}

  // For paths that gather light.
  PathStream(const PathTracer& tracer, const std::vector<GatherRay>& rays, const MediumStack& media,
             std::uint32_t seed, std::vector<GatherResult>& results, RenderStatistics& statistics,
             const CacheUse& cache, Term term)
      : t_(tracer),
        path_count_(rays.size()),
        cache_(cache),
        terms_(term_bit(term)),
        rays_to_gather_(&rays),
        gather_media_(media),
        gather_seed_(seed),
        results_(&results),
        gathered_(term),
        statistics_(statistics) {}

  void run() {
    set_constants(rays_.ray);
    set_constants(shadow_rays_);
    while (fill()) {
      trace();
      draw();
      for (int i = 0; i < lane_count; ++i) {
        if (lanes_[i].active) shade(i);
      }
      trace_shadows();
      trace_further_shadows();
      for (Lane& lane : lanes_) {
        while (lane.active && lane.ended && fork_of(lane)) next_continuation(lane);
        if (lane.active && lane.ended) results_ ? deliver(lane) : deposit(lane);
      }
    }
  }

 private:
  static std::uint64_t count(const std::vector<SampleRange>& ranges) {
    std::uint64_t samples = 0;
    for (const SampleRange& range : ranges) samples += range.count;
    return samples;
  }

  // The random numbers that the lanes will need at their next vertices, if nothing changes there.
  void draw() {
    for (std::size_t first = 0; first < lane_count; first += 8) {
      DrawnNumbers& drawn = drawn_[first / 8];
      Lanes8 seeds = {};
      for (std::size_t i = 0; i < 8; ++i) {
        const Lane& lane = lanes_[first + i];
        seeds[i] = lane.seed;
        drawn.for_lights.block[i] = lane.light_block();
        drawn.for_lights.index[i] = lane.index_of(lane.light_block());
        drawn.to_scatter.block[i] = lane.scatter_block();
        drawn.to_scatter.index[i] = lane.index_of(lane.scatter_block());
      }
      for (DrawnBlocks* blocks : {&drawn.for_lights, &drawn.to_scatter})
        sobol_points(blocks->index, hash_combine(seeds, blocks->block), blocks->points);
      sample_cosine_hemispheres(drawn.to_scatter.points, drawn.directions);
    }
  }

  std::size_t number_of(const Lane& lane) const { return static_cast<std::size_t>(&lane - lanes_); }

  // Four numbers for light sampling.
  std::array<float, 4> random_for_lights(const Lane& lane) const {
    const std::size_t i = number_of(lane);
    const DrawnBlocks& drawn = drawn_[i / 8].for_lights;
    const std::uint32_t block = lane.light_block(),
                        index = lane.index_of(block, lane.light_samples, lane.light_sample);
    if (drawn.block[i % 8] == block && drawn.index[i % 8] == index) return drawn.points[i % 8];
    return sobol_point(index, hash_combine(lane.seed, block));
  }

  // A direction by the BSDF; u_survival: a number for the roulette.
  bool sample_bsdf(const Lane& lane, const Bsdf& bsdf, BsdfSample& sample,
                   float& u_survival) const {
    const std::size_t i = number_of(lane);
    const DrawnNumbers& drawn = drawn_[i / 8];
    const std::uint32_t block = lane.scatter_block(), index = lane.index_of(block);
    const bool known =
        drawn.to_scatter.block[i % 8] == block && drawn.to_scatter.index[i % 8] == index;
    const std::array<float, 4> u =
        known ? drawn.to_scatter.points[i % 8] : sobol_point(index, hash_combine(lane.seed, block));
    u_survival = u[3];
    if (known && bsdf.lambertian()) return bsdf.sample_lambertian(drawn.directions[i % 8], sample);
    return bsdf.sample(u[0], V2f(u[1], u[2]), sample);
  }

  // Starts paths in idle lanes; false when none are left and none run.
  bool fill() {
    bool any = false;
    for (Lane& lane : lanes_) {
      if (!lane.active && next_path_ < path_count_) {
        results_ ? start_gathering(lane, next_path_++) : start(lane, next_path_++);
      }
      any = any || lane.active;
    }
    return any;
  }

  void start(Lane& lane, std::uint64_t path) {
    lane = Lane();
    lane.active = true;
    lane.caustic.photons = cache_.photons != nullptr;
    lane.camera_ray = true;
    bool centered = false;
    std::uint32_t pixel;
    if (ranges_) {
      const SampleRange& range = (*ranges_)[range_];
      centered = range.centered;
      pixel = range.pixel;
      lane.pixel = range.sums;
      lane.sample = range.first + within_range_;
      if (++within_range_ == range.count) {
        ++range_;
        within_range_ = 0;
      }
    } else {
      pixel = lane.pixel = static_cast<std::uint32_t>(path % pixel_count_);
      lane.sample = first_sample_ + static_cast<std::uint32_t>(path / pixel_count_);
    }
    const int x = tile_.x + static_cast<int>(pixel) % tile_.width;
    const int y = tile_.y + static_cast<int>(pixel) / tile_.width;
    const auto seed_low = static_cast<std::uint32_t>(t_.settings_.seed);
    const auto seed_high = static_cast<std::uint32_t>(t_.settings_.seed >> 32);
    if (cache_.any()) lane.splits = 1;
    lane.seed =
        hash_combine(hash_combine(hash_combine(seed_low, seed_high), static_cast<std::uint32_t>(x)),
                     static_cast<std::uint32_t>(y));
    const std::array<float, 4> u = sobol_point(lane.index_of(0), hash_combine(lane.seed, 0));
    const V2f offset = centered ? V2f(0.0f) : t_.filter_.offset(V2f(u[0], u[1]));
    const CameraRay ray = t_.camera_.ray(static_cast<float>(x) + 0.5f + offset.x,
                                         static_cast<float>(y) + 0.5f + offset.y);
    lane.origin = ray.origin;
    lane.direction = ray.direction;
    lane.near = ray.near;
    lane.far = ray.far;
    lane.throughput = Color(1.0f);
    lane.hit_depth = std::numeric_limits<float>::infinity();
    ++statistics_.samples;
  }

  // A path whose first event, on a broad lobe, is behind it.
  void start_gathering(Lane& lane, std::uint64_t path) {
    lane = Lane();
    const GatherRay& ray = (*rays_to_gather_)[path];
    lane.active = true;
    lane.pixel = static_cast<std::uint32_t>(path);
    lane.sample = ray.index;
    lane.seed = gather_seed_;
    lane.splits = 1;
    lane.depth = 1;
    lane.origin = ray.origin;
    lane.direction = ray.direction;
    lane.throughput = Color(1.0f);
    lane.term = Term::direct;
    lane.caustic.photons = cache_.photons != nullptr;
    lane.caustic.event(LobeKind::diffuse, false, Term::direct);
    lane.media = gather_media_;
    lane.hit_depth = std::numeric_limits<float>::infinity();
    ++statistics_.gather_paths;
  }

  void deliver(Lane& lane) {
    lane.active = false;
    const auto term = static_cast<std::size_t>(gathered_);
    GatherResult& result = (*results_)[lane.pixel];
    result.distance = lane.hit_depth;
    result.radiance = Color(0.0f);
    if (is_finite(lane.radiance[term])) {
      result.radiance = lane.radiance[term];
    } else {
      ++statistics_.dropped[term];
    }
  }

  // Lanes of one packet: their numbers, and how many they are.
  struct Packet {
    std::array<int, packet_size> lanes;
    int size = 0;
  };

  // Puts the lanes for which wanted(lane) holds into packets, and hands these to trace_packet.
  template <typename Wanted, typename TracePacket>
  void in_packets(Wanted wanted, TracePacket trace_packet) {
    Packet packet;
    for (int i = 0; i < lane_count; ++i) {
      if (!wanted(lanes_[i])) continue;
      packet.lanes[static_cast<std::size_t>(packet.size++)] = i;
      if (packet.size < packet_size) continue;
      trace_packet(packet);
      packet.size = 0;
    }
    if (packet.size > 0) trace_packet(packet);
  }

  TraceQuery query_of(const Packet& packet) {
    TraceQuery query = t_.scene_.query();
    if (t_.scene_.has_filters()) seed(packet);
    query.seeds = seeds_;
    return query;
  }

  void trace() {
    in_packets([](const Lane& lane) { return lane.active; },
               [this](const Packet& packet) { trace(packet); });
  }

  void trace(const Packet& packet) {
    alignas(32) int valid[packet_size];
    set_valid(rays_.ray, packet.size, valid);
    for (int i = 0; i < packet.size; ++i) {
      const Lane& lane = lanes_[packet.lanes[i]];
      set_ray(rays_, i, lane.origin, lane.direction, lane.near, lane.far);
      ++(lane.camera_ray ? statistics_.rays_camera : statistics_.rays_scatter);
    }
    TraceQuery query = query_of(packet);
    embree::intersect8(valid, t_.scene_.handle(), query.context, rays_);
    const RTCHit8& h = rays_.hit;
    for (int i = 0; i < packet.size; ++i)
      hits_[packet.lanes[i]] = {rays_.ray.tfar[i], h.u[i],      h.v[i],
                                h.geomID[i],       h.primID[i], h.instID[0][i]};
  }

  void trace_shadows() {
    in_packets([](const Lane& lane) { return lane.active && lane.shadow; },
               [this](const Packet& packet) { trace_shadows(packet); });
  }

  void trace_shadows(const Packet& packet) {
    alignas(32) int valid[packet_size];
    set_valid(shadow_rays_, packet.size, valid);
    for (int i = 0; i < packet.size; ++i) {
      const Lane& lane = lanes_[packet.lanes[i]];
      set_ray(shadow_rays_, i, lane.shadow_origin, lane.shadow_target - lane.shadow_origin, 0.0f,
              1.0f);
      transmittance_[i] = Color(1.0f);
      passed_thin_[i] = 0;
      ++statistics_.rays_shadow;
    }
    TraceQuery query = query_of(packet);
    query.transmittance = transmittance_;
    query.passed_thin = passed_thin_;
    embree::occluded8(valid, t_.scene_.handle(), query.context, shadow_rays_);
    for (int i = 0; i < packet.size; ++i) {
      Lane& lane = lanes_[packet.lanes[i]];
      lane.shadow = false;
      if (shadow_rays_.tfar[i] < 0.0f) continue;
      for (int kind = 0; kind < 2; ++kind) {
        const Term term = passed_thin_[i] ? after_event(lane.shadow_term[kind], LobeKind::specular)
                                          : lane.shadow_term[kind];
        lane.add(term, lane.shadow_light[kind] * transmittance_[i]);
      }
      if (passed_thin_[i]) {
        lane.add(after_event(lane.shadow_term[0], LobeKind::specular),
                 lane.shadow_even * transmittance_[i]);
      }
    }
  }

  // The other light samples of paths that end where all but direct light is cached.
  void trace_further_shadows() {
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

  // Whether the diffuse lobe has all of its direct light.
  bool only_even_light(const Lane& lane) const {
    return lane.even_cached && t_.lights_.environment_alone() &&
           !t_.lights_.environment().has_peaks() && !t_.scene_.has_filters();
  }

  // What the diffuse lobe makes of the environment, by a direction that the lobe would scatter to.
  void sample_sky(Lane& lane, const Stop& stop, std::uint32_t number) {
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
  }

  // A new seed for every ray, so that passing a partly opaque surface once says nothing of the next
  // time.
  void seed(const Packet& packet) {
    ++rounds_;
    for (int i = 0; i < packet.size; ++i) {
      const Lane& lane = lanes_[packet.lanes[i]];
      seeds_[i] = hash_combine(hash_combine(lane.seed, lane.sample), rounds_);
    }
  }

  void shade(int i) {
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

  // light_samples: that were taken here.
  void go_on(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
             const Bsdf& bsdf, const V3f& receiver, std::uint32_t light_samples) {
    if (lane.depth == 0 && lane.splits > 1)
      fork(lane, point, parameters, bsdf, receiver, light_samples);
    scatter(lane, point, parameters, bsdf, receiver, light_samples);
  }

  // Size of a pixel, or of what a gathering path stands for, where the path has come to.
  float footprint(const Lane& lane) const {
    if (results_) return cache_.spread * lane.length;
    const float pixel = t_.camera_.footprint(lane.length);
    return lane.caustic.scattered ? pixel * scattered_footprint : pixel;
  }

  // Adds what photons bring to the non-specular lobes.
  void add_photons(Lane& lane, const SurfacePoint& point, const Bsdf& bsdf) {
    const Term once = after_event(lane.term, LobeKind::diffuse);
    const Term caustic = after_event(once, LobeKind::specular);
    const Term patchy = after_event(once, LobeKind::diffuse);
    if (((term_bit(caustic) | term_bit(patchy)) & terms_) == 0) return;
    const bool seen = !results_ && !lane.caustic.scattered;
    PhotonQuery query;
    query.position = point.position;
    query.geometric_normal = point.geometric_normal;
    query.error = point.error;
    query.most_radius = longest_photon_radius * t_.scene_.radius();
    query.radius = std::min((seen ? photon_pixels : 1.0f) * footprint(lane), query.most_radius);
    query.gathering = !seen;
    query.glossy = !lane.caustic.broad;
    query.seed = hash_combine(hash_combine(lane.seed, lane.sample),
                              photon_stream + static_cast<std::uint32_t>(lane.depth));
    if (t_.settings_.max_depth > 0) query.max_events = t_.settings_.max_depth - lane.depth;
    const PhotonLight light = cache_.photons->reflect(query, bsdf, statistics_);
    const auto add = [&](Term to, const Color& reflected) {
      const Color brought = lane.throughput * reflected;
      lane.add(to, brought);
      if ((terms_ & term_bit(to)) != 0) lane.photons += mean(brought);
    };
    add(caustic, light.caustic);
    add(patchy, light.patchy);
  }

  // Of the lobes that are there, those whose indirect light caches hold.
  std::uint32_t cached_kinds(const Bsdf& bsdf, const SurfaceParameters& parameters) const {
    if (cache_.paper) return paper_kinds(bsdf, parameters);
    const bool any = cache_.indirect || (cache_.direct && cache_.asks());
    return any && bsdf.has(LobeKind::diffuse) ? kind_bit(LobeKind::diffuse) : 0;
  }

  // Adds those lobes' indirect light, where the cache has it; otherwise asks for it.
  bool use_cache(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
                 const Bsdf& bsdf) {
    CachePoint at;
    at.position = point.position;
    at.geometric_normal = point.geometric_normal;
    at.normal = point.normal;
    at.error = point.error;
    at.footprint = footprint(lane);
    at.instance = point.instance;
    if (cache_.paper)
      return use_paper_cache(lane, {at, -lane.direction, parameters, lane.media}, bsdf);
    CachedLight light;
    const Term direct = after_event(lane.term, LobeKind::diffuse);
    if (cache_.requests && cache_.requested == Term::direct) {
      if (!lane.media.top()) look_up(*cache_.direct, lane, at, light);
      return false;
    }
    if (!look_up(*cache_.indirect, lane, at, light)) return false;
    lane.add(after_event(direct, LobeKind::diffuse),
             lane.throughput * reflected_diffusely(bsdf, light));
    // What a volume takes of light from infinitely far away is not cached.
    if (cache_.direct && !lane.media.top() && !cache_.requests &&
        look_up(*cache_.direct, lane, at, light)) {
      lane.add(direct, lane.throughput * reflected_diffusely(bsdf, light));
      lane.even_cached = true;
    }
    return true;
  }

  // What is not found is asked for, where that is wanted.
  bool look_up(const IrradianceCache& cache, const Lane& lane, const CachePoint& at,
               CachedLight& light) {
    if (cache.look_up(at, cache_.budget, cache_.needed_weight, light,
                      statistics_.rays_visibility)) {
      ++statistics_.cache_hits;
      return true;
    }
    ++statistics_.cache_misses;
    if (cache_.requests) cache_.requests->push_back({at, lane.media});
    return std::any_of(cache_.meanwhile_budgets.begin(), cache_.meanwhile_budgets.end(),
                       [&](float budget) {
                         return budget > 0.0f &&
                                cache.look_up(at, budget, 0.0f, light, statistics_.rays_visibility);
                       });
  }

  bool use_paper_cache(Lane& lane, const PaperPoint& point, const Bsdf& bsdf) {
    Color radiance(0.0f);
    if (!cache_.paper->look_up(point, bsdf, radiance)) {
      ++statistics_.cache_misses;
      if (cache_.paper_requests) cache_.paper_requests->push_back(point);
      return false;
    }
    ++statistics_.cache_hits;
    const Term term = after_event(after_event(lane.term, LobeKind::diffuse), LobeKind::diffuse);
    lane.add(term, lane.throughput * radiance);
    return true;
  }

  // Direct and caustic light of the lobes of those kinds, whose indirect light is cached, and all
  // light of the others.
  void shade_beside_cache(Lane& lane, const SurfacePoint& point,
                          const SurfaceParameters& parameters, const Bsdf& bsdf,
                          std::uint32_t kinds, const V3f& receiver, bool may_sample_lights) {
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
    if (may_sample_lights && !results_ && !lane.caustic.scattered) {
      // What it cost to come here is spread over several light samples.
      lane.light_samples = stop_light_samples;
      stop_of(lane).emplace(Stop{point, parameters, bsdf, rest, kinds, receiver});
      sample_light(lane, point, bsdf, rest, receiver, kinds);
      return;
    }
    if (may_sample_lights) sample_light(lane, point, bsdf, rest, receiver, kinds);
    go_on(lane, point, parameters, rest, receiver, may_sample_lights ? 1 : 0);
  }

  std::optional<Stop>& stop_of(const Lane& lane) { return stops_[number_of(lane)]; }

  std::optional<Fork>& fork_of(const Lane& lane) { return forks_[number_of(lane)]; }

  // Leaves out of the shadow ray's light what the diffuse lobe makes of the environment's even
  // part. diffuse: what the lobe makes of all of that radiance.
  void take_even(Lane& lane, const Color& diffuse, const Color& radiance) const {
    const Color even = diffuse * (1.0f - t_.lights_.environment().peak_share(radiance));
    lane.shadow_light[0] -= even;
    for (int c = 0; c < 3; ++c)
      lane.shadow_light[0][c] = std::max(0.0f, lane.shadow_light[0][c]);  // of rounding
    if (t_.scene_.has_filters()) lane.shadow_even = even;
  }

  bool any_shadow_light(const Lane& lane) const {
    const auto terms = [](const Color& light, Term term) {
      return is_black(light) ? 0u : reachable_terms(term);
    };
    return ((terms(lane.shadow_light[0], lane.shadow_term[0]) |
             terms(lane.shadow_even, lane.shadow_term[0]) |
             terms(lane.shadow_light[1], lane.shadow_term[1])) &
            terms_) != 0;
  }

  // What lobes that are not cached bring is most of the noise where other light is; delta lobes
  // have one way to go.
  void split_beside_cache(Lane& lane, const Bsdf& traced) const {
    if (!results_ && !cache_.asks() && lane.depth == 0 && traced.has_non_delta())
      lane.splits = usual_splits;
  }

  // Keeps the first vertex, for as many continuations as the path has splits.
  void fork(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
            const Bsdf& bsdf, const V3f& receiver, std::uint32_t light_samples) {
    lane.throughput *= 1.0f / static_cast<float>(lane.splits);
    fork_of(lane).emplace(Fork{point, parameters, bsdf, receiver, light_samples, lane.throughput,
                               lane.media, lane.length});
  }

  // Sends the path off from its first vertex once more, or forgets the vertex after the last time.
  void next_continuation(Lane& lane) {
    if (++lane.continuation == lane.splits) {
      fork_of(lane).reset();
      return;
    }
    const Fork& fork = *fork_of(lane);
    lane.depth = 0;
    lane.term = Term::emitted;
    lane.caustic = CausticState();
    lane.caustic.photons = cache_.photons != nullptr;
    lane.probe = lane.follows_mirror = false;
    lane.length = fork.length;
    lane.light_trials = 0.0f;
    lane.radiance_scale = 1.0f;
    lane.throughput = fork.throughput;
    lane.media = fork.media;
    scatter(lane, fork.point, fork.parameters, fork.bsdf, fork.receiver, fork.light_samples);
  }

  void add_environment(Lane& lane) {
    const EnvironmentLight& environment = t_.lights_.environment();
    if (environment.black() || (lane.probe && !lane.probe_bent)) return;
    if (lane.caustic.left_to_light_paths() && t_.lights_.environment_light_traced(lane.direction))
      return;
    float weight = 1.0f;
    if (lane.light_trials > 0.0f) {
      weight =
          power_heuristic(lane.scatter_pdf,
                          lane.light_trials * t_.lights_.pdf_environment(
                                                  lane.vertex, lane.vertex_normal, lane.direction));
    }
    lane.add(lane.term, lane.throughput * environment.radiance(lane.direction) * weight);
  }

  void add_even_environment(Lane& lane) {
    const EnvironmentLight& environment = t_.lights_.environment();
    const Color radiance = environment.radiance(lane.direction);
    lane.add(lane.term, radiance * (1.0f - environment.peak_share(radiance)));
  }

  void add_emission(Lane& lane, const SurfacePoint& point, const Color& emission) {
    if (lane.probe && !lane.probe_bent) return;
    if (lane.caustic.left_to_light_paths() && t_.lights_.light_traced(point)) return;
    float weight = 1.0f;
    if (lane.light_trials > 0.0f) {
      weight = power_heuristic(
          lane.scatter_pdf,
          lane.light_trials * t_.lights_.pdf(lane.vertex, lane.vertex_normal, point));
    }
    lane.add(lane.term, lane.throughput * emission * weight);
  }

  // Absorption along the ray, in the volume that it runs through.
  void absorb(Lane& lane, const SurfacePoint& point, float distance) {
    const Material* medium = lane.media.top();
    const Material& m = *point.material;
    // A path that started inside a volume finds out when it comes to its boundary.
    if (!medium && !point.front && m.transmission > 0.0f && !m.thin_walled) medium = &m;
    if (medium) lane.throughput *= volume_transmittance(*medium, distance);
  }

  void note_first_hit(Lane& lane, const SurfacePoint& point, const Color& albedo,
                      const V3f& normal) {
    lane.albedo = albedo;
    lane.normal = normal;
    lane.position = point.position;
    lane.hit_depth = t_.camera_.depth(point.position);
    lane.object = point.instance;
  }

  // scattered: what paths go on by, of bsdf. alone_kinds: none will go on by lobes of those kinds
  // to where a light could be found.
  void sample_light(Lane& lane, const SurfacePoint& point, const Bsdf& bsdf, const Bsdf& scattered,
                    const V3f& receiver, std::uint32_t alone_kinds) {
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
  }

  // What the lobes of any surface make of a light sample.
  void add_scattered(Lane& lane, const Bsdf& bsdf, const Bsdf& scattered, const LightSample& light,
                     const Color& arriving, float trials, float sky_trials,
                     std::uint32_t alone_kinds) const {
    const BsdfValue f = bsdf.eval(light.direction);
    const BsdfValue competing = &scattered == &bsdf ? f : scattered.eval(light.direction);
    const auto weighted = [&](LobeKind kind) {
      if (light.light_traced && lane.caustic.left_to_light_paths(kind)) return Color(0.0f);
      const bool alone = light.delta || (alone_kinds & kind_bit(kind)) != 0;
      const float other =
          alone ? sky_trials * cosine_hemisphere_pdf(bsdf.normal().dot(light.direction))
                : trials * competing.pdf_of(kind);
      return f.of(kind) * power_heuristic(light.pdf, other);
    };
    const Color diffuse = arriving * weighted(LobeKind::diffuse);
    lane.shadow_light[0] =
        diffuse + arriving * (weighted(LobeKind::broad) + weighted(LobeKind::glossy));
    lane.shadow_light[1] = arriving * weighted(LobeKind::specular);
    if (lane.even_cached && light.environment) take_even(lane, diffuse, light.radiance);
  }

  void scatter(Lane& lane, const SurfacePoint& point, const SurfaceParameters& parameters,
               const Bsdf& bsdf, const V3f& receiver, std::uint32_t light_samples,
               std::uint32_t cached_kinds = 0) {
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
    lane.origin = offset_origin(point, s.wi);
    lane.direction = s.wi;
    lane.near = 0.0f;
    lane.far = std::numeric_limits<float>::infinity();
    lane.ended = false;
  }

  void deposit(Lane& lane) {
    lane.active = false;
    PixelSums& sums = (*sums_)[lane.pixel];
    bool finite = true;
    for (std::size_t i = 0; i < term_count; ++i) {
      if (is_finite(lane.radiance[i])) continue;
      finite = false;
      ++statistics_.dropped[i];
    }
    if (lane.sample == sums.first_sample) {
      sums.position = lane.position;
      sums.depth = lane.hit_depth;
      sums.object = lane.object;
    }
    if (!finite) return;
    float brightness = 0.0f;
    for (std::size_t i = 0; i < term_count; ++i) {
      if ((terms_ & (1u << i)) == 0) continue;
      sums.terms[i] += lane.radiance[i];
      brightness += mean(lane.radiance[i]);
    }
    sums.squares += brightness * brightness;
    const float traced = brightness - lane.photons;
    sums.traced_squares += traced * traced;
    sums.photons += lane.photons;
    sums.mirrored = lane.mirrored;
    sums.albedo += lane.albedo;
    sums.normal += lane.normal;
    ++sums.samples;
  }

  const PathTracer& t_;
  const Tile tile_ = {};
  const std::uint32_t first_sample_ = 0;
  const std::uint32_t pixel_count_ = 0;
  const std::uint64_t path_count_;
  std::uint64_t next_path_ = 0;
  std::uint32_t rounds_ = 0;
  const CacheUse cache_ = {};
  const std::uint32_t terms_;
  std::vector<PixelSums>* sums_ = nullptr;
  const std::vector<SampleRange>* ranges_ = nullptr;
  std::size_t range_ = 0;
  std::uint32_t within_range_ = 0;
  const std::vector<GatherRay>* rays_to_gather_ = nullptr;
  MediumStack gather_media_;
  std::uint32_t gather_seed_ = 0;
  std::vector<GatherResult>* results_ = nullptr;
  const Term gathered_ = Term::indirect;
  RenderStatistics& statistics_;

  DrawnNumbers drawn_[lane_count / 8];
  // One packet at a time.
  RTCRayHit8 rays_;
  RTCRay8 shadow_rays_;
  std::uint32_t seeds_[packet_size] = {};
  Color transmittance_[packet_size];
  std::uint8_t passed_thin_[packet_size] = {};
  RayHit hits_[lane_count];
  Lane lanes_[lane_count];
  // Apart from the lanes: few of their bytes are needed at a time.
  std::optional<Fork> forks_[lane_count];
  std::optional<Stop> stops_[lane_count];
};

PathTracer::PathTracer(const TracedScene& scene, const Lights& lights, const CameraView& camera,
                       const RenderSettings& settings)
    : scene_(scene),
      lights_(lights),
      camera_(camera),
      settings_(settings),
      filter_(settings.filter) {
  eye_paths_find_caustics_ = lights.leaves_caustics() && !lights.leaves_all_caustics();
}

void PathTracer::render_tile(const Tile& tile, std::uint32_t first_sample,
                             std::uint32_t sample_count, std::vector<PixelSums>& sums,
                             RenderStatistics& statistics, const CacheUse& cache) const {
  PathStream stream(*this, tile, first_sample, sample_count, sums, statistics, cache);
  stream.run();
}

void PathTracer::render_ranges(const Tile& tile, const std::vector<SampleRange>& ranges,
                               std::vector<PixelSums>& sums, RenderStatistics& statistics,
                               const CacheUse& cache) const {
  PathStream stream(*this, tile, ranges, sums, statistics, cache);
  stream.run();
}

void PathTracer::gather(const std::vector<GatherRay>& rays, const MediumStack& media,
                        std::uint32_t seed, std::vector<GatherResult>& results,
                        RenderStatistics& statistics, const CacheUse& cache, Term term) const {
  results.resize(rays.size(), GatherResult());
  PathStream stream(*this, rays, media, seed, results, statistics, cache, term);
  stream.run();
}

}  // namespace lumivec
