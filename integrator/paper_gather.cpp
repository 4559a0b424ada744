#include "integrator/paper_gather.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "integrator/bsdf_color.h"
#include "integrator/frame.h"
#include "integrator/sampling.h"
#include "integrator/sobol.h"

namespace lumivec {
namespace {

// Where nothing is hit, a record holds as far as this many radii of the scene.
constexpr float far_away = 50.0f;

// Cells of equal solid angles, about as wide as high.
struct Cells {
  int rings = 1, sectors = 1;  // M and N

  explicit Cells(int samples)
      : rings(std::max(1, static_cast<int>(std::lround(std::sqrt(float(samples) / pi))))),
        sectors(std::max(1, samples / rings)) {}

  V3f direction(int ring, int sector, const std::array<float, 4>& u) const {
    const float cosine = (static_cast<float>(ring) + u[0]) / static_cast<float>(rings);
    const float turn = (static_cast<float>(sector) + u[1]) / static_cast<float>(sectors);
    const V2f azimuth = unit_circle(turn >= 1.0f ? 0.0f : turn);
    const float sine = std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
    return {azimuth.x * sine, azimuth.y * sine, cosine};
  }
};

}  // namespace

PaperRecord make_paper_record(const PathTracer& tracer, const TracedScene& scene,
                              const PaperPoint& point, const Bsdf& bsdf, int samples,
                              std::uint32_t seed, RenderStatistics& statistics,
                              const CacheUse& ends) {
  thread_local std::vector<GatherRay> rays;
  thread_local std::vector<GatherResult> results;
  const CachePoint& place = point.place;
  const Frame frame = make_frame(place.normal);
  const Cells cells(samples);
  rays.clear();
  const V3f origin = place.position + place.geometric_normal * place.error;
  for (int j = 0; j < cells.rings; ++j) {
    for (int k = 0; k < cells.sectors; ++k) {
      const auto cell = static_cast<std::uint32_t>(j * cells.sectors + k);
      const V3f direction =
          frame.to_world(cells.direction(j, k, sobol_point(cell, seed))).normalized();
      // An interpolated normal looks below the surface itself; there is no light.
      if (direction.dot(place.geometric_normal) <= 0.0f) continue;
      rays.push_back({origin, direction, cell});
    }
  }
  tracer.gather(rays, point.media, seed, results, statistics, ends);

  const float share = 2.0f * pi / static_cast<float>(cells.rings * cells.sectors);
  const std::uint32_t kinds = paper_kinds(bsdf, point.surface);
  const auto f_cos = [&](const V3f& wi) { return paper_f_cos(bsdf, kinds, wi); };
  LightIntegrals light;
  double irradiance = 0.0, distances = 0.0;
  V3d gradient(0.0);
  int hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const V3f& w = rays[i].direction;
    const Color arriving = results[i].radiance * share;
    light.add(w, arriving, f_cos(w));
    const double cosine = w.dot(place.normal), brightness = mean(arriving);
    irradiance += brightness * cosine;
    if (!std::isfinite(results[i].distance) || !(results[i].distance > 0.0f)) continue;
    // What is seen stays in place as the point moves: ∇ cosθ = (cosθ ω − n) / r.
    gradient += (V3d(w) * cosine - V3d(place.normal)) * (brightness / results[i].distance);
    distances += results[i].distance;
    ++hits;
  }
  PaperRecord record;
  record.position = place.position;
  record.normal = place.normal;
  record.view = point.view;
  record.light = make_light_vector(light, bsdf.normal(), f_cos);
  if (record.light.form == LightVectorForm::radiance) {
    record.light.magnitude /= paper_base_color(point.surface.base_color);
  }
  record.mean_distance =
      hits > 0 ? static_cast<float>(distances / hits) : far_away * scene.radius();
  const double variation = irradiance > 0.0 ? gradient.length() / irradiance : 0.0;
  record.relative_variation =
      static_cast<float>(std::min(variation, double(std::numeric_limits<float>::max())));
  return record;
}

}  // namespace lumivec
