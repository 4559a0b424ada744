#include "integrator/film.h"

#include <algorithm>
#include <cmath>

#include "integrator/relative_error.h"

namespace lumivec {
namespace {

// Large enough to keep eight lanes full to the end, small enough that sums stay in the cache and
// two threads end together.
constexpr int tile_size = 16;
// Pixels darker than this share of the picture's mean are sampled as if they were as bright.
constexpr double dark_share = 0.2;

// Mean of a pixel's samples, of the channels of all terms.
double brightness(const PixelSums& p) {
  double sum = 0.0;
  for (const Color& c : p.terms) sum += (double(c.x) + c.y + c.z) / 3.0;
  return p.samples > 0 ? sum / p.samples : 0.0;
}
double photon_brightness(const PixelSums& p) {
  return p.samples > 0 ? double(p.photons) / p.samples : 0.0;
}
// Of the mean of two samples or more.
double variance_of(const PixelSums& p, double squares, double mean) {
  return std::max(0.0, squares / p.samples - mean * mean) / (p.samples - 1.0);
}

}  // namespace

Film::Film(const RenderSettings& settings)
    : width_(settings.width),
      height_(settings.height),
      columns_((settings.width + tile_size - 1) / tile_size),
      rows_((settings.height + tile_size - 1) / tile_size),
      pixels_(std::size_t(settings.width) * std::size_t(settings.height)) {}

Tile Film::tile(int index) const {
  const int x = index % columns_ * tile_size, y = index / columns_ * tile_size;
  return {x, y, std::min(tile_size, width_ - x), std::min(tile_size, height_ - y)};
}

void Film::add(const Tile& tile, const std::vector<PixelSums>& sums, bool first_pass) {
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      const PixelSums& from = sums[std::size_t(y) * std::size_t(tile.width) + std::size_t(x)];
      PixelSums& to =
          pixels_[std::size_t(tile.y + y) * std::size_t(width_) + std::size_t(tile.x + x)];
      for (std::size_t i = 0; i < term_count; ++i) to.terms[i] += from.terms[i];
      to.albedo += from.albedo;
      to.normal += from.normal;
      to.samples += from.samples;
      to.squares += from.squares;
      to.traced_squares += from.traced_squares;
      to.photons += from.photons;
      if (!first_pass) continue;
      to.position = from.position;
      to.depth = from.depth;
      to.object = from.object;
    }
  }
}

void Film::add(const Splat& splat) {
  if (light_.empty()) light_.resize(pixels_.size());
  light_[splat.pixel].terms[static_cast<std::size_t>(splat.term)] += splat.value;
}

Color Film::mean(std::size_t i, std::size_t term) const {
  const PixelSums& p = pixels_[i];
  Color result(0.0f);
  if (p.samples > 0) result += p.terms[term] * (1.0f / static_cast<float>(p.samples));
  if (!light_.empty() && light_paths_ > 0)
    result += light_[i].terms[term] * static_cast<float>(1.0 / static_cast<double>(light_paths_));
  return result;
}

Color Film::beauty(std::size_t i) const {
  Color sum(0.0f);
  for (std::size_t term = 0; term < term_count; ++term) sum += mean(i, term);
  return sum;
}

double Film::relative_variance(std::size_t i) const {
  const PixelSums& p = pixels_[i];
  if (p.samples < 2) return 0.0;
  const double mean = brightness(p);
  const double variance = variance_of(p, p.squares, mean);
  return variance > 0.0 ? relative_to(variance, mean * mean) : 0.0;
}

double Film::relative_error() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    if (pixels_[i].samples < 2) return -1.0;
    sum += relative_variance(i);
  }
  return std::sqrt(sum / static_cast<double>(pixels_.size()));
}

template <typename Visit>
void Film::for_each_pixel(const Tile& tile, const Visit& visit) const {
  for (int y = tile.y; y < tile.y + tile.height; ++y) {
    for (int x = tile.x; x < tile.x + tile.width; ++x)
      visit(std::size_t(y) * std::size_t(width_) + std::size_t(x));
  }
}

// Likewise, of the pixel's own samples, not √.
std::vector<float> Film::own_spread() const {
  std::vector<float> result(pixels_.size());
  std::vector<double> photons(static_cast<std::size_t>(tile_count()));
  double all = 0.0;
  for (int t = 0; t < tile_count(); ++t) {
    for_each_pixel(tile(t), [&](std::size_t i) {
      all += brightness(pixels_[i]);
      photons[std::size_t(t)] += photon_brightness(pixels_[i]);
    });
    const Tile area = tile(t);
    photons[std::size_t(t)] /= double(area.width) * area.height;
  }
  // Relative to the picture's own brightness, so that twice the light is sampled alike.
  const double dark = dark_share * all / static_cast<double>(result.size());
  for (int t = 0; t < tile_count(); ++t) {
    for_each_pixel(tile(t), [&](std::size_t i) {
      const PixelSums& p = pixels_[i];
      if (p.samples < 2) return;
      const double traced = brightness(p) - photon_brightness(p);
      const double seen = traced + photons[std::size_t(t)];
      const double variance = p.samples * variance_of(p, p.traced_squares, traced);
      if (variance > 0.0) result[i] = static_cast<float>(variance / (seen * seen + dark * dark));
    });
  }
  return result;
}

std::vector<float> Film::spread() const {
  const std::vector<float> own = own_spread();
  std::vector<float> result(own.size());
  const auto at = [&](int x, int y) -> std::size_t {
    return std::size_t(y) * std::size_t(width_) + std::size_t(x);
  };
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      // Edges that the pixel lies on go through two of the eight.
      float most = 0.0f, sum = 0.0f;
      int count = 0;
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height_ - 1); ++j) {
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width_ - 1); ++i) {
          if (i == x && j == y) continue;
          most = std::max(most, own[at(i, j)]);
          sum += own[at(i, j)];
          ++count;
        }
      }
      const float around =
          count > 0 ? 0.5f * (most + sum / static_cast<float>(count)) : own[at(x, y)];
      result[at(x, y)] = std::sqrt(around);
    }
  }
  return result;
}

Framebuffer Film::resolve(const V3d& origin) const {
  Framebuffer result;
  result.width = width_;
  result.height = height_;
  const std::size_t n = pixels_.size();
  for (std::vector<Color>& term : result.terms) term.resize(n, Color(0.0f));
  result.albedo.resize(n, Color(0.0f));
  result.normal.resize(n, V3f(0.0f));
  result.position.resize(n, V3f(0.0f));
  result.depth.resize(n);
  result.object.resize(n);
  result.samples.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const PixelSums& p = pixels_[i];
    const float scale = p.samples > 0 ? 1.0f / static_cast<float>(p.samples) : 0.0f;
    for (std::size_t t = 0; t < term_count; ++t) result.terms[t][i] = mean(i, t);
    result.albedo[i] = p.albedo * scale;
    result.normal[i] = p.normal * scale;
    result.position[i] = p.object >= 0 ? V3f(V3d(p.position) + origin) : V3f(0.0f);
    result.depth[i] = p.depth;
    result.object[i] = p.object;
    result.samples[i] = p.samples;
  }
  return result;
}

}  // namespace lumivec
