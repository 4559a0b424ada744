// Light from infinitely far away, importance-sampled by its radiance.
#pragma once

#include <vector>

#include "loader/scene.h"

namespace lumivec {

class EnvironmentLight {
 public:
  // The scene must outlive this. Costs width × height floats.
  explicit EnvironmentLight(const Scene& scene);

  bool black() const { return mean_radiance_ <= 0.0f; }
  // Mean over all directions and channels, cd·m⁻².
  float mean_radiance() const { return mean_radiance_; }

  // Radiance that arrives from a unit direction, cd·m⁻²; bilinear in the map.
  Color radiance(const V3f& direction) const;
  // Density of sample(), sr⁻¹.
  float pdf(const V3f& direction) const;
  V3f sample(const V2f& u, float& pdf) const;
  // The share of sample()'s directions that come from texels where pdf() exceeds density anywhere.
  float share_above(float density) const;

 private:
  V2f map_position(const V3f& direction) const;

  const Image* image_ = nullptr;
  Color scale_;
  float cos_rotation_, sin_rotation_;
  float mean_radiance_ = 0.0f;
  std::vector<float> row_cdf_;     // height + 1
  std::vector<float> column_cdf_;  // height × (width + 1)
};

}  // namespace lumivec
