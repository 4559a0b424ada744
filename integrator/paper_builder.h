// Fills the cache of the paper's method (section 2.4): first records at pixels drawn at random, the
// seed; then the other pixels, each of which has a record made where it finds too few valid ones.
//
// The paper goes through the pixels row by row. Here they come in random order, in groups of fixed
// size that see only what earlier ones have made, so that the threads do not show. A moving eye
// would need seeds of several directions (section 3.1); a still has one.
#pragma once

#include <functional>
#include <vector>

#include "integrator/paper_cache.h"
#include "integrator/path_tracer.h"

namespace lumivec {

class PaperBuilder {
 public:
  // All must outlive this.
  PaperBuilder(const PathTracer& tracer, const TracedScene& scene, const RenderSettings& settings,
               PaperCache& cache);

  // What light paths bring, to records and to pixels alike; null: nothing. Must outlive this.
  void set_photons(const PhotonMap* photons) { photons_ = photons; }

  // Makes the records of the picture's first samples. go_on is asked between groups; false ends it
  // early. False: ended.
  bool build(const std::function<bool()>& go_on, RenderStatistics& statistics);

  // How pixels use the cache.
  CacheUse use() const;

 private:
  std::vector<PaperPoint> collect(const std::vector<std::uint32_t>& pixels, std::size_t begin,
                                  std::size_t end, const PaperCache& known,
                                  RenderStatistics& statistics) const;
  bool make_records(const std::vector<PaperPoint>& points, bool all,
                    const std::function<bool()>& go_on, RenderStatistics& statistics);
  Bsdf bsdf(const PaperPoint& point, const Color& base_color) const;
  bool finished() const;

  const PathTracer& tracer_;
  const TracedScene& scene_;
  const RenderSettings& settings_;
  PaperCache& cache_;
  const PhotonMap* photons_ = nullptr;
  bool full_ = false;
};

}  // namespace lumivec
