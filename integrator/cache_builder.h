// Fills the cache of indirect light with the records that a picture needs, from coarse to fine: the
// eye's paths through every 32nd pixel ask for records where they find none, then those through
// every 16th, and so on. Records are made in batches of fixed size in a fixed order, and a batch
// sees those before it alone, so that the threads do not show.
#pragma once

#include <ImathBox.h>
#include <ImathMatrix.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "integrator/hemisphere_gather.h"
#include "integrator/irradiance_cache.h"
#include "integrator/path_tracer.h"

namespace lumivec {

// An instance that has moved or has been deformed.
struct MovedPart {
  int instance = -1;                   // index into Scene::instances
  std::optional<Imath::M44f> motion;   // of its points, traced space; none: they are other ones
  std::array<Imath::Box3f, 2> bounds;  // before and after, traced space; empty: not there
};

class CacheBuilder {
 public:
  // All must outlive this.
  // term: indirect, or direct (PathTracer::gather).
  CacheBuilder(const PathTracer& tracer, const TracedScene& scene, const RenderSettings& settings,
               IrradianceCache& cache, Term term = Term::indirect);

  // The relative error that records made from now on are for, > 0: their reach and their number of
  // hemispheres follow from it.
  void set_error(double error);

  // What light paths bring, to records and to pixels alike; null: nothing. Must outlive this.
  void set_photons(const PhotonMap* photons) { photons_ = photons; }

  // Where records and pixels alike find direct light; null: nowhere. Must outlive this.
  void set_direct(const IrradianceCache* direct) { direct_ = direct; }

  // Makes the first records, and tells whether they are accurate enough that more would pay: light
  // from small parts of the sky, through windows or between leaves, is found better by sampling it.
  // As build().
  bool try_out(const std::vector<Tile>& tiles, const std::function<bool()>& go_on,
               RenderStatistics& statistics);

  // Makes the records that the tiles lack, and makes all as good as the error asks. go_on is asked
  // between batches; false ends it early. False: ended.
  bool build(const std::vector<Tile>& tiles, const std::function<bool()>& go_on,
             RenderStatistics& statistics);

  // For a view that changes: makes records that every stride-th pixel of what `eye` sees lacks, in
  // both directions,
  // from pixel `phase` of each such block on, row by row, where no record holds for a budget that
  // is slack times what the error asks, ≥ 1. go_on is asked more often. As build().
  bool extend(const PathTracer& eye, const std::vector<Tile>& tiles, int stride, int phase,
              float slack, const std::function<bool()>& go_on, RenderStatistics& statistics);

  // Averages hemispheres, whose paths end in the cache, into records until each has enough. The
  // first replaces what whole paths brought. As build().
  bool refine(const std::function<bool()>& go_on, RenderStatistics& statistics);

  // The scene has changed, and these parts of it have moved. Records on them move along or are
  // dropped; all are made anew by extend(), those near the parts first. Not while others use the
  // cache.
  void change(const std::vector<MovedPart>& parts);

  // How pixels use the cache.
  CacheUse use() const;

 private:
  bool fill(const std::vector<Tile>& tiles, int first_stride, int last_stride, float wanted_weight,
            const std::function<bool()>& go_on, RenderStatistics& statistics);
  // Makes outdated records anew, at most so many.
  void renew(std::size_t most, const std::function<bool()>& go_on, RenderStatistics& statistics);
  std::uint32_t record_seed(std::uint32_t record, std::uint32_t round) const;
  // Where paths that gather light may end.
  CacheUse path_ends() const;
  std::vector<RecordRequest> collect(const PathTracer& eye, const std::vector<Tile>& tiles,
                                     int stride, int phase, float wanted_weight,
                                     RenderStatistics& statistics) const;
  bool make_records(std::vector<RecordRequest>& requests, float wanted_weight,
                    const std::function<bool()>& go_on, RenderStatistics& statistics);

  const PathTracer& tracer_;
  const RenderSettings& settings_;
  IrradianceCache& cache_;
  const TracedScene& scene_;
  const Term term_;
  const PhotonMap* photons_ = nullptr;
  const IrradianceCache* direct_ = nullptr;
  float budget_ = 0.0f;          // scene units², see IrradianceCache
  float slack_ = 1.0f;           // factor of it
  float most_variance_ = 0.0f;   // of a record's irradiance, relative
  HemisphereCells cells_;        // of a record's hemispheres
  std::uint32_t passes_ = 1;     // hemispheres of a record
  std::size_t batch_size_ = 64;  // records that are made at a time, without knowing of each other
  std::uint32_t committed_ = 0;  // records at the last commit, of extend() alone
  std::optional<HemisphereGather> gather_;
  std::vector<RecordRequest> places_;    // of the records, to refine them
  std::vector<std::uint32_t> outdated_;  // records; the next to be made anew is the last one
};

}  // namespace lumivec
