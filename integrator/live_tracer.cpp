#include "integrator/live_tracer.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <mutex>
#include <optional>

#include "integrator/cache_builder.h"
#include "integrator/camera_view.h"
#include "integrator/light_tracer.h"
#include "integrator/lights.h"
#include "integrator/parallel.h"
#include "integrator/path_tracer.h"
#include "integrator/photon_map.h"
#include "integrator/ray_packet.h"
#include "integrator/traced_scene.h"

namespace lumivec {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int tile_side = 32;  // pixels
// Of a packet of rays.
constexpr int block_width = 4, block_height = packet_size / block_width;
// Records are asked for at every so many pixels in both directions, at another place of each block
// with every call.
constexpr int record_stride = 16;
// Odd, so that all places of a block have their turn.
constexpr int phase_step = 101;
// While records are missing those there are reach twice as far as they should, and err sixteen
// times as much: less than what few whole paths bring.
constexpr float meanwhile_budget = 16.0f;
// Light paths of a photon map.
constexpr std::uint64_t map_paths = 1 << 16;
constexpr std::uint32_t map_batch = 4096;

}  // namespace

struct LiveTracer::State {
  State(const Scene& scene, const RenderSettings& s)
      : settings(s),
        arena(s.threads > 0 ? s.threads : tbb::this_task_arena::max_concurrency()),
        traced(scene, arena.max_concurrency()),
        lights(traced),
        casters(caustic_casters(traced, s.specular_roughness)),
        cache(traced, s.validity_parts, s.cache_bytes),
        photons(traced) {
    if (cached() && !casters.empty()) lights.leave_caustics_to_light_paths(true);
  }

  bool cached() const { return settings.integrator == Integrator::light_vectors; }

  // Photons are where light falls, whatever the eye sees.
  void map_photons() {
    const LightTracer light_tracer(traced, lights, *view, settings, casters);
    if (!light_tracer.active()) return;
    std::vector<std::vector<Photon>> batches(map_paths / map_batch);
    for_each(batches.size(), [&](std::size_t i) {
      RenderStatistics counts;
      light_tracer.trace(i * map_batch, map_batch, batches[i], counts);
    });
    std::vector<Photon> all;
    for (const std::vector<Photon>& some : batches) all.insert(all.end(), some.begin(), some.end());
    statistics.photons += all.size();
    photons.build(std::move(all), map_paths, 0);
    has_photons = true;
  }

  // The pixels of one packet of rays, from (left, top) on.
  void see_block(int left, int top, std::vector<VisiblePoint>& points) const {
    RTCRayHit8 rays;
    set_constants(rays.ray);
    std::uint32_t seeds[packet_size] = {};
    alignas(32) int valid[packet_size];
    std::array<CameraRay, packet_size> camera;
    std::array<std::size_t, packet_size> pixel;
    int count = 0;
    for (int i = 0; i < packet_size; ++i) {
      const int x = left + i % block_width, y = top + i / block_width;
      if (x >= settings.width || y >= settings.height) continue;
      const CameraRay ray = view->ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      set_ray(rays, count, ray.origin, ray.direction, ray.near, ray.far);
      camera[std::size_t(count)] = ray;
      pixel[std::size_t(count)] = std::size_t(y) * std::size_t(settings.width) + std::size_t(x);
      ++count;
    }
    set_valid(rays.ray, count, valid);
    TraceQuery query = traced.query();
    query.seeds = seeds;
    embree::intersect8_coherent(valid, traced.handle(), query.context, rays);
    for (int i = 0; i < count; ++i) {
      const CameraRay& ray = camera[std::size_t(i)];
      const RTCHit8& h = rays.hit;
      RayHit hit = {rays.ray.tfar[i], h.u[i], h.v[i], h.geomID[i], h.primID[i], h.instID[0][i]};
      VisiblePoint& to = points[pixel[std::size_t(i)]];
      to = {V3f(0.0f), V3f(0.0f), std::numeric_limits<float>::infinity(), -1};
      while (hit.valid()) {
        const SurfacePoint p = traced.surface(hit, ray.origin, ray.direction);
        if (!culled(p)) {
          to = {p.position, p.normal, view->depth(p.position), p.instance};
          break;
        }
        hit = traced.intersect(ray.origin, ray.direction, next_distance(hit.distance, p.error),
                               ray.far, 0);
      }
    }
  }

  RenderSettings settings;
  tbb::task_arena arena;
  const TracedScene traced;
  Lights lights;
  const std::vector<BoundingSphere> casters;
  IrradianceCache cache;
  PhotonMap photons;
  bool has_photons = false;
  std::optional<CameraView> view, last_view;
  std::optional<PathTracer> tracer;  // of that view
  std::optional<CacheBuilder> builder;
  std::vector<Tile> tiles;
  int tiles_across = 0;
  int phase = 0;
  bool complete = false;  // records were found wherever they were looked for last
  RenderStatistics statistics;
  std::mutex mutex;  // of the statistics
};

LiveTracer::LiveTracer(const Scene& scene, const RenderSettings& settings)
    : state_(std::make_unique<State>(scene, settings)) {}

LiveTracer::~LiveTracer() = default;

void LiveTracer::set_view(const Camera& camera, int width, int height) {
  State& s = *state_;
  s.last_view = s.view;
  s.settings.width = width;
  s.settings.height = height;
  s.view.emplace(camera, s.traced, width, height);
  if (!s.last_view) s.last_view = s.view;
  s.tracer.emplace(s.traced, s.lights, *s.view, s.settings);
  s.tiles.clear();
  s.tiles_across = (width + tile_side - 1) / tile_side;
  for (int y = 0; y < height; y += tile_side) {
    for (int x = 0; x < width; x += tile_side)
      s.tiles.push_back({x, y, std::min(tile_side, width - x), std::min(tile_side, height - y)});
  }
  if (s.cached() && !s.builder) {
    // It knows the tracer by where it is, which stays the same.
    s.builder.emplace(*s.tracer, s.traced, s.settings, s.cache);
    s.arena.execute([&] { s.map_photons(); });
    if (s.has_photons) s.builder->set_photons(&s.photons);
  }
}

void LiveTracer::see(std::vector<VisiblePoint>& points) {
  State& s = *state_;
  const int width = s.settings.width, height = s.settings.height;
  points.resize(std::size_t(width) * std::size_t(height));
  s.arena.execute([&] {
    for_each(std::size_t((height + block_height - 1) / block_height), [&](std::size_t row) {
      const int y = static_cast<int>(row) * block_height;
      for (int x = 0; x < width; x += block_width) s.see_block(x, y, points);
    });
  });
  s.statistics.rays_camera += points.size();
}

bool LiveTracer::project(const V3f& p, int views_ago, V2f& pixel) const {
  V3f to_eye;
  float distance, importance;
  const CameraView& view = views_ago == 0 ? *state_->view : *state_->last_view;
  return view.project(p, pixel, to_eye, distance, importance);
}

float LiveTracer::footprint(float depth) const {
  return state_->view->footprint(depth);
}

void LiveTracer::trace(const std::vector<LiveRequest>& requests, bool centered,
                       std::vector<LiveSample>& samples) {
  State& s = *state_;
  std::vector<std::vector<LiveRequest>> by_tile(s.tiles.size());
  const auto width = static_cast<std::uint32_t>(s.settings.width);
  for (const LiveRequest& r : requests) {
    const std::uint32_t x = r.pixel % width, y = r.pixel / width;
    by_tile[(y / tile_side) * std::size_t(s.tiles_across) + x / tile_side].push_back(r);
  }
  std::vector<std::size_t> first(s.tiles.size() + 1, 0);
  for (std::size_t i = 0; i < s.tiles.size(); ++i) first[i + 1] = first[i] + by_tile[i].size();
  samples.resize(requests.size());
  CacheUse use;
  if (s.builder) {
    use = s.builder->use();
    if (!s.complete) use.budget *= meanwhile_budget;
  }
  s.arena.execute([&] {
    for_each(s.tiles.size(), [&](std::size_t t) {
      const std::vector<LiveRequest>& wanted = by_tile[t];
      if (wanted.empty()) return;
      const Tile& tile = s.tiles[t];
      const auto tile_width = static_cast<std::uint32_t>(tile.width);
      std::vector<PixelSums> sums(std::size_t(tile.width) * std::size_t(tile.height));
      std::vector<SampleRange> ranges;
      ranges.reserve(wanted.size());
      for (const LiveRequest& r : wanted) {
        const std::uint32_t x = r.pixel % width - static_cast<std::uint32_t>(tile.x),
                            y = r.pixel / width - static_cast<std::uint32_t>(tile.y);
        ranges.push_back({y * tile_width + x, r.sample, 1, centered});
      }
      RenderStatistics counts;
      s.tracer->render_ranges(tile, ranges, sums, counts, use);
      for (std::size_t i = 0; i < wanted.size(); ++i) {
        LiveSample& to = samples[first[t] + i];
        to.terms = sums[ranges[i].pixel].terms;
        to.pixel = wanted[i].pixel;
      }
      const std::lock_guard lock(s.mutex);
      s.statistics.add_counts(counts);
    });
  });
}

bool LiveTracer::improve(double seconds) {
  State& s = *state_;
  if (!s.builder) return true;
  const Clock::time_point start = Clock::now();
  const auto go_on = [&] {
    return std::chrono::duration<double>(Clock::now() - start).count() < seconds;
  };
  s.phase = (s.phase + phase_step) % (record_stride * record_stride);
  const std::uint32_t before = s.cache.size();
  bool all = true;
  s.arena.execute(
      [&] { all = s.builder->extend(s.tiles, record_stride, s.phase, go_on, s.statistics); });
  s.complete = all && s.cache.size() == before;
  s.statistics.records = s.cache.size();
  s.statistics.cache_bytes = s.cache.bytes() + s.photons.bytes();
  return all;
}

const V3d& LiveTracer::origin() const {
  return state_->traced.origin();
}

const RenderStatistics& LiveTracer::statistics() const {
  return state_->statistics;
}

}  // namespace lumivec
