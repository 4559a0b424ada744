// What a render is asked for: one struct for the command, the window and the tests.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace lumivec {

// The five parts of the light (method: E L | E S… | E D L | E D…D…L | E D S+ L); a partition of all
// paths.
enum class Term : std::uint8_t { emitted, specular, direct, indirect, caustic };
constexpr int term_count = 5;
constexpr std::array<std::string_view, term_count> term_names = {"emitted", "specular", "direct",
                                                                 "indirect", "caustic"};

// Pixel reconstruction filters, all positive: samples are drawn from the filter, so pixels stay
// independent.
enum class PixelFilter : std::uint8_t { box, tent, gaussian, blackman_harris };

constexpr int max_picture_side = 65536;       // pixels
constexpr int max_picture_samples = 1 << 22;  // a pixel

struct RenderSettings {
  int width = 512;   // pixels, [1, max_picture_side]
  int height = 512;  // pixels, [1, max_picture_side]
  PixelFilter filter = PixelFilter::box;

  // What ends a render; each 0 means "not by this". With none set: 64 samples a pixel.
  int samples = 0;       // samples a pixel, at most max_picture_samples
  double seconds = 0.0;  // wall-clock time for sampling
  double error = 0.0;    // target relative error, √relMSE, as a fraction (0.01 = 1%)

  std::uint32_t terms = (1u << term_count) - 1;  // bit i: compute Term(i); others are left black
  int threads = 0;                               // 0: all processors
  std::uint64_t seed = 0;

  // A lobe below this perceptual roughness is specular (S), as delta lobes are; above, it is
  // non-specular (D). Caches interpolate D lobes, so this is where reflections become too sharp to
  // be interpolated. Range [0, 1].
  float specular_roughness = 0.15f;

  int max_depth = 0;  // scattering events a path may have; 0: no limit, Russian roulette only
};

}  // namespace lumivec
