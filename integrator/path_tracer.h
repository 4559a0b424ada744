// The unbiased path tracer: paths from the eye, light sampling and scattering combined by multiple
// importance sampling, every contribution filed under the term that the path's events give it
// (partition.h).
//
// Paths run in eight lanes (the packet width that AVX2 and AVX-512 machines both trace natively):
// each round traces one Embree packet of scattered rays and one of shadow rays, and shades the hits
// one by one; a lane whose path ends takes up the next one, so that packets stay full. Source:
// Veach 1997 (multiple importance sampling, Russian roulette).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "integrator/camera_view.h"
#include "integrator/framebuffer.h"
#include "integrator/irradiance_cache.h"
#include "integrator/lights.h"
#include "integrator/media.h"
#include "integrator/paper_cache.h"
#include "integrator/photon_map.h"
#include "integrator/pixel_filter.h"
#include "integrator/pixel_sums.h"
#include "integrator/settings.h"
#include "integrator/visible_surfaces.h"

namespace lumivec {

// Samples [first, first + count) of one pixel of a tile.
struct SampleRange {
  std::uint32_t pixel = 0;  // row by row
  std::uint32_t first = 0, count = 0;
  std::uint32_t sums = 0;  // index of what they are added to
  bool centered = false;   // through the pixel's middle, not spread by the filter
};

// A path that gathers indirect light for a diffuse surface.
struct GatherRay {
  V3f origin{0.0f}, direction{0.0f};
  std::uint32_t index = 0;  // of its random numbers
};
struct GatherResult {
  Color radiance{0.0f};   // that belongs to the term asked for, cd·m⁻²
  float distance = 0.0f;  // to what is hit first, scene units; +inf: nothing
};

// A place where a path found no cached light.
struct RecordRequest {
  CachePoint point;
  MediumStack media;
};

// How paths from the eye use cached light: where it is found at a diffuse lobe, that lobe's
// indirect light is taken from it, and the path goes on by other lobes alone.
struct CacheUse {
  const IrradianceCache* indirect = nullptr;  // null: none is used
  // The direct light of the environment's even part (EnvironmentLight), where there is indirect
  // light; null: none is used.
  const IrradianceCache* direct = nullptr;
  // Instead of it: light of broad lobes too, by the paper's criteria.
  const PaperCache* paper = nullptr;
  float budget = 0.0f;  // scene units² (IrradianceCache)
  float needed_weight = 0.0f;
  // What indirect light is not found within the budget is looked for once more with the first of
  // these that finds any record, however little it weighs; 0: it is not.
  std::array<float, 2> meanwhile_budgets = {0.0f, 0.0f};
  // Where to note what was not found; null: paths go on there as if there were no cache.
  std::vector<RecordRequest>* requests = nullptr;
  Term requested = Term::indirect;  // or direct
  std::vector<PaperPoint>* paper_requests = nullptr;
  float spread = 0.0f;  // gathering: angle between neighbouring paths, radians
  // What light paths bring, in place of what they would add to the picture; null: nothing.
  const PhotonMap* photons = nullptr;

  bool any() const { return indirect || direct || paper; }
  bool asks() const { return requests || paper_requests; }
};

class PathTracer {
 public:
  // All must outlive this.
  PathTracer(const TracedScene& scene, const Lights& lights, const CameraView& camera,
             const RenderSettings& settings);

  // Adds samples [first_sample, first_sample + sample_count) of every pixel of the tile to sums
  // (row by row, tile.width × tile.height). The result depends on nothing but these arguments and
  // the settings.
  void render_tile(const Tile& tile, std::uint32_t first_sample, std::uint32_t sample_count,
                   std::vector<PixelSums>& sums, RenderStatistics& statistics,
                   const CacheUse& cache = {}) const;

  // Likewise the samples of ranges alone, each to the sums that it names.
  void render_ranges(const Tile& tile, const std::vector<SampleRange>& ranges,
                     std::vector<PixelSums>& sums, RenderStatistics& statistics,
                     const CacheUse& cache = {}) const;

  // Traces rays that left a diffuse surface inside media; results: one for each ray. Depends on
  // nothing else. seed: of the random numbers. term: indirect, all of it; or direct, of the
  // environment's even part alone.
  void gather(const std::vector<GatherRay>& rays, const MediumStack& media, std::uint32_t seed,
              std::vector<GatherResult>& results, RenderStatistics& statistics,
              const CacheUse& cache = {}, Term term = Term::indirect) const;

 private:
  friend class PathStream;

  const TracedScene& scene_;
  const Lights& lights_;
  const CameraView& camera_;
  RenderSettings settings_;
  bool eye_paths_find_caustics_ = false;  // not all of them are left to light paths
  PixelFilterSampler filter_;
};

}  // namespace lumivec
