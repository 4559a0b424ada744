// Light for views that change: chosen pixels of the view there is, and caches that grow with what
// the eye comes to see. What an interactive viewer is built on.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "integrator/camera_view.h"
#include "integrator/framebuffer.h"
#include "integrator/incident_light.h"
#include "integrator/record_mark.h"
#include "integrator/settings.h"
#include "integrator/visible_surfaces.h"
#include "loader/scene.h"

namespace lumivec {

enum class PhotonDemand : std::uint8_t;  // integrator/live_photons.h

// What to trace: samples of a pixel are numbered from 0 on, and no number gives the same twice.
struct LiveRequest {
  std::uint32_t pixel = 0;  // row by row
  std::uint32_t sample = 0;
  std::uint32_t count = 1;  // of samples, from that on
};

// The mean of a pixel's samples.
struct LiveSample {
  std::array<Color, term_count> terms;  // radiance, cd·m⁻²
  std::uint32_t pixel = 0;
  std::uint32_t count = 1;
  // Of what the first hit's specular lobe shows: 1 / its distance from there, scene units⁻¹; or
  // shows_nothing, shows_by_refraction (integrator/visible_surfaces.h). Of the last sample.
  float mirrored = shows_nothing;
};

// What has been changed in a scene that is being traced; nothing else has. Neither the number of
// instances nor that of materials may change.
struct SceneChanges {
  std::vector<int> moved;     // instances: their transforms, or whether they are visible
  std::vector<int> deformed;  // instances whose meshes are; no instance is in both lists
  // Values of materials, lights or the environment.
  bool light = false;

  bool empty() const { return moved.empty() && deformed.empty() && !light; }
};

// What a cache holds.
struct CacheSize {
  std::uint64_t entries = 0, bytes = 0;
};

class LiveTracer {
 public:
  // scene must outlive this. Of the settings: integrator, validity parts, cache_error, terms, seed,
  // specular_roughness, max_depth, filter, threads. Throws RenderError.
  LiveTracer(const Scene& scene, const RenderSettings& settings);
  ~LiveTracer();

  // The scene has been changed; set_view() must be called before anything else. Costs as much as
  // preparing the scene for tracing does. Cached light that is outdated is made anew by improve(),
  // what is near first. Throws RenderError.
  void update(const SceneChanges& changes);

  // The camera that the next calls are about, and the picture's size, pixels.
  void set_view(const Camera& camera, int width, int height);

  // What the eye is expected to see soon, until the next call: improve() makes records for it in
  // the time that the present view leaves. Null: nothing is.
  void expect_view(const Camera* camera);

  // Through the middles of all pixels.
  void see(VisibleSurfaces& seen);
  // Through the middles of these alone, best neighbours together; seen must have its size.
  void see(const std::vector<std::uint32_t>& pixels, VisibleSurfaces& seen);

  // Where the eye looks: what it sees in the middle, world space; the scene's middle if nothing is
  // there.
  V3d pivot(const VisibleSurfaces& seen) const;

  // How an instance curves toward the eye of the present view, scene units⁻¹: 1 / radius of what
  // bulges, negative of hollows, 0 of what is flat. NaN: it is neither a sphere nor flat.
  float curvature(int instance) const;

  // The view that was set last but `views_ago` (0 or 1), and how its pixels lie in traced space
  // (world space less origin()).
  const CameraView& view(int views_ago = 0) const;

  // In any order, and answered in any; a pixel at most once. centered: through the pixels' middles,
  // where see() looks, and not spread by the filter.
  void trace(const std::vector<LiveRequest>& requests, bool centered,
             std::vector<LiveSample>& samples);

  // Traces light paths for at most about so long; light-vectors alone. The few of the first view
  // grow to as many as a still has, and those of a view at rest are replaced by others
  // (live_photons.h). True: other ones are in use since.
  bool gather_photons(double seconds, PhotonDemand demand);

  // Makes cached light that the view lacks for at most so long, and then what there is better for
  // at most the other time out of it; light-vectors alone. resting: the view stays, so that light
  // is cached for a smaller and smaller error once it is there; of a view that moves, for that of
  // the settings. False: time was too short for all of it.
  bool improve(double seconds, double refining_seconds, bool resting);

  // Another number whenever cached light has become better as a whole, so that samples taken before
  // are worth less.
  unsigned generation() const;

  // Indirect light where the eye sees something through the middle of a pixel; none: there is
  // nothing.
  std::optional<IncidentLight> incident_light(int x, int y) const;

  // All records of indirect light, as the present view uses them.
  std::vector<RecordMark> records() const;

  CacheSize record_cache() const;  // of indirect light
  CacheSize photon_map() const;    // of caustics

  const V3d& origin() const;  // world space
  const RenderStatistics& statistics() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace lumivec
