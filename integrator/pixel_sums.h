// What samples add up to, pixel by pixel, and the tiles of pixels that threads share out.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "integrator/framebuffer.h"
#include "integrator/settings.h"
#include "integrator/visible_surfaces.h"

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
  std::uint32_t first_sample = 0;  // whose position, depth and object are kept
  float squares = 0.0f;         // of the samples' brightness, the mean of the channels of all terms
  float traced_squares = 0.0f;  // likewise without what photons brought
  float photons = 0.0f;         // the samples' brightness that photons brought
  float mirrored = shows_nothing;  // vergence of what the last sample's specular lobe shows

  PixelSums() { terms.fill(Color(0.0f)); }
};

struct Tile {
  int x = 0, y = 0, width = 0, height = 0;  // pixels
};

}  // namespace lumivec
