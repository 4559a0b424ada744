#include "integrator/hemisphere_gather.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <vector>

#include "integrator/bsdf_color.h"
#include "integrator/form_factor_derivatives.h"
#include "integrator/frame.h"
#include "integrator/sampling.h"
#include "integrator/sobol.h"

namespace lumivec {
namespace {

// Where nothing is hit, light comes from this many radii of the scene away.
constexpr float far_away = 50.0f;
// No ellipse is longer than this many times its width, or than this share of the mean distance to
// what the point sees: derivatives know nothing of what is further off.
constexpr float most_elongated = 3.0f;
constexpr float longest_share = 1.0f;
constexpr float dark_share = 0.1f;
// Where the light changes by this share of itself, linear extrapolation ends.
constexpr float most_change = 1.0f;
// Paths through the rings below this share of them, less steep than two to one, say what stands
// close by: a wall is met above its foot.
constexpr float steep_share = 0.2f;

}  // namespace

// What one hemisphere of paths brought.
struct HemisphereGather::Hemisphere {
  explicit Hemisphere(const HemisphereCells& c)
      : rings(c.rings), sectors(c.sectors), cells(c.count()) {
    assert(cells <= max_cells && sectors % static_cast<int>(IrradianceRecord::sector_count) == 0);
  }

  const int rings, sectors, cells;
  LightSum light;
  std::array<V2f, 3> gradient = {V2f(0.0f), V2f(0.0f), V2f(0.0f)};
  std::array<float, 3> curvature{};
  std::array<float, IrradianceRecord::sector_count> clearance{};
  float mean_distance = 0.0f;
  float variance = 0.0f;

  // Cells in rings from the pole down, each ring from azimuth −π on.
  static constexpr int max_cells = most_cells.count();
  std::array<Color, max_cells> radiance;
  std::array<float, max_cells> distance;
  std::array<V3f, max_cells> direction;  // in the axes of the frame

  void trace(const PathTracer& tracer, const TracedScene& scene, const RecordRequest& request,
             const Frame& frame, std::uint32_t seed, RenderStatistics& statistics,
             const CacheUse& cache, Term term);
  void sum(const Frame& frame);
  void differentiate();
};

void HemisphereGather::Hemisphere::trace(const PathTracer& tracer, const TracedScene& scene,
                                         const RecordRequest& request, const Frame& frame,
                                         std::uint32_t seed, RenderStatistics& statistics,
                                         const CacheUse& cache, Term term) {
  thread_local std::vector<GatherRay> rays;
  thread_local std::vector<GatherResult> results;
  rays.clear();
  std::array<int, max_cells> ray_of;
  for (int j = 0; j < rings; ++j) {
    for (int k = 0; k < sectors; ++k) {
      const int cell = j * sectors + k;
      const std::array<float, 4> u = sobol_point(static_cast<std::uint32_t>(cell), seed);
      const float sine2 = (static_cast<float>(j) + u[0]) / static_cast<float>(rings);
      const float turn = (static_cast<float>(k) + u[1]) / static_cast<float>(sectors);
      const V2f azimuth = unit_circle(turn >= 1.0f ? 0.0f : turn);
      const float sine = std::sqrt(sine2), cosine = std::sqrt(std::max(0.0f, 1.0f - sine2));
      // Azimuth −π first, as clearance counts its sectors.
      const V3f local(-azimuth.x * sine, -azimuth.y * sine, cosine);
      const V3f world = frame.to_world(local);
      const auto i = static_cast<std::size_t>(cell);
      direction[i] = local;
      radiance[i] = Color(0.0f);
      distance[i] = 0.0f;
      ray_of[i] = -1;
      // An interpolated normal looks below the surface itself; there is no light.
      if (world.dot(request.point.geometric_normal) <= 0.0f) continue;
      ray_of[i] = static_cast<int>(rays.size());
      const V3f origin =
          request.point.position + request.point.geometric_normal * request.point.error;
      rays.push_back({origin, world, static_cast<std::uint32_t>(cell)});
    }
  }
  tracer.gather(rays, request.media, seed, results, statistics, cache, term);
  const float most = far_away * scene.radius();
  for (std::size_t i = 0; i < std::size_t(cells); ++i) {
    distance[i] = most;
    if (ray_of[i] < 0) continue;
    const GatherResult& result = results[static_cast<std::size_t>(ray_of[i])];
    radiance[i] = result.radiance;
    distance[i] = std::min(result.distance, most);
  }
}

void HemisphereGather::Hemisphere::sum(const Frame& frame) {
  // Cosine-weighted cells: ∫ L ω dω = π / n Σ L ω / cosθ.
  const float share = pi / static_cast<float>(cells);
  // Near the horizon 1 / cosθ is large, and so is the noise it brings into the parts of the vector
  // along the surface; the lowest cells take the mean of 1 / cosθ over their ring instead.
  LightSum all;
  double inverse_distance = 0.0;
  std::array<double, most_cells.rings> ring_sum{}, ring_squares{};
  for (int j = 0; j < rings; ++j) {
    const float high = std::sqrt(1.0f - static_cast<float>(j) / static_cast<float>(rings));
    const float low = std::sqrt(1.0f - static_cast<float>(j + 1) / static_cast<float>(rings));
    const float mean_inverse = 2.0f / (high + low);  // ∫ 1/cosθ d(sin²θ) over the ring
    for (int k = 0; k < sectors; ++k) {
      const auto i = static_cast<std::size_t>(j * sectors + k);
      const V3f& d = direction[i];
      const float scale = share * mean_inverse;
      // The part along the normal is exact: it is the irradiance.
      const V3f weighted(d.x * scale, d.y * scale, share);
      all.flux += radiance[i] * scale;
      for (std::size_t c = 0; c < 3; ++c) {
        all.vector[c] += radiance[i][static_cast<int>(c)] * weighted;
      }
      inverse_distance += 1.0 / distance[i];
      const double l = mean(radiance[i]);
      ring_sum[std::size_t(j)] += l;
      // Neighbours differ by their noise, mostly.
      const auto next = static_cast<std::size_t>(j * sectors + (k + 1) % sectors);
      const double difference = l - mean(radiance[next]);
      ring_squares[std::size_t(j)] += 0.5 * difference * difference;
    }
  }
  for (std::size_t c = 0; c < 3; ++c) light.vector[c] = frame.to_world(all.vector[c]);
  light.flux = all.flux;
  mean_distance = static_cast<float>(cells / inverse_distance);
  double total = 0.0, squares = 0.0;
  for (std::size_t j = 0; j < std::size_t(rings); ++j) {
    total += ring_sum[j];
    squares += ring_squares[j];
  }
  variance = total > 0.0 ? static_cast<float>(squares / (total * total)) : 1.0f;
  const int first_flat_ring = static_cast<int>(steep_share * static_cast<float>(rings));
  for (std::size_t s = 0; s < clearance.size(); ++s) {
    clearance[s] = far_away * mean_distance;
    const int width = sectors / static_cast<int>(IrradianceRecord::sector_count);
    for (int j = first_flat_ring; j < rings; ++j) {
      for (int k = -1; k <= width; ++k) {
        const int column = (static_cast<int>(s) * width + k + sectors) % sectors;
        const auto i = static_cast<std::size_t>(j * sectors + column);
        const float along = distance[i] * std::hypot(direction[i].x, direction[i].y);
        clearance[s] = std::min(clearance[s], along);
      }
    }
  }
}

// Triangles between neighbouring cells' hits, and a ring on the horizon below the lowest.
void HemisphereGather::Hemisphere::differentiate() {
  const int loops = rings + 1;
  constexpr auto most_vertices = std::size_t((most_cells.rings + 1) * most_cells.sectors);
  std::array<V3d, most_vertices> vertex;
  std::array<Color, most_vertices> light_at;
  std::array<double, most_vertices> far;
  for (int j = 0; j < loops; ++j) {
    for (int k = 0; k < sectors; ++k) {
      const auto to = static_cast<std::size_t>(j * sectors + k);
      const auto from = static_cast<std::size_t>(std::min(j, rings - 1) * sectors + k);
      V3d p = V3d(direction[from]) * double(distance[from]);
      if (j == rings) {
        const double flat = std::hypot(p.x, p.y);
        const double scale = flat > 0.0 ? double(distance[from]) / flat : 0.0;
        p = V3d(p.x * scale, p.y * scale, 0.0);
      }
      vertex[to] = p;
      light_at[to] = radiance[from];
      far[to] = distance[from];
    }
  }
  // Of a triangle: that of its corners, of far ones above all, which near ones cover.
  const auto triangle_light = [&](std::size_t a, std::size_t b, std::size_t c) {
    const auto weight = [&](std::size_t i) {
      const double d2 = far[i] * far[i];
      return d2 * d2;
    };
    const double wa = weight(a), wb = weight(b), wc = weight(c), sum = wa + wb + wc;
    if (!(sum > 0.0) || !std::isfinite(sum)) return light_at[a];
    return light_at[a] * float(wa / sum) + light_at[b] * float(wb / sum) +
           light_at[c] * float(wc / sum);
  };
  PlaneDerivatives mean_light;
  std::array<Imath::V2d, 3> gradients = {Imath::V2d(0.0), Imath::V2d(0.0), Imath::V2d(0.0)};
  const auto add_edge = [&](std::size_t a, std::size_t b, const Color& left, const Color& right) {
    const Color step = left - right;
    const double brightness = mean(step);
    if (step == Color(0.0f)) return;
    const PlaneDerivatives d = edge_form_factor(vertex[a], vertex[b]);
    mean_light.hxx += brightness * d.hxx;
    mean_light.hxy += brightness * d.hxy;
    mean_light.hyy += brightness * d.hyy;
    for (int c = 0; c < 3; ++c) {
      gradients[std::size_t(c)] += Imath::V2d(d.gx, d.gy) * double(step[c]);
    }
  };
  const auto at = [this](int j, int k) {
    return static_cast<std::size_t>(j * sectors + (k + sectors) % sectors);
  };
  // Each cell between loops j and j + 1 has an upper triangle (its edge on loop j) and a lower one.
  const auto upper = [&](int j, int k) {
    return triangle_light(at(j, k), at(j + 1, k + 1), at(j, k + 1));
  };
  const auto lower = [&](int j, int k) {
    return triangle_light(at(j, k), at(j + 1, k), at(j + 1, k + 1));
  };
  Color pole(0.0f);
  for (int k = 0; k < sectors; ++k) pole += light_at[at(0, k)] * (1.0f / float(sectors));
  std::array<Color, most_cells.sectors> above;
  above.fill(pole);
  for (int j = 0; j < rings; ++j) {
    std::array<Color, most_cells.sectors> up, low;
    for (int k = 0; k < sectors; ++k) {
      up[std::size_t(k)] = upper(j, k);
      low[std::size_t(k)] = lower(j, k);
    }
    for (int k = 0; k < sectors; ++k) {
      const auto s = static_cast<std::size_t>(k);
      const auto next = static_cast<std::size_t>((k + 1) % sectors);
      // Along the loop, counter-clockwise around the pole: what is above is on the left.
      add_edge(at(j, k), at(j, k + 1), above[s], up[s]);
      // The diagonal, down and forward: the upper triangle is on the left.
      add_edge(at(j, k), at(j + 1, k + 1), up[s], low[s]);
      // Down at k + 1: the next cell's lower triangle is on the left.
      add_edge(at(j, k + 1), at(j + 1, k + 1), low[next], up[s]);
    }
    above = low;
  }
  for (int k = 0; k < sectors; ++k) {
    add_edge(at(rings, k), at(rings, k + 1), above[std::size_t(k)], Color(0.0f));
  }
  for (std::size_t c = 0; c < 3; ++c) {
    gradient[c] = V2f(float(gradients[c].x), float(gradients[c].y));
  }
  curvature = {float(mean_light.hxx), float(mean_light.hxy), float(mean_light.hyy)};
}

HemisphereGather::HemisphereGather(const PathTracer& tracer, const TracedScene& scene,
                                   const ValidityParts& parts, float budget, Term term)
    : tracer_(tracer),
      scene_(scene),
      parts_(parts),
      scale_(std::sqrt(std::sqrt(budget))),
      term_(term) {}

// Half axes for a budget of 1; see IrradianceCache.
void HemisphereGather::set_radii(IrradianceRecord& r) const {
  const Color irradiance = r.light.irradiance(r.normal);
  const float brightness = mean(irradiance);
  float longest = longest_share * r.mean_distance;
  RadiusLimit longest_limit = RadiusLimit::distance;
  if (parts_.gradient && brightness > 0.0f) {
    V2f slope(0.0f);
    for (const V2f& g : r.gradient) slope += g * (1.0f / 3.0f);
    const float length = slope.length();
    if (length * longest > most_change * brightness) {
      longest = most_change * brightness / length;
      longest_limit = RadiusLimit::gradient;
    }
  }
  // A hemisphere that met no light says nothing of the light's changes.
  if (brightness <= 0.0f) {
    longest *= dark_share;
    longest_limit = RadiusLimit::darkness;
  }
  longest /= scale_;
  const auto radius = [&](double curvature) {
    const double r4 = 4.0 * brightness / (double(pi) * curvature);
    return r4 > 0.0 && std::isfinite(r4) ? static_cast<float>(std::sqrt(std::sqrt(r4))) : longest;
  };
  const Frame frame = make_frame(r.normal);
  r.axis = frame.t;
  if (!parts_.hessian) {
    // As if the light changed its curvature over the distance to what is seen.
    r.radius_small = r.radius_large =
        std::min(longest, radius(brightness / (double(r.mean_distance) * r.mean_distance)));
    r.limit = r.radius_small < longest ? RadiusLimit::curvature : longest_limit;
    return;
  }
  PlaneDerivatives d;
  d.hxx = r.curvature[0];
  d.hxy = r.curvature[1];
  d.hyy = r.curvature[2];
  const Curvature k = principal_curvature(d);
  r.axis = frame.t * float(k.axis_x) + frame.b * float(k.axis_y);
  r.radius_small = std::min(longest, radius(k.large));
  r.radius_large = std::min({longest, radius(k.small), most_elongated * r.radius_small});
  r.limit = r.radius_small < longest ? RadiusLimit::curvature : longest_limit;
}

IrradianceRecord HemisphereGather::make(const RecordRequest& request, const HemisphereCells& cells,
                                        std::uint32_t seed, RenderStatistics& statistics,
                                        const CacheUse& cache) const {
  IrradianceRecord record;
  record.position = request.point.position;
  record.normal = request.point.normal;
  refine(record, request, cells, seed, statistics, cache);
  return record;
}

void HemisphereGather::refine(IrradianceRecord& r, const RecordRequest& request,
                              const HemisphereCells& cells, std::uint32_t seed,
                              RenderStatistics& statistics, const CacheUse& cache) const {
  const Frame frame = make_frame(r.normal);
  Hemisphere h(cells);
  h.trace(tracer_, scene_, request, frame, hash_combine(seed, r.passes), statistics, cache, term_);
  h.sum(frame);
  h.differentiate();
  const float share = 1.0f / static_cast<float>(r.passes + 1);
  const float brightness_before = r.passes > 0 ? mean(r.light.irradiance(r.normal)) : 0.0f;
  const float brightness_here = mean(h.light.irradiance(r.normal));
  const auto blend = [share](auto& old, const auto& fresh) {
    old = old * (1.0f - share) + fresh * share;
  };
  for (std::size_t c = 0; c < 3; ++c) {
    blend(r.light.vector[c], h.light.vector[c]);
    blend(r.gradient[c], h.gradient[c]);
    blend(r.curvature[c], h.curvature[c]);
  }
  blend(r.light.flux, h.light.flux);
  // Relative to the mean of all hemispheres: beside its own, one that met something bright by
  // chance would not look noisy.
  const auto squared = [](float x) { return x * x; };
  const float brightness = mean(r.light.irradiance(r.normal));
  r.variance = brightness > 0.0f ? (r.variance * squared((1.0f - share) * brightness_before) +
                                    h.variance * squared(share * brightness_here)) /
                                       squared(brightness)
                                 : share;
  if (r.passes == 0) {
    r.clearance = h.clearance;
    r.mean_distance = h.mean_distance;
  } else {
    blend(r.mean_distance, h.mean_distance);
    for (std::size_t s = 0; s < r.clearance.size(); ++s) {
      r.clearance[s] = std::min(r.clearance[s], h.clearance[s]);
    }
  }
  ++r.passes;
  set_radii(r);
}

}  // namespace lumivec
