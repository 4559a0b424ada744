// Pixel reconstruction by filter importance sampling: sample positions are distributed as the
// filter, so each sample belongs to one pixel with weight one. Source: Ernst, Stamminger and
// Greiner 2006.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "integrator/settings.h"
#include "loader/scene.h"

namespace lumivec {

class PixelFilterSampler {
 public:
  explicit PixelFilterSampler(PixelFilter filter);

  // Calls visit(x, y, weight) for every pixel whose filter covers position (pixels from the upper
  // left corner), with the value of the filter there: what one light path's contribution at
  // position adds to the pixel.
  template <typename Visit>
  void for_each_pixel(const V2f& position, int width, int height, const Visit& visit) const {
    if (box_) {
      visit(std::min(static_cast<int>(position.x), width - 1),
            std::min(static_cast<int>(position.y), height - 1), 1.0f);
      return;
    }
    const int x0 = std::max(static_cast<int>(std::ceil(position.x - 0.5f - radius_)), 0);
    const int x1 = std::min(static_cast<int>(std::floor(position.x - 0.5f + radius_)), width - 1);
    const int y0 = std::max(static_cast<int>(std::ceil(position.y - 0.5f - radius_)), 0);
    const int y1 = std::min(static_cast<int>(std::floor(position.y - 0.5f + radius_)), height - 1);
    for (int y = y0; y <= y1; ++y) {
      const float row = density(position.y - 0.5f - static_cast<float>(y));
      for (int x = x0; x <= x1; ++x)
        visit(x, y, row * density(position.x - 0.5f - static_cast<float>(x)));
    }
  }

  // Offset from the pixel's centre in pixels, distributed as the filter; u in [0, 1)².
  V2f offset(const V2f& u) const { return {offset(u.x), offset(u.y)}; }

 private:
  float offset(float u) const;
  // The filter's value at a distance in pixels; integrates to 1.
  float density(float x) const;

  static constexpr int table_size = 256;
  bool box_ = true;
  PixelFilter filter_;
  float radius_ = 0.5f;
  float scale_ = 1.0f;  // of the filter's formula, to make it integrate to 1
  std::array<float, table_size + 1> inverse_cdf_{};  // offset at equal steps of probability
};

}  // namespace lumivec
