#include "integrator/path_tracer.h"

#include "integrator/path_stream.h"

namespace lumivec {

PathTracer::PathTracer(const TracedScene& scene, const Lights& lights, const CameraView& camera,
                       const RenderSettings& settings)
    : scene_(scene),
      lights_(lights),
      camera_(camera),
      settings_(settings),
      filter_(settings.filter) {
  eye_paths_find_caustics_ = lights.leaves_caustics() && !lights.leaves_all_caustics();
}

void PathTracer::render_tile(const Tile& tile, std::uint32_t first_sample,
                             std::uint32_t sample_count, std::vector<PixelSums>& sums,
                             RenderStatistics& statistics, const CacheUse& cache) const {
  PathStream stream(*this, tile, first_sample, sample_count, sums, statistics, cache);
  stream.run();
}

void PathTracer::render_ranges(const Tile& tile, const std::vector<SampleRange>& ranges,
                               std::vector<PixelSums>& sums, RenderStatistics& statistics,
                               const CacheUse& cache) const {
  PathStream stream(*this, tile, ranges, sums, statistics, cache);
  stream.run();
}

void PathTracer::gather(const std::vector<GatherRay>& rays, const MediumStack& media,
                        std::uint32_t seed, std::vector<GatherResult>& results,
                        RenderStatistics& statistics, const CacheUse& cache, Term term) const {
  results.resize(rays.size(), GatherResult());
  PathStream stream(*this, rays, media, seed, results, statistics, cache, term);
  stream.run();
}

}  // namespace lumivec
