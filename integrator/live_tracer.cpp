#include "integrator/live_tracer.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <optional>

#include "integrator/cache_builder.h"
#include "integrator/camera_view.h"
#include "integrator/light_tracer.h"
#include "integrator/lights.h"
#include "integrator/live_photons.h"
#include "integrator/parallel.h"
#include "integrator/path_tracer.h"
#include "integrator/ray_packet.h"
#include "integrator/seconds_since.h"
#include "integrator/traced_scene.h"

namespace lumivec {
namespace {

constexpr int tile_side = 32;  // pixels
// Samples or rays that a thread traces at once.
constexpr std::size_t chunk_size = 256;
// Of a packet of rays.
constexpr int block_width = 4, block_height = packet_size / block_width;
// Records are asked for at every so many pixels in both directions, at another place of each block
// with every call.
constexpr int record_stride = 16;
// Odd, so that all places of a block have their turn.
constexpr int phase_step = 101;
// At rest the error becomes smaller by this factor once so many places in turn lacked nothing, down
// to this share of what was asked for.
constexpr double resting_error_step = 0.7;
constexpr int places_to_sharpen = record_stride * record_stride / 4;
constexpr double least_error_share = 0.35;
// Looking for such places takes this share of the time for records, if there is anything to refine.
constexpr double share_of_looking = 0.3;
// Records are made from coarse to fine: first such that reach four times as far as they should,
// and err 256 times as much; then twice as far. While those are missing which a pixel should have,
// it makes do with others, and at last with any in an eighth of the scene or so: they err less than
// what a few whole paths bring.
constexpr std::array<float, 3> slacks = {256.0f, 16.0f, 1.0f};
constexpr std::array<float, 2> meanwhile_slacks = {16.0f, 4096.0f};
// Photon maps there can be at a time, in use and in the making.
constexpr std::uint64_t most_photon_maps = 8;

}  // namespace

struct LiveTracer::State {
  State(const Scene& scene, const RenderSettings& s)
      : settings(s),
        arena(s.threads > 0 ? s.threads : tbb::this_task_arena::max_concurrency()),
        traced(std::in_place, scene, arena.max_concurrency()),
        lights(std::in_place, *traced),
        cache(*traced, s.validity_parts, s.cache_bytes),
        photons(*traced, s.cache_bytes / most_photon_maps) {
    find_casters();
    keep_transforms();
  }

  void keep_transforms() {
    object_to_traced.clear();
    for (std::size_t i = 0; i < traced->instances().size(); ++i)
      object_to_traced.push_back(traced->object_to_traced(static_cast<int>(i)));
  }

  void find_casters() {
    casters = caustic_casters(*traced, settings.specular_roughness);
    if (cached() && !casters.empty()) lights->leave_caustics_to_light_paths(true);
  }

  bool cached() const { return settings.integrator == Integrator::light_vectors; }

  // Of cached light, as there is.
  CacheUse use() const {
    if (!builder) return {};
    CacheUse use = builder->use();
    if (level + 1 < slacks.size()) use.budget *= slacks[level + 1];
    for (std::size_t i = 0; i < meanwhile_slacks.size(); ++i)
      use.meanwhile_budgets[i] = use.budget * meanwhile_slacks[i];
    return use;
  }

  void set_error(double wanted) {
    if (error == wanted) return;
    error = wanted;
    complete = 0;
    completed = false;
    builder->set_error(error);
  }

  // What holds until gather_photons() has had its time.
  void restart_photons() {
    light_tracer.emplace(*traced, *lights, *view, settings, casters);
    photons.restart(*light_tracer, std::size_t(settings.width) * std::size_t(settings.height),
                    arena, statistics);
    builder->set_photons(photons.in_use());
  }

  // Up to a packet of pixels.
  void see_packet(const PictureRays& rays, const std::uint32_t* pixels, std::size_t count,
                  VisibleSurfaces& seen) const {
    RTCRayHit8 packet;
    set_constants(packet.ray);
    std::fill_n(packet.ray.mask, packet_size, mask_of(eye_ray));
    std::uint32_t seeds[packet_size] = {};
    alignas(32) int valid[packet_size];
    std::array<V3f, packet_size> direction;
    const auto width = static_cast<std::uint32_t>(settings.width);
    for (std::size_t i = 0; i < count; ++i) {
      const float x = static_cast<float>(pixels[i] % width) + 0.5f,
                  y = static_cast<float>(pixels[i] / width) + 0.5f;
      direction[i] = rays.direction + rays.direction_x * x + rays.direction_y * y;
      set_ray(packet, static_cast<int>(i), rays.origin + rays.origin_x * x + rays.origin_y * y,
              direction[i], rays.near, rays.far);
    }
    set_valid(packet.ray, static_cast<int>(count), valid);
    TraceQuery query = traced->query();
    query.seeds = seeds;
    embree::intersect8_coherent(valid, traced->handle(), query.context, packet);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t pixel = pixels[i];
      const RTCHit8& h = packet.hit;
      const RayHit hit = {packet.ray.tfar[i], h.u[i],      h.v[i],
                          h.geomID[i],        h.primID[i], h.instID[0][i]};
      const V3f& along = direction[i];
      float depth = VisibleSurfaces::nothing;
      int object = -1;
      V3f normal(0.0f);
      if (hit.valid()) {
        depth = hit.distance;
        object = traced->instance_of(hit);
        normal = traced->outward_normal(object, V3f(h.Ng_x[i], h.Ng_y[i], h.Ng_z[i]));
        if (normal.dot(along) > 0.0f) {
          normal = -normal;
          if (culled(*traced->instances()[std::size_t(object)].material, false))
            look_past(hit, rays, V3f(packet.ray.org_x[i], packet.ray.org_y[i], packet.ray.org_z[i]),
                      along, depth, normal, object);
        }
        normal *= 1.0f / std::sqrt(std::max(normal.length2(), std::numeric_limits<float>::min()));
      }
      seen.depth[pixel] = depth;
      seen.object[pixel] = object;
      seen.normal[pixel] = pack_normal(normal);
    }
  }

  // The first surface behind a hit that the eye does not look through.
  void look_past(RayHit hit, const PictureRays& rays, const V3f& origin, const V3f& direction,
                 float& depth, V3f& normal, int& object) const {
    while (hit.valid()) {
      const SurfacePoint p = traced->surface(hit, origin, direction);
      if (!culled(p)) {
        depth = hit.distance;
        normal = p.geometric_normal;
        object = p.instance;
        return;
      }
      hit = traced->intersect(origin, direction, next_distance(hit.distance, p.error), rays.far, 0);
    }
    depth = VisibleSurfaces::nothing;
    object = -1;
  }

  RenderSettings settings;
  tbb::task_arena arena;
  // Made anew in place when the scene changes: what knows them by where they are need not know.
  std::optional<TracedScene> traced;
  std::optional<Lights> lights;
  std::vector<BoundingSphere> casters;
  std::vector<M44d> object_to_traced;  // of all instances
  IrradianceCache cache;
  std::optional<LightTracer> light_tracer;
  LivePhotons photons;
  bool photons_outdated = false;
  std::optional<CameraView> view, last_view;
  std::optional<PathTracer> tracer;  // of that view
  std::optional<CameraView> expected_view;
  std::optional<PathTracer> expected_tracer;  // of that view
  std::optional<CacheBuilder> builder;
  std::vector<Tile> tiles;
  int tiles_across = 0;
  int phase = 0;
  std::size_t level = 0;      // of slacks, that records are made for
  double error = 0.0;         // that records are made for
  int complete = 0;           // places in turn that lacked nothing
  bool completed = false;     // for the present error
  std::uint32_t settled = 0;  // records when last all were there and as good as they should be
  unsigned generation = 0;
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
  s.view.emplace(camera, *s.traced, width, height);
  if (!s.last_view) s.last_view = s.view;
  s.tracer.emplace(*s.traced, *s.lights, *s.view, s.settings);
  s.tiles.clear();
  s.tiles_across = (width + tile_side - 1) / tile_side;
  for (int y = 0; y < height; y += tile_side) {
    for (int x = 0; x < width; x += tile_side)
      s.tiles.push_back({x, y, std::min(tile_side, width - x), std::min(tile_side, height - y)});
  }
  if (s.cached() && !s.builder) {
    // It knows the tracer by where it is, which stays the same.
    s.builder.emplace(*s.tracer, *s.traced, s.settings, s.cache);
    s.error = s.settings.cache_error;
    s.photons_outdated = true;
  }
  if (s.builder && s.photons_outdated) {
    s.restart_photons();
    s.photons_outdated = false;
  }
}

void LiveTracer::expect_view(const Camera* camera) {
  State& s = *state_;
  s.expected_tracer.reset();
  s.expected_view.reset();
  if (!camera || !s.builder) return;
  s.expected_view.emplace(*camera, *s.traced, s.settings.width, s.settings.height);
  s.expected_tracer.emplace(*s.traced, *s.lights, *s.expected_view, s.settings);
}

bool LiveTracer::gather_photons(double seconds, PhotonDemand demand) {
  State& s = *state_;
  if (!s.builder) return false;
  const PhotonChange change = s.photons.gather(seconds, demand, s.arena, s.statistics);
  if (change == PhotonChange::none) return false;
  s.builder->set_photons(s.photons.in_use());
  if (change == PhotonChange::better) ++s.generation;
  return true;
}

void LiveTracer::update(const SceneChanges& changes) {
  State& s = *state_;
  const Scene& scene = s.traced->scene();
  const TracedScene::Frame frame = s.traced->frame();
  const auto bounds_of = [&](int i) { return s.traced->bounds()[static_cast<std::size_t>(i)]; };
  std::vector<MovedPart> parts;
  std::vector<M44d> before;
  for (const std::vector<int>* some : {&changes.moved, &changes.deformed}) {
    for (const int i : *some) {
      parts.push_back({i, std::nullopt, {bounds_of(i), Imath::Box3f()}});
      before.push_back(s.object_to_traced[static_cast<std::size_t>(i)]);
    }
  }
  s.photons.stop();
  s.expected_tracer.reset();
  s.light_tracer.reset();
  s.lights.reset();
  s.arena.execute([&] { s.traced.emplace(scene, s.arena.max_concurrency(), &frame); });
  s.lights.emplace(*s.traced);
  s.find_casters();
  s.keep_transforms();
  for (std::size_t k = 0; k < parts.size(); ++k) {
    MovedPart& part = parts[k];
    part.bounds[1] = bounds_of(part.instance);
    if (k < changes.moved.size() && !part.bounds[1].isEmpty()) {
      part.motion = Imath::M44f(before[k].inverse() *
                                s.object_to_traced[static_cast<std::size_t>(part.instance)]);
    }
  }
  if (s.builder) s.builder->change(parts);
  s.photons_outdated = true;
  ++s.generation;
}

void LiveTracer::see(VisibleSurfaces& seen) {
  State& s = *state_;
  const int width = s.settings.width, height = s.settings.height;
  seen.resize(std::size_t(width) * std::size_t(height));
  const PictureRays rays = s.view->rays();
  s.arena.execute([&] {
    for_each(std::size_t((height + block_height - 1) / block_height), [&](std::size_t row) {
      const int top = static_cast<int>(row) * block_height;
      for (int left = 0; left < width; left += block_width) {
        std::array<std::uint32_t, packet_size> pixels;
        std::size_t count = 0;
        for (int y = top; y < std::min(top + block_height, height); ++y) {
          for (int x = left; x < std::min(left + block_width, width); ++x)
            pixels[count++] = static_cast<std::uint32_t>(y * width + x);
        }
        s.see_packet(rays, pixels.data(), count, seen);
      }
    });
  });
  s.statistics.rays_camera += seen.size();
}

void LiveTracer::see(const std::vector<std::uint32_t>& pixels, VisibleSurfaces& seen) {
  State& s = *state_;
  const PictureRays rays = s.view->rays();
  s.arena.execute([&] {
    for_each((pixels.size() + chunk_size - 1) / chunk_size, [&](std::size_t chunk) {
      const std::size_t end = std::min(pixels.size(), (chunk + 1) * chunk_size);
      for (std::size_t i = chunk * chunk_size; i < end; i += packet_size)
        s.see_packet(rays, pixels.data() + i, std::min(std::size_t{packet_size}, end - i), seen);
    });
  });
  s.statistics.rays_camera += pixels.size();
}

V3d LiveTracer::pivot(const VisibleSurfaces& seen) const {
  const int x = state_->settings.width / 2, y = state_->settings.height / 2;
  const std::size_t pixel = std::size_t(y) * std::size_t(state_->settings.width) + std::size_t(x);
  if (seen.object[pixel] < 0) return origin();
  return origin() +
         V3d(state_->view->rays().point(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                                        seen.depth[pixel]));
}

float LiveTracer::curvature(int instance) const {
  const TracedInstance& i = state_->traced->instances()[static_cast<std::size_t>(instance)];
  if (i.sphere >= 0) {
    const TracedSphere& s = state_->traced->spheres()[static_cast<std::size_t>(i.sphere)];
    const bool inside = (s.center - state_->view->plane().eye).length() < s.radius;
    return (inside ? -1.0f : 1.0f) / s.radius;
  }
  return i.mesh && i.flat_shaded ? 0.0f : std::numeric_limits<float>::quiet_NaN();
}

const CameraView& LiveTracer::view(int views_ago) const {
  return views_ago == 0 ? *state_->view : *state_->last_view;
}

void LiveTracer::trace(const std::vector<LiveRequest>& requests, bool centered,
                       std::vector<LiveSample>& samples) {
  State& s = *state_;
  // Neighbours together.
  const auto width = static_cast<std::uint32_t>(s.settings.width);
  const auto tile_of = [&](const LiveRequest& r) {
    return (r.pixel / width / tile_side) * std::size_t(s.tiles_across) +
           r.pixel % width / tile_side;
  };
  std::vector<std::size_t> next(s.tiles.size() + 1, 0);
  for (const LiveRequest& r : requests) ++next[tile_of(r) + 1];
  for (std::size_t i = 0; i < s.tiles.size(); ++i) next[i + 1] += next[i];
  std::vector<LiveRequest> wanted(requests.size());
  for (const LiveRequest& r : requests) wanted[next[tile_of(r)]++] = r;
  samples.resize(requests.size());
  const CacheUse use = s.use();
  s.arena.execute([&] {
    const Tile picture = {0, 0, s.settings.width, s.settings.height};
    for_each((wanted.size() + chunk_size - 1) / chunk_size, [&](std::size_t chunk) {
      const std::size_t first = chunk * chunk_size;
      const std::size_t count = std::min(chunk_size, wanted.size() - first);
      std::vector<PixelSums> sums(count);
      std::vector<SampleRange> ranges(count);
      for (std::size_t i = 0; i < count; ++i) {
        const LiveRequest& r = wanted[first + i];
        ranges[i] = {r.pixel, r.sample, r.count, static_cast<std::uint32_t>(i), centered};
      }
      RenderStatistics counts;
      s.tracer->render_ranges(picture, ranges, sums, counts, use);
      for (std::size_t i = 0; i < count; ++i) {
        LiveSample& sample = samples[first + i];
        sample = {sums[i].terms, ranges[i].pixel, ranges[i].count, sums[i].mirrored};
        for (Color& term : sample.terms) term *= 1.0f / static_cast<float>(sample.count);
      }
      const std::lock_guard lock(s.mutex);
      s.statistics.add_counts(counts);
    });
  });
}

bool LiveTracer::improve(double seconds, double refining_seconds, bool resting) {
  State& s = *state_;
  if (!s.builder) return true;
  const Clock::time_point start = Clock::now();
  const auto passed = [&] { return seconds_since(start); };
  const auto go_on = [&] { return passed() < seconds; };
  if (!resting) s.set_error(s.settings.cache_error);
  bool all = true;
  while (true) {
    s.phase = (s.phase + phase_step) % (record_stride * record_stride);
    const std::uint32_t before = s.cache.size();
    s.arena.execute([&] {
      all = s.builder->extend(*s.tracer, s.tiles, record_stride, s.phase, slacks[s.level], go_on,
                              s.statistics);
    });
    const std::uint32_t made = s.cache.size() - before;
    s.complete = all && made == 0 ? s.complete + 1 : 0;
    if (!all) break;
    if (s.level + 1 < slacks.size()) {
      // What the eye comes to see later is made at the finest level at once.
      if (made > before / 32) continue;
      ++s.level;
      ++s.generation;
    } else if (!resting || passed() > share_of_looking * seconds ||
               s.complete >= places_to_sharpen) {
      break;
    }
  }
  if (all && s.expected_tracer && go_on()) {
    s.arena.execute([&] {
      s.builder->extend(*s.expected_tracer, s.tiles, record_stride, s.phase, slacks[s.level], go_on,
                        s.statistics);
    });
  }
  if (all && s.level + 1 == slacks.size()) {
    const double end = std::min(seconds, passed() + refining_seconds);
    s.arena.execute([&] { all = s.builder->refine([&] { return passed() < end; }, s.statistics); });
  }
  const bool finer = s.error < s.settings.cache_error;
  if (all && !finer && s.cache.size() > s.settled + s.settled / 16) {
    s.settled = s.cache.size();
    ++s.generation;
  }
  if (all && resting && s.complete >= places_to_sharpen) {
    if (finer && !s.completed) ++s.generation;
    s.completed = true;
    if (s.error > least_error_share * s.settings.cache_error)
      s.set_error(resting_error_step * s.error);
  }
  s.statistics.records = s.cache.size();
  s.statistics.cache_bytes = s.cache.bytes() + s.photons.bytes();
  return all;
}

std::optional<IncidentLight> LiveTracer::incident_light(int x, int y) const {
  State& s = *state_;
  const PictureRays rays = s.view->rays();
  const float px = static_cast<float>(x) + 0.5f, py = static_cast<float>(y) + 0.5f;
  const V3f origin = rays.origin + rays.origin_x * px + rays.origin_y * py;
  const V3f direction =
      (rays.direction + rays.direction_x * px + rays.direction_y * py).normalized();
  float near = 0.0f;
  for (;;) {
    const RayHit hit =
        s.traced->intersect(origin, direction, near, std::numeric_limits<float>::infinity(), 0);
    if (!hit.valid()) return std::nullopt;
    const SurfacePoint point = s.traced->surface(hit, origin, direction);
    if (culled(point)) {
      near = next_distance(hit.distance, point.error);
      continue;
    }
    std::optional<IncidentLight> light;
    s.arena.execute([&] {
      light = lumivec::incident_light(*s.tracer, point, s.use(), s.view->footprint(hit.distance));
    });
    return light;
  }
}

std::vector<RecordMark> LiveTracer::records() const {
  const State& s = *state_;
  std::vector<RecordMark> marks;
  if (!s.builder || !s.view) return marks;
  const float scale = std::sqrt(std::sqrt(s.builder->use().budget));
  const V3f eye = s.view->plane().eye;
  const std::uint32_t count = s.cache.size();
  marks.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const IrradianceRecord& r = s.cache.record(i);
    const float least = s.cache.least_half_axis(r, s.view->footprint((r.position - eye).length()));
    const V3f other = r.normal.cross(r.axis);
    RecordMark mark;
    mark.position = origin() + V3d(r.position);
    mark.normal = V3d(r.normal);
    mark.half_axis = {V3d(r.axis * std::max(least, scale * r.radius_small)),
                      V3d(other * std::max(least, scale * r.radius_large))};
    mark.limit = scale * r.radius_small < least ? RadiusLimit::pixel : r.limit;
    mark.noise = std::sqrt(std::max(0.0f, r.variance));
    mark.provisional = r.passes == 0;
    marks.push_back(mark);
  }
  return marks;
}

unsigned LiveTracer::generation() const {
  return state_->generation;
}

const V3d& LiveTracer::origin() const {
  return state_->traced->origin();
}

CacheSize LiveTracer::record_cache() const {
  return {state_->cache.size(), state_->cache.bytes()};
}

CacheSize LiveTracer::photon_map() const {
  return {state_->photons.size(), state_->photons.bytes()};
}

const RenderStatistics& LiveTracer::statistics() const {
  return state_->statistics;
}

}  // namespace lumivec
