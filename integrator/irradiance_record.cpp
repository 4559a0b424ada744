#include "integrator/irradiance_record.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace lumivec {

// With a the sky's irradiance, its vector is a n and its flux 2 a; the source has the rest of the
// vector, d = D − a n, and |d| = Φ − 2 a must be its flux. That is the quadratic
//   3 a² − (4 Φ − 2 D·n) a + Φ² − |D|² = 0,
// of which the smaller root is the sky. It is kept between 0 and D·n, so that the source does not
// come from below.
SkyAndSource split_light(const LightSum& sum, const V3f& sky_normal) {
  SkyAndSource result;
  V3f mean(0.0f);
  for (std::size_t c = 0; c < 3; ++c) {
    const int channel = static_cast<int>(c);
    const V3f& d = sum.vector[c];
    const float flux = sum.flux[channel], up = d.dot(sky_normal);
    result.direction[c] = sky_normal;
    if (!(flux > 0.0f) || !(up > 0.0f)) continue;
    const float half = 2.0f * flux - up;
    const float discriminant = half * half - 3.0f * (flux * flux - d.length2());
    const float root = (half - std::sqrt(std::max(0.0f, discriminant))) / 3.0f;
    const float sky = std::clamp(root, 0.0f, up);
    const V3f source = d - sky * sky_normal;
    const float length = source.length();
    result.sky[channel] = sky;
    if (length > 0.0f) {
      result.source[channel] = length;
      result.direction[c] = source / length;
      mean += source;
    }
    assert(std::isfinite(sky) && sky >= 0.0f && std::isfinite(length));
  }
  const float length2 = mean.length2();
  result.mean_direction = length2 > 0.0f ? mean / std::sqrt(length2) : sky_normal;
  return result;
}

}  // namespace lumivec
