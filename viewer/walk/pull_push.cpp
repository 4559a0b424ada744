#include "viewer/walk/pull_push.h"

#include <algorithm>
#include <cstddef>

namespace lumivec {
namespace {

struct Level {
  int width = 0, height = 0;
  std::vector<Color> pixels;   // means of what is known
  std::vector<float> weights;  // [0, 1]: how much is known

  Level(int w, int h)
      : width(w),
        height(h),
        pixels(std::size_t(w) * std::size_t(h), Color(0.0f)),
        weights(pixels.size(), 0.0f) {}

  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(std::clamp(y, 0, height - 1)) *
               static_cast<std::size_t>(width) +
           static_cast<std::size_t>(std::clamp(x, 0, width - 1));
  }
};

Level half_of(const Level& fine) {
  Level coarse((fine.width + 1) / 2, (fine.height + 1) / 2);
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) {
      Color sum(0.0f);
      float weight = 0.0f;
      for (int k = 0; k < 4; ++k) {
        const int fx = 2 * x + (k & 1), fy = 2 * y + (k >> 1);
        if (fx >= fine.width || fy >= fine.height) continue;
        const std::size_t i = fine.at(fx, fy);
        sum += fine.pixels[i] * fine.weights[i];
        weight += fine.weights[i];
      }
      const std::size_t i = coarse.at(x, y);
      if (weight > 0.0f) coarse.pixels[i] = sum * (1.0f / weight);
      coarse.weights[i] = std::min(1.0f, weight);
    }
  }
  return coarse;
}

// Between the four pixels of the coarse level around the middle of pixel (x, y).
Color between(const Level& coarse, int x, int y) {
  constexpr float near = 0.75f, far = 0.25f;
  const int cx = x / 2, cy = y / 2, dx = x % 2 == 0 ? -1 : 1, dy = y % 2 == 0 ? -1 : 1;
  return (coarse.pixels[coarse.at(cx, cy)] * near + coarse.pixels[coarse.at(cx + dx, cy)] * far) *
             near +
         (coarse.pixels[coarse.at(cx, cy + dy)] * near +
          coarse.pixels[coarse.at(cx + dx, cy + dy)] * far) *
             far;
}

void fill(Level& fine, const Level& coarse) {
  for (int y = 0; y < fine.height; ++y) {
    for (int x = 0; x < fine.width; ++x) {
      const std::size_t i = fine.at(x, y);
      const float w = fine.weights[i];
      if (w < 1.0f) fine.pixels[i] = fine.pixels[i] * w + between(coarse, x, y) * (1.0f - w);
    }
  }
}

}  // namespace

void pull_push(int width, int height, const std::vector<std::uint8_t>& known,
               std::vector<Color>& pixels) {
  std::vector<Level> levels;
  levels.emplace_back(width, height);
  Level& finest = levels.front();
  bool gaps = false;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    finest.weights[i] = known[i] != 0 ? 1.0f : 0.0f;
    finest.pixels[i] = known[i] != 0 ? pixels[i] : Color(0.0f);
    gaps = gaps || known[i] == 0;
  }
  if (!gaps) return;
  while (levels.back().width > 1 || levels.back().height > 1)
    levels.push_back(half_of(levels.back()));
  for (std::size_t i = levels.size() - 1; i-- > 0;) fill(levels[i], levels[i + 1]);
  std::swap(pixels, levels.front().pixels);
}

}  // namespace lumivec
