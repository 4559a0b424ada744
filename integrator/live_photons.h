// Photon maps of views that change: a wide one, with large discs, that grows while the eye moves,
// and, while it rests, one after the other with narrower discs, so that the mean of what they show
// converges (photon_map.h).
//
// Tracing takes the time that it is given; trees are built beside, in a thread of their own.
#pragma once

#include <tbb/task_arena.h>

#include <cstdint>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "integrator/light_tracer.h"
#include "integrator/photon_map.h"

namespace lumivec {

// What the picture does.
enum class PhotonDemand : std::uint8_t {
  grow,    // it moves: as many photons as can be, the same ones for all frames
  keep,    // it rests, and has made too few samples with the present map
  another  // it rests, and has made enough
};

enum class PhotonChange : std::uint8_t {
  none,
  another,  // there is another map, as good as the last
  better    // there are more photons: what was made of the last map is worth less
};

class LivePhotons {
 public:
  // Of each map of a view at rest.
  static constexpr std::uint64_t paths_of_map_at_rest = 1 << 16;

  // scene must outlive this and may change in place between stop() and restart(). bytes: the memory
  // of a map, about; it grows no further.
  LivePhotons(const TracedScene& scene, std::uint64_t bytes);
  LivePhotons(const LivePhotons&) = delete;
  ~LivePhotons() { stop(); }

  // Begins anew, with a map of few paths: of the first picture, or while the scene changes. tracer
  // must outlive all calls up to stop(). pixels: of the picture.
  void restart(const LightTracer& tracer, std::size_t pixels, tbb::task_arena& arena,
               RenderStatistics& statistics);
  // Waits for what is built in the background, and drops what was not used yet.
  void stop();

  // Traces light paths for at most about so long.
  PhotonChange gather(double seconds, PhotonDemand demand, tbb::task_arena& arena,
                      RenderStatistics& statistics);

  // Null: no light comes that way.
  const PhotonMap* in_use() const { return in_use_; }
  std::size_t size() const;
  std::size_t bytes() const;

 private:
  // Photons are where light falls, whatever the eye sees.
  struct GrowingMap {
    std::uint64_t first = 0;  // light path; no two maps have the same
    std::uint64_t traced = 0;
    std::vector<Photon> photons;
  };

  void trace(std::uint64_t paths, GrowingMap& map) const;
  void build(PhotonMap& map, GrowingMap from, std::uint32_t number) const;
  void build_beside(GrowingMap from, std::uint32_t number, RenderStatistics& statistics);
  PhotonChange take_what_is_built();

  const std::uint64_t most_photons_;
  const LightTracer* tracer_ = nullptr;
  std::uint64_t pixels_ = 1;
  std::unique_ptr<PhotonMap> wide_, narrow_, next_;  // next_: being built
  const PhotonMap* in_use_ = nullptr;
  GrowingMap growing_wide_;
  std::uint64_t used_paths_ = 0;  // of growing_wide_'s, that wide_ is or will be made of
  std::optional<GrowingMap> growing_narrow_;
  std::uint32_t narrow_maps_ = 0;  // begun since the eye rests
  std::future<void> building_;
  bool building_narrow_ = false;
};

}  // namespace lumivec
