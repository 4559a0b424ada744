// Sums over all samples of a still so far, of eye paths and of light paths, the estimate of their
// spread, and the picture that they make.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "integrator/framebuffer.h"
#include "integrator/light_tracer.h"
#include "integrator/pixel_sums.h"
#include "integrator/settings.h"

namespace lumivec {

class Film {
 public:
  // Of settings' width × height pixels, all without samples.
  explicit Film(const RenderSettings& settings);

  // Tiles [0, tile_count()) cover the picture, row by row.
  int tile_count() const { return columns_ * rows_; }
  Tile tile(int index) const;

  // sums: one for each pixel of tile, row by row. first_pass: position, depth and object are taken
  // from them. From several threads at once for different tiles.
  void add(const Tile& tile, const std::vector<PixelSums>& sums, bool first_pass);

  // What a light path brought to the picture.
  void add(const Splat& splat);
  void add_light_paths(std::uint64_t count) { light_paths_ += count; }
  std::uint64_t light_paths() const { return light_paths_; }

  // Mean radiance of a term at pixel i: eye paths by the pixel's samples, light paths by their own
  // number.
  Color mean(std::size_t i, std::size_t term) const;
  // Of all terms.
  Color beauty(std::size_t i) const;

  // Estimated from the spread of its samples: the variance of pixel i's mean brightness, relative
  // as in relMSE. 0 with fewer than two samples.
  double relative_variance(std::size_t i) const;

  // Estimated √relMSE; −1 where a pixel has too few samples to tell.
  double relative_error() const;

  // Of one sample, √: what a pixel's number of samples should be in proportion to, pixel by pixel.
  // Taken from the eight pixels around it and not from its own samples: pixels that have met
  // nothing bright yet would have fewer samples for it, and their means would be too dark (Kirk and
  // Arvo 1991, "Unbiased Sampling Techniques for Image Synthesis"). What photons bring is the same
  // for neighbours, and left out for that reason but for its mean over the tile.
  std::vector<float> spread() const;

  std::size_t size() const { return pixels_.size(); }
  const PixelSums& pixel(std::size_t i) const { return pixels_[i]; }

  // The picture. origin: of traced space, in the scene's.
  Framebuffer resolve(const V3d& origin) const;

 private:
  template <typename Visit>
  void for_each_pixel(const Tile& tile, const Visit& visit) const;
  std::vector<float> own_spread() const;

  int width_, height_, columns_, rows_;
  std::vector<PixelSums> pixels_;
  struct LightSums {
    std::array<Color, term_count> terms;
    LightSums() { terms.fill(Color(0.0f)); }
  };
  std::vector<LightSums> light_;  // from light paths; empty until the first arrives
  std::uint64_t light_paths_ = 0;
};

}  // namespace lumivec
