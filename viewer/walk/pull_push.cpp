#include "viewer/walk/pull_push.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace lumivec {
namespace {

template <typename Body>
void for_each_row(int height, const Body& body) {
  constexpr int grain = 16;
  tbb::parallel_for(tbb::blocked_range<int>(0, height, grain),
                    [&](const tbb::blocked_range<int>& r) {
                      for (int y = r.begin(); y < r.end(); ++y) body(y);
                    });
}

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

// weight_of(i): how much is known of pixel i of the finer picture.
template <typename WeightOf>
Level half_of(int width, int height, const std::vector<Color>& pixels, const WeightOf& weight_of) {
  Level coarse((width + 1) / 2, (height + 1) / 2);
  for_each_row(coarse.height, [&](int y) {
    for (int x = 0; x < coarse.width; ++x) {
      Color sum(0.0f);
      float weight = 0.0f;
      for (int fy = 2 * y; fy < std::min(2 * y + 2, height); ++fy) {
        for (int fx = 2 * x; fx < std::min(2 * x + 2, width); ++fx) {
          const std::size_t i = std::size_t(fy) * std::size_t(width) + std::size_t(fx);
          const float w = weight_of(i);
          sum += pixels[i] * w;
          weight += w;
        }
      }
      const std::size_t i = coarse.at(x, y);
      if (weight > 0.0f) coarse.pixels[i] = sum * (1.0f / weight);
      coarse.weights[i] = std::min(1.0f, weight);
    }
  });
  return coarse;
}

Level half_of(const Level& fine) {
  return half_of(fine.width, fine.height, fine.pixels,
                 [&](std::size_t i) { return fine.weights[i]; });
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
  for_each_row(fine.height, [&](int y) {
    for (int x = 0; x < fine.width; ++x) {
      const std::size_t i = fine.at(x, y);
      const float w = fine.weights[i];
      if (w < 1.0f) fine.pixels[i] = fine.pixels[i] * w + between(coarse, x, y) * (1.0f - w);
    }
  });
}

}  // namespace

void pull_push(int width, int height, const std::vector<std::uint8_t>& known,
               std::vector<Color>& pixels) {
  std::vector<Level> levels;
  const auto weight_of = [&](std::size_t i) { return known[i] != 0 ? 1.0f : 0.0f; };
  levels.push_back(half_of(width, height, pixels, weight_of));
  while (levels.back().width > 1 || levels.back().height > 1)
    levels.push_back(half_of(levels.back()));
  for (std::size_t i = levels.size() - 1; i-- > 0;) fill(levels[i], levels[i + 1]);
  for_each_row(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = std::size_t(y) * std::size_t(width) + std::size_t(x);
      if (known[i] == 0) pixels[i] = between(levels.front(), x, y);
    }
  });
}

}  // namespace lumivec
