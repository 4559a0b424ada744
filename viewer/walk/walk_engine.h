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

// What frames keep of those before them: nothing; what surfaces look like, while what the eye sees
// is traced afresh (the shading cache); or the points that were seen, moved to where they are seen
// now, so that pixels between them are guessed (the render cache in image space of Walter,
// Drettakis and Parker 1999).
enum class Reuse { nothing, shading, image };

// How pixels get their light: what is kept, and by path tracing or from light vectors.
struct WalkMode {
  Reuse reuse = Reuse::shading;
  bool light_vectors = true;
};

// Whether two cameras see the same.
bool same_view(const Camera& a, const Camera& b);

class WalkEngine {
 public:
  // scene must outlive this. settings: as LiveTracer's, with width and height. Throws RenderError.
  WalkEngine(const Scene& scene, const RenderSettings& settings, const WalkMode& mode);

  struct Frame {
    double seconds = 0.0;          // to the picture; of these:
    double seconds_view = 0.0;     // for what the eye sees and what is carried over
    double seconds_records = 0.0;  // for cached light
    double seconds_samples = 0.0;
    std::size_t traced = 0;  // samples
    std::size_t rays = 0;    // to find out what the eye sees
    std::size_t holes = 0;   // pixels without a sample, filled from neighbours
    double mean_age = 0.0;   // frames since pixels were traced
    std::uint64_t cache_hits = 0, cache_misses = 0;
  };

  // The next frame. frame_time: what tracing and records may fill up, seconds, a few times as
  // much while the view rests; without reuse all pixels are traced, however long it takes. picture:
  // radiance of those terms.
  Frame advance(const Camera& camera, double frame_time, std::uint32_t terms,
                std::vector<Color>& picture);

  // The scene has been changed since the last frame. Throws RenderError.
  void update(const SceneChanges& changes);

  // One term of the last frame, without any tracing.
  void layer(Term term, std::vector<Color>& pixels) const {
    shading_.resolve(1u << static_cast<unsigned>(term), visibility_.now(), pixels);
  }

  // Records of cached light, as the last frame used them.
  std::vector<RecordMark> records() const { return tracer_.records(); }
  // Where the last frame's pixel (x, y) sees something.
  std::optional<IncidentLight> incident_light(int x, int y) const {
    return tracer_.incident_light(x, y);
  }

  struct Caches {
    CacheSize records, photons, shading;  // entries: records, photons, pixels that show something
  };
  Caches caches() const;

  // Where the eye looks: the point at the middle of the last frame, world space; the scene's middle
  // if nothing is there.
  V3d pivot() const;

  // What the eye saw last, pixel by pixel.
  const VisibleSurfaces& surfaces() const { return visibility_.now(); }

  // Pictures have this size from the next frame on, which begins without any; cached light stays.
  void resize(int width, int height);

  const RenderStatistics& statistics() const { return tracer_.statistics(); }

 private:
  void change_light(const std::function<void()>& change);
  void expect_view(const Camera& camera);
  void gather_photons(double seconds);
  void improve(double seconds);
  void trace_all();
  void verify_chosen();
  void trace_within(double seconds);

  int width_, height_;
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
  std::size_t traced_ = 0;           // samples of this frame
  std::size_t next_map_ = 0;         // at how many other photons are wanted
  std::uint32_t frame_ = 0;
  double sample_seconds_;         // of one sample, as measured
  double fixed_seconds_ = 0.005;  // of what is done once a frame after tracing, as measured
  V3d pivot_{0.0};
  std::vector<LiveRequest> requests_;
  std::vector<LiveSample> samples_;
  std::vector<std::uint32_t> pixels_, others_;
};

}  // namespace lumivec
