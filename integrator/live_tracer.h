// Light for views that change: chosen pixels of the view there is, and caches that grow with what
// the eye comes to see. What an interactive viewer is built on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "integrator/framebuffer.h"
#include "integrator/settings.h"
#include "loader/scene.h"

namespace lumivec {

// What the eye sees through a point of the picture.
struct VisiblePoint {
  V3f position{0.0f};        // traced space: world space less LiveTracer::origin(), scene units
  V3f normal{0.0f};          // unit, shading normal before normal maps, on the eye's side
  float depth = 0.0f;        // along the view axis, scene units; +inf: nothing
  std::int32_t object = -1;  // index into Scene::instances; -1: nothing
};

// One sample of a pixel.
struct LiveSample {
  std::array<Color, term_count> terms;  // radiance, cd·m⁻²
  std::uint32_t pixel = 0;
};

// What to trace: samples of a pixel are numbered from 0 on, and no number gives the same twice.
struct LiveRequest {
  std::uint32_t pixel = 0;  // row by row
  std::uint32_t sample = 0;
};

class LiveTracer {
 public:
  // scene must outlive this. Of the settings: integrator, validity parts, cache_error, terms, seed,
  // specular_roughness, max_depth, filter, threads. Throws RenderError.
  LiveTracer(const Scene& scene, const RenderSettings& settings);
  ~LiveTracer();

  // The camera that the next calls are about, and the picture's size, pixels.
  void set_view(const Camera& camera, int width, int height);

  // Through the centres of all pixels, row by row.
  void see(std::vector<VisiblePoint>& points);

  // Where a point of traced space is in the view that was set last but `views_ago` (0 or 1).
  // False: outside.
  bool project(const V3f& p, int views_ago, V2f& pixel) const;
  // Size of a pixel at a depth along the view axis, scene units.
  float footprint(float depth) const;

  // One sample each, in any order; a pixel at most once. centered: through the pixels' middles,
  // where see() looks, and not spread by the filter.
  void trace(const std::vector<LiveRequest>& requests, bool centered,
             std::vector<LiveSample>& samples);

  // Makes cached light that the view lacks for at most so long; light-vectors alone. False: time
  // was too short for all of it.
  bool improve(double seconds);

  const V3d& origin() const;  // world space
  const RenderStatistics& statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lumivec
