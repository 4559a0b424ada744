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
#include <limits>
#include <vector>

#include "integrator/camera_view.h"
#include "integrator/framebuffer.h"
#include "integrator/lights.h"
#include "integrator/pixel_filter.h"
#include "integrator/settings.h"

namespace lumivec {

// Sums over the samples of one pixel.
struct PixelSums {
  std::array<Color, term_count> terms;
  Color albedo{0.0f};
  V3f normal{0.0f};
  V3f position{0.0f};  // traced space, of the first sample
  float depth =
      std::numeric_limits<float>::infinity();  // of the first sample; +inf: nothing was hit
  std::int32_t object = -1;
  std::uint32_t samples = 0;

  PixelSums() { terms.fill(Color(0.0f)); }
};

struct Tile {
  int x = 0, y = 0, width = 0, height = 0;  // pixels
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
                   std::vector<PixelSums>& sums, RenderStatistics& statistics) const;

 private:
  friend class PathStream;

  const TracedScene& scene_;
  const Lights& lights_;
  const CameraView& camera_;
  RenderSettings settings_;
  PixelFilterSampler filter_;
};

}  // namespace lumivec
