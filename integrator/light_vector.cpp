#include "integrator/light_vector.h"

#include <limits>

namespace lumivec {

void LightIntegrals::add(const V3f& wi, const Color& light, const Color& f_cos) {
  const Color out = f_cos * light;
  vector += wi * ((light.x + light.y + light.z) / 3.0f);
  reflected_vector += wi * ((out.x + out.y + out.z) / 3.0f);
  incident += light;
  reflected += out;
}

bool unit_direction(const V3f& v, V3f& unit) {
  // Scaled first: squares of what is far from 1 leave the range of floats.
  const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest >= std::numeric_limits<float>::min())) return false;
  if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
  const V3f scaled(v.x / largest, v.y / largest, v.z / largest);
  unit = scaled / std::sqrt(scaled.length2());
  return true;
}

bool light_vector_magnitude(const LightIntegrals& light, const Color& f_cos, Color& magnitude) {
  Color m(0.0f);
  for (int c = 0; c < 3; ++c) {
    assert(std::isfinite(light.reflected[c]) && light.reflected[c] >= 0.0f);
    assert(std::isfinite(light.incident[c]) && light.incident[c] >= 0.0f);
    // A channel that reflects nothing needs no source, even if f is 0 there.
    if (light.reflected[c] == 0.0f) continue;
    m[c] = light.reflected[c] / f_cos[c];
    // False for infinity and for what is not a number.
    if (!(m[c] <= max_brightening * light.incident[c] && std::isfinite(m[c]))) return false;
  }
  assert(std::min({m.x, m.y, m.z}) >= 0.0f);
  magnitude = m;
  return true;
}

}  // namespace lumivec
