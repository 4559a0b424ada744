// What a moving eye sees, frame by frame, each within a given time: the engine of the walk and of
// the window.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "integrator/live_tracer.h"
#include "viewer/walk/shading_cache.h"

namespace lumivec {

// How pixels get their light; with or without the shading cache, by path tracing or from light
// vectors.
struct WalkMode {
  bool reuse = true;
  bool light_vectors = true;
};

// Whether two cameras see the same.
bool same_view(const Camera& a, const Camera& b);

class WalkEngine {
 public:
  // scene must outlive this. settings: as LiveTracer's, with width and height. Throws RenderError.
  WalkEngine(const Scene& scene, const RenderSettings& settings, const WalkMode& mode);

  struct Frame {
    double seconds = 0.0;    // to the picture
    std::size_t traced = 0;  // samples
    std::size_t rays = 0;    // to find out what the eye sees
    std::size_t holes = 0;   // pixels without a sample, filled from neighbours
    double mean_age = 0.0;   // frames since pixels were traced
    std::uint64_t cache_hits = 0, cache_misses = 0;
  };

  // The next frame. frame_time: what tracing and records may fill up, seconds; without reuse all
  // pixels are traced, however long it takes. picture: radiance of those terms.
  Frame advance(const Camera& camera, double frame_time, std::uint32_t terms,
                std::vector<Color>& picture);

  // The scene has been changed since the last frame. Throws RenderError.
  void update(const SceneChanges& changes);

  // One term of the last frame, without any tracing.
  void layer(Term term, std::vector<Color>& pixels) const {
    shading_.resolve(1u << static_cast<unsigned>(term), visibility_.now(), pixels);
  }

  // Where the eye looks: the point at the middle of the last frame, world space; the scene's middle
  // if nothing is there.
  V3d pivot() const;

  const RenderStatistics& statistics() const { return tracer_.statistics(); }

 private:
  void change_light(const std::function<void()>& change);
  void trace_all();
  void trace_within(double seconds);

  const int width_, height_;
  const WalkMode mode_;
  LiveTracer tracer_;
  Visibility visibility_;
  ShadingCache shading_;
  std::optional<Camera> last_;
  bool moved_ = false;
  int resting_ = 0;                  // frames since the eye or the scene moved
  bool changed_ = false;             // the scene, since the last frame
  bool changes_ = false;             // ever
  double seconds_since_change_ = 0;  // of frames
  std::size_t samples_at_rest_ = 0;  // since the eye or the scene moved
  std::size_t next_rest_ = 0;        // at how many the tracer takes its time
  std::uint32_t frame_ = 0;
  double sample_seconds_;         // of one sample, as measured
  double fixed_seconds_ = 0.005;  // of what is done once a frame after tracing, as measured
  V3d pivot_{0.0};
  std::vector<LiveRequest> requests_;
  std::vector<LiveSample> samples_;
};

}  // namespace lumivec
