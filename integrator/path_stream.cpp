#include "integrator/path_stream.h"

#include <cmath>
#include <limits>

#include "integrator/bsdf_color.h"
#include "integrator/partition.h"
#include "integrator/sampling.h"
#include "integrator/sobol.h"

namespace lumivec {
namespace {

bool is_finite(const Color& c) {
  return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
}

}  // namespace

PathStream::PathStream(const PathTracer& tracer, const Tile& tile, std::uint32_t first_sample,
                       std::uint32_t sample_count, std::vector<PixelSums>& sums,
                       RenderStatistics& statistics, const CacheUse& cache)
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

PathStream::PathStream(const PathTracer& tracer, const Tile& tile,
                       const std::vector<SampleRange>& ranges, std::vector<PixelSums>& sums,
                       RenderStatistics& statistics, const CacheUse& cache)
    : t_(tracer),
      tile_(tile),
      path_count_(count(ranges)),
      cache_(cache),
      terms_(tracer.settings_.terms),
      sums_(&sums),
      ranges_(&ranges),
      statistics_(statistics) {}

PathStream::PathStream(const PathTracer& tracer, const std::vector<GatherRay>& rays,
                       const MediumStack& media, std::uint32_t seed,
                       std::vector<GatherResult>& results, RenderStatistics& statistics,
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

std::uint64_t PathStream::count(const std::vector<SampleRange>& ranges) {
  std::uint64_t samples = 0;
  for (const SampleRange& range : ranges) samples += range.count;
  return samples;
}

void PathStream::run() {
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

void PathStream::draw() {
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

std::array<float, 4> PathStream::random_for_lights(const Lane& lane) const {
  const std::size_t i = number_of(lane);
  const DrawnBlocks& drawn = drawn_[i / 8].for_lights;
  const std::uint32_t block = lane.light_block(),
                      index = lane.index_of(block, lane.light_samples, lane.light_sample);
  if (drawn.block[i % 8] == block && drawn.index[i % 8] == index) return drawn.points[i % 8];
  return sobol_point(index, hash_combine(lane.seed, block));
}

bool PathStream::sample_bsdf(const Lane& lane, const Bsdf& bsdf, BsdfSample& sample,
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

bool PathStream::fill() {
  bool any = false;
  for (Lane& lane : lanes_) {
    if (!lane.active && next_path_ < path_count_) {
      results_ ? start_gathering(lane, next_path_++) : start(lane, next_path_++);
    }
    any = any || lane.active;
  }
  return any;
}

void PathStream::start(Lane& lane, std::uint64_t path) {
  lane = Lane();
  lane.active = true;
  lane.caustic.photons = cache_.photons != nullptr;
  lane.camera_ray = true;
  lane.ray_kind = eye_ray;
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
  lane.throughput = Color(ray.black ? 0.0f : 1.0f);
  if (ray.black) lane.near = lane.far = 0.0f;
  lane.hit_depth = std::numeric_limits<float>::infinity();
  ++statistics_.samples;
}

void PathStream::start_gathering(Lane& lane, std::uint64_t path) {
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

void PathStream::next_continuation(Lane& lane) {
  if (++lane.continuation == lane.splits) {
    fork_of(lane).reset();
    return;
  }
  const Fork& fork = *fork_of(lane);
  lane.depth = 0;
  lane.ray_kind = eye_ray;
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

TraceQuery PathStream::query_of(const Packet& packet) {
  TraceQuery query = t_.scene_.query();
  if (t_.scene_.has_filters()) seed(packet);
  query.seeds = seeds_;
  return query;
}

void PathStream::seed(const Packet& packet) {
  ++rounds_;
  for (int i = 0; i < packet.size; ++i) {
    const Lane& lane = lanes_[packet.lanes[i]];
    seeds_[i] = hash_combine(hash_combine(lane.seed, lane.sample), rounds_);
  }
}

void PathStream::trace() {
  in_packets([](const Lane& lane) { return lane.active; },
             [this](const Packet& packet) { trace(packet); });
}

void PathStream::trace(const Packet& packet) {
  alignas(32) int valid[packet_size];
  set_valid(rays_.ray, packet.size, valid);
  for (int i = 0; i < packet.size; ++i) {
    const Lane& lane = lanes_[packet.lanes[i]];
    set_ray(rays_, i, lane.origin, lane.direction, lane.near, lane.far);
    rays_.ray.mask[i] = mask_of(lane.ray_kind);
    ++(lane.camera_ray ? statistics_.rays_camera : statistics_.rays_scatter);
  }
  TraceQuery query = query_of(packet);
  embree::intersect8(valid, t_.scene_.handle(), query.context, rays_);
  const RTCHit8& h = rays_.hit;
  for (int i = 0; i < packet.size; ++i)
    hits_[packet.lanes[i]] = {rays_.ray.tfar[i], h.u[i],      h.v[i],
                              h.geomID[i],       h.primID[i], h.instID[0][i]};
}

void PathStream::trace_shadows() {
  in_packets([](const Lane& lane) { return lane.active && lane.shadow; },
             [this](const Packet& packet) { trace_shadows(packet); });
}

void PathStream::trace_shadows(const Packet& packet) {
  alignas(32) int valid[packet_size];
  set_valid(shadow_rays_, packet.size, valid);
  for (int i = 0; i < packet.size; ++i) {
    const Lane& lane = lanes_[packet.lanes[i]];
    set_ray(shadow_rays_, i, lane.shadow_origin, lane.shadow_target - lane.shadow_origin, 0.0f,
            1.0f);
    shadow_rays_.mask[i] = lane.shadow_mask;
    if (lane.shadow_mask == 0) valid[i] = 0;
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

void PathStream::deliver(Lane& lane) {
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

void PathStream::deposit(Lane& lane) {
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

}  // namespace lumivec
