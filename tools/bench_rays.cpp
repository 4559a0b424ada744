// How near the path tracer is to the machine's limit: its rays a second against those of bare loops
// over rtcIntersect1 and rtcOccluded1 on the same scene, in turn within one run, and what a second
// thread adds.
//
// The bare loops trace rays like the path tracer's: through the pixels, scattered by the cosine
// over a few bounces, and toward points on the lights. Their rates are combined by the numbers of
// each kind that the path tracer traced.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "integrator/camera_view.h"
#include "integrator/denormals.h"
#include "integrator/lights.h"
#include "integrator/render.h"
#include "integrator/sampling.h"
#include "integrator/sobol.h"
#include "loader/load_scene.h"
#include "tools/bench_program.h"
#include "tools/procedural_scenes.h"

namespace lumivec {
namespace {

constexpr int bounces = 3;

struct Ray {
  V3f origin{0.0f}, direction{0.0f};
  float far = 0.0f;
};

struct RaySet {
  std::vector<Ray> camera, scatter, shadow;
};

RTCRay embree_ray(const Ray& r) {
  RTCRay ray;
  ray.org_x = r.origin.x;
  ray.org_y = r.origin.y;
  ray.org_z = r.origin.z;
  ray.dir_x = r.direction.x;
  ray.dir_y = r.direction.y;
  ray.dir_z = r.direction.z;
  ray.tnear = 0.0f;
  ray.tfar = r.far;
  ray.time = 0.0f;
  ray.mask = ~0u;
  ray.id = 0;
  ray.flags = 0;
  return ray;
}

RayHit trace(const TracedScene& scene, const Ray& r) {
  RTCRayHit ray;
  ray.ray = embree_ray(r);
  ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  TraceQuery query = scene.query();
  embree::intersect1(scene.handle(), query.context, ray);
  return {ray.ray.tfar, ray.hit.u, ray.hit.v, ray.hit.geomID, ray.hit.primID, ray.hit.instID[0]};
}

// The rays of one path a pixel.
RaySet make_rays(const TracedScene& scene, const Lights& lights, const Camera& camera, int size) {
  const CameraView view(camera, scene, size, size);
  RaySet rays;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const std::uint32_t seed =
          hash_combine(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      const CameraRay first = view.ray(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      Ray ray = {first.origin, first.direction, std::numeric_limits<float>::infinity()};
      rays.camera.push_back(ray);
      for (std::uint32_t bounce = 0; bounce < bounces; ++bounce) {
        const RayHit hit = trace(scene, ray);
        if (!hit.valid()) break;
        const SurfacePoint point = scene.surface(hit, ray.origin, ray.direction);
        const std::array<float, 4> u = sobol_point(bounce, seed),
                                   v = sobol_point(bounce, mix_bits(seed));
        LightSample light;
        if (lights.sample(point.position, point.geometric_normal, u[0], V2f(u[1], u[2]), light) &&
            light.direction.dot(point.geometric_normal) > 0.0f) {
          const V3f origin = offset_origin(point, light.direction);
          rays.shadow.push_back({origin, light.target - origin, 1.0f});
        }
        const V3f direction =
            make_frame(point.normal).to_world(sample_cosine_hemisphere(V2f(v[0], v[1])));
        ray = {offset_origin(point, direction), direction, std::numeric_limits<float>::infinity()};
        rays.scatter.push_back(ray);
      }
    }
  }
  return rays;
}

double seconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Keeps the compiler from leaving out a loop whose result is not used.
volatile float sink;

double intersect_rate(const TracedScene& scene, const std::vector<Ray>& rays) {
  float sum = 0.0f;
  const double time = seconds([&] {
    TraceQuery query = scene.query();
    for (const Ray& r : rays) {
      RTCRayHit ray;
      ray.ray = embree_ray(r);
      ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      embree::intersect1(scene.handle(), query.context, ray);
      sum += ray.hit.u;
    }
  });
  sink = sum;
  return static_cast<double>(rays.size()) / time;
}

double occluded_rate(const TracedScene& scene, const std::vector<Ray>& rays) {
  float sum = 0.0f;
  const double time = seconds([&] {
    TraceQuery query = scene.query();
    for (const Ray& r : rays) {
      RTCRay ray = embree_ray(r);
      embree::occluded1(scene.handle(), query.context, ray);
      sum += ray.tfar < 0.0f ? 1.0f : 0.0f;
    }
  });
  sink = sum;
  return static_cast<double>(rays.size()) / time;
}

double ray_count(const RenderStatistics& s) {
  return static_cast<double>(s.rays_camera + s.rays_scatter + s.rays_shadow);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct Figures {
  std::vector<double> camera, scatter, shadow;  // bare loops, rays a second
  std::vector<double> bare, path;  // rays a second, one thread, the path tracer's mixture
  std::vector<double> share;       // path / bare, round by round
  std::vector<double> speedup;     // of two threads over one
};

Figures measure(const Scene& scene, int size, int samples, int rounds) {
  const FlushDenormals flush;
  const TracedScene traced(scene, 0);
  const Lights lights(traced);
  const RaySet rays = make_rays(traced, lights, scene.cameras[0], size);
  RenderSettings settings;
  settings.width = settings.height = size;
  settings.samples = samples;
  Figures f;
  for (int round = 0; round < rounds; ++round) {
    f.camera.push_back(intersect_rate(traced, rays.camera));
    f.scatter.push_back(rays.scatter.empty() ? 1.0 : intersect_rate(traced, rays.scatter));
    f.shadow.push_back(rays.shadow.empty() ? 1.0 : occluded_rate(traced, rays.shadow));
    RenderStatistics one, two;
    settings.threads = 1;
    render(scene, scene.cameras[0], settings, one);
    settings.threads = 2;
    render(scene, scene.cameras[0], settings, two);
    const double bare_time = static_cast<double>(one.rays_camera) / f.camera.back() +
                             static_cast<double>(one.rays_scatter) / f.scatter.back() +
                             static_cast<double>(one.rays_shadow) / f.shadow.back();
    f.bare.push_back(ray_count(one) / bare_time);
    f.path.push_back(ray_count(one) / one.seconds_sample);
    f.share.push_back(f.path.back() / f.bare.back());
    f.speedup.push_back(one.seconds_sample / two.seconds_sample);
  }
  return f;
}

int run(int argc, char** argv) {
  CLI::App app(
      "Rays a second of the path tracer against bare Embree loops, on three scenes or on the given "
      "ones.");
  std::vector<std::string> files;
  std::string json_file;
  int size = 512, samples = 4, rounds = 5;
  app.add_option("SCENE", files,
                 "glTF scenes; default: the shipped Cornell Box, a Sphere Flake of depth 5, a mesh "
                 "of a million triangles");
  add_json_option(app, json_file);
  app.add_option("--size", size, "pixels on a side")
      ->capture_default_str()
      ->check(CLI::Range(16, 4096));
  app.add_option("--spp", samples, "samples a pixel")
      ->capture_default_str()
      ->check(CLI::Range(1, 4096));
  app.add_option("--rounds", rounds, "repetitions; medians are shown")
      ->capture_default_str()
      ->check(CLI::Range(1, 100));
  CLI11_PARSE(app, argc, argv);

  std::vector<std::pair<std::string, std::function<Scene()>>> scenes;
  const auto from_file = [](const std::string& file) {
    return [file] {
      LoadReport report;
      return load_scene(file, LoadOptions(), report);
    };
  };
  for (const std::string& file : files) scenes.emplace_back(file, from_file(file));
  if (files.empty()) {
    scenes.emplace_back("cornell_box_1", from_file(LUMIVEC_SCENES "/cornell_box_1.gltf"));
    scenes.emplace_back("sphere flake, depth 5", [] { return sphere_flake_scene(5); });
    scenes.emplace_back("mesh, 1 M triangles", [] { return bumpy_ball_scene(1'000'000); });
  }
  std::printf(
      "million rays/s, one thread       bare loops                path tracer          two "
      "threads\n");
  std::printf("%-24s %8s %8s %8s %8s %8s %9s %9s\n", "scene", "camera", "scatter", "shadow",
              "mixture", "path", "path/bare", "over one");
  nlohmann::json all = nlohmann::json::array();
  for (const auto& [name, make] : scenes) {
    const Scene scene = make();
    const Figures f = measure(scene, size, samples, rounds);
    std::printf("%-24s %8.2f %8.2f %8.2f %8.2f %8.2f %9.2f %9.2f\n", name.c_str(),
                median(f.camera) / 1e6, median(f.scatter) / 1e6, median(f.shadow) / 1e6,
                median(f.bare) / 1e6, median(f.path) / 1e6, median(f.share), median(f.speedup));
    std::fflush(stdout);
    all.push_back({{"scene", name},
                   {"camera", f.camera},
                   {"scatter", f.scatter},
                   {"shadow", f.shadow},
                   {"bare", f.bare},
                   {"path", f.path},
                   {"path_over_bare", f.share},
                   {"two_threads_over_one", f.speedup}});
  }
  write_json(json_file,
             {{"size", size}, {"samples", samples}, {"rounds", rounds}, {"scenes", all}});
  return 0;
}

}  // namespace
}  // namespace lumivec

int main(int argc, char** argv) {
  return lumivec::run_benchmark("bench_rays", argc, argv, lumivec::run);
}
