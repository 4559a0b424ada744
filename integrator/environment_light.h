// Light from infinitely far away, importance-sampled by its radiance.
#pragma once

#include <limits>
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
  // Radiance is the sum of an even part, which stays below a level, and of peaks above it: a sun,
  // lamps. The level is where the even part's standard deviation over all directions is half its
  // mean. The share of peaks in radiance() of some direction, [0, 1):
  float peak_share(const Color& radiance) const;
  bool has_peaks() const { return level_ < std::numeric_limits<float>::infinity(); }
  // Density of sample(), sr⁻¹.
  float pdf(const V3f& direction) const;
  V3f sample(const V2f& u, float& pdf) const;
  // The share of sample()'s directions that come from texels where pdf() exceeds density anywhere.
  float share_above(float density) const;

 private:
  V2f map_position(const V3f& direction) const;
  void find_level();

  const Image* image_ = nullptr;
  Color scale_;
  float cos_rotation_, sin_rotation_;
  float mean_radiance_ = 0.0f;
  float level_ = std::numeric_limits<float>::infinity();  // mean over channels, cd·m⁻²
  std::vector<float> row_cdf_;                            // height + 1
  std::vector<float> column_cdf_;                         // height × (width + 1)
};

}  // namespace lumivec
