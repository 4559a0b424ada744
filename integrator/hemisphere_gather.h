// Makes records of the indirect light at a point: one path through each cell of a stratified
// hemisphere (eq. 2.5 of the paper), and from the cells the light vector and the derivatives.
//
// The cells have equal shares of the cosine-weighted hemisphere. Neighbouring cells' hits span
// triangles that stay in place when the point moves, so that the derivatives see what is uncovered
// behind near things (Schwarzhaupt, Jensen and Jarosz 2012). About 0.7 ms a hemisphere of 768
// paths.
#pragma once

#include "integrator/irradiance_cache.h"
#include "integrator/media.h"
#include "integrator/path_tracer.h"

namespace lumivec {

class HemisphereGather {
 public:
  // tracer and scene must outlive this.
  // budget: that records will be asked for, scene units² (IrradianceCache).
  HemisphereGather(const PathTracer& tracer, const TracedScene& scene, const ValidityParts& parts,
                   float budget);

  // A record of one hemisphere. seed: of its random numbers.
  // cache: where the paths may end.
  IrradianceRecord make(const RecordRequest& request, std::uint32_t seed,
                        RenderStatistics& statistics, const CacheUse& cache = {}) const;

  // Averages one more hemisphere into a record.
  void refine(IrradianceRecord& record, const RecordRequest& request, std::uint32_t seed,
              RenderStatistics& statistics, const CacheUse& cache = {}) const;

  static constexpr int rings = 16, sectors = 48;  // cells by elevation and azimuth
  static constexpr int cells = rings * sectors;

 private:
  struct Hemisphere;
  void set_radii(IrradianceRecord& record) const;

  const PathTracer& tracer_;
  const TracedScene& scene_;
  const ValidityParts parts_;
  const float scale_;  // of radii, at that budget
};

}  // namespace lumivec
