#include "viewer/window/histogram.h"

#include <cmath>

#include "viewer/exposure.h"
#include "viewer/window/false_color.h"

namespace lumivec {

Histogram histogram(const std::vector<Color>& radiance, int width, double exposure, int stride) {
  Histogram result;
  if (width <= 0) return result;
  const auto scale = float(std::exp2(exposure)) / middle_gray;
  const auto bin = [&](float value) {
    return int(std::floor((std::log2(value * scale) - Histogram::first_stop) *
                          float(Histogram::bins_per_stop)));
  };
  const int height = int(radiance.size() / std::size_t(width));
  for (int y = 0; y < height; y += stride) {
    for (int x = 0; x < width; x += stride) {
      const Color& c = radiance[std::size_t(y) * std::size_t(width) + std::size_t(x)];
      const float bright = luminance(c);
      if (!std::isfinite(bright)) {
        ++result.not_finite;
        continue;
      }
      const std::array<float, 4> values = {bright, c.x, c.y, c.z};
      for (std::size_t i = 0; i < values.size(); ++i) {
        if (!(values[i] > 0.0f)) {
          if (i == 0) ++result.black;
          continue;
        }
        const int place = bin(values[i]);
        if (place < 0) {
          if (i == 0) ++result.below;
        } else if (place >= Histogram::bin_count) {
          if (i == 0) ++result.above;
        } else {
          ++result.counts[i][std::size_t(place)];
        }
      }
    }
  }
  for (auto& counts : result.counts) {
    for (float& n : counts) n = std::log10(1.0f + n);
  }
  return result;
}

std::array<double, term_count> term_shares(
    const std::array<std::vector<Color>, term_count>& layers) {
  std::array<double, term_count> shares{};
  double all = 0.0;
  for (std::size_t t = 0; t < layers.size(); ++t) {
    for (const Color& c : layers[t]) {
      const float bright = luminance(c);
      if (std::isfinite(bright)) shares[t] += double(bright);
    }
    all += shares[t];
  }
  for (double& share : shares) share = all > 0.0 ? share / all : 0.0;
  return shares;
}

}  // namespace lumivec
