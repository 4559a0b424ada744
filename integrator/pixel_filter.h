// Pixel reconstruction by filter importance sampling: sample positions are distributed as the
// filter, so each sample belongs to one pixel with weight one. Source: Ernst, Stamminger and
// Greiner 2006.
#pragma once

#include <array>

#include "integrator/settings.h"
#include "loader/scene.h"

namespace lumivec {

class PixelFilterSampler {
 public:
  explicit PixelFilterSampler(PixelFilter filter);

  // Offset from the pixel's centre in pixels, distributed as the filter; u in [0, 1)².
  V2f offset(const V2f& u) const { return {offset(u.x), offset(u.y)}; }

 private:
  float offset(float u) const;

  static constexpr int table_size = 256;
  bool box_ = true;
  std::array<float, table_size + 1> inverse_cdf_{};  // offset at equal steps of probability
};

}  // namespace lumivec
