// Makes records of the indirect light at a point: one path through each cell of a stratified
// hemisphere (eq. 2.5 of the paper), and from the cells the light vector and the derivatives.
//
// The cells have equal shares of the cosine-weighted hemisphere. Neighbouring cells' hits span
// triangles that stay in place when the point moves, so that the derivatives see what is uncovered
// behind near things (Schwarzhaupt, Jensen and Jarosz 2012). About 1 µs a path.
#pragma once

#include "integrator/irradiance_cache.h"
#include "integrator/media.h"
#include "integrator/path_tracer.h"

namespace lumivec {

// How finely a hemisphere is divided, by elevation and azimuth.
struct HemisphereCells {
  int rings = 16, sectors = 48;  // sectors: a multiple of IrradianceRecord::sector_count

  constexpr int count() const { return rings * sectors; }
};

class HemisphereGather {
 public:
  // tracer and scene must outlive this.
  // budget: that records will be asked for, scene units² (IrradianceCache).
  // term: indirect, or direct (PathTracer::gather).
  HemisphereGather(const PathTracer& tracer, const TracedScene& scene, const ValidityParts& parts,
                   float budget, Term term = Term::indirect);

  // A record of one hemisphere. seed: of its random numbers.
  // cache: where the paths may end.
  IrradianceRecord make(const RecordRequest& request, const HemisphereCells& cells,
                        std::uint32_t seed, RenderStatistics& statistics,
                        const CacheUse& cache = {}) const;

  // Averages one more hemisphere into a record; those before had as many cells.
  void refine(IrradianceRecord& record, const RecordRequest& request, const HemisphereCells& cells,
              std::uint32_t seed, RenderStatistics& statistics, const CacheUse& cache = {}) const;

  // The finest.
  static constexpr HemisphereCells most_cells = {16, 48};

 private:
  struct Hemisphere;
  void set_radii(IrradianceRecord& record) const;

  const PathTracer& tracer_;
  const TracedScene& scene_;
  const ValidityParts parts_;
  const float scale_;  // of radii, at that budget
  const Term term_;
};

}  // namespace lumivec
