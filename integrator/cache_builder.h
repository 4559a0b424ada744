// Fills the cache of indirect light with the records that a picture needs, from coarse to fine: the
// eye's paths through every 32nd pixel ask for records where they find none, then those through
// every 16th, and so on. Records are made in batches of fixed size in a fixed order, and a batch
// sees those before it alone, so that the threads do not show.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "integrator/hemisphere_gather.h"
#include "integrator/irradiance_cache.h"
#include "integrator/path_tracer.h"

namespace lumivec {

class CacheBuilder {
 public:
  // budget: scene units², see IrradianceCache. All must outlive this.
  CacheBuilder(const PathTracer& tracer, const TracedScene& scene, const RenderSettings& settings,
               IrradianceCache& cache, float budget);

  // Another budget for what is made and looked up from now on.
  void set_budget(float budget);
  float budget() const { return budget_; }

  // Makes what the tiles lack. go_on is asked between batches; false ends it early. False: ended.
  bool fill(const std::vector<Tile>& tiles, const std::function<bool()>& go_on,
            RenderStatistics& statistics);

  // Averages so many more hemispheres into all records, whose paths end in the cache. The first
  // such replaces what whole paths brought.
  bool refine(std::uint32_t passes, const std::function<bool()>& go_on,
              RenderStatistics& statistics);

  // How pixels use the cache.
  CacheUse use() const;

  // Relative error of the records' irradiance that is left by their noise, √mean square.
  double noise() const;

 private:
  // Where paths that gather light may end.
  CacheUse path_ends() const;
  std::vector<RecordRequest> collect(const std::vector<Tile>& tiles, int stride,
                                     RenderStatistics& statistics) const;
  bool make_records(std::vector<RecordRequest>& requests, const std::function<bool()>& go_on,
                    RenderStatistics& statistics);

  const PathTracer& tracer_;
  const RenderSettings& settings_;
  IrradianceCache& cache_;
  const TracedScene& scene_;
  float budget_ = 0.0f;
  std::optional<HemisphereGather> gather_;
  bool settled_ = false;               // all records have been made by paths that end in the cache
  std::vector<RecordRequest> places_;  // of the records, to refine them
};

}  // namespace lumivec
