// The volumes that a path is inside of, innermost last: which index of refraction surrounds it, and
// what absorbs.
#pragma once

#include <array>
#include <cmath>

#include "loader/scene.h"

namespace lumivec {

// Beer–Lambert transmittance of a volume over a distance in scene units.
inline Color volume_transmittance(const Material& material, float distance) {
  if (std::isinf(material.attenuation_distance)) return Color(1.0f);
  const float relative = distance / material.attenuation_distance;
  const Color& c = material.attenuation_color;
  return {std::pow(c.x, relative), std::pow(c.y, relative), std::pow(c.z, relative)};
}

class MediumStack {
 public:
  const Material* top() const { return count_ > 0 ? materials_[std::size_t(count_ - 1)] : nullptr; }

  // Index of refraction on the front side of material's boundary, of which the path is on the given
  // side.
  float outside_ior(const Material& material, bool front) const {
    bool left = front;
    for (int i = count_; i-- > 0;) {
      const Material* m = materials_[std::size_t(i)];
      if (!left && m == &material) {  // once: what surrounds it may be of the same material
        left = true;
        continue;
      }
      return m->ior > 0.0f ? m->ior : 1.0f;
    }
    return 1.0f;
  }

  // The path passes material's boundary from the given side. Deeper nesting than max_depth is
  // forgotten.
  void cross(const Material& material, bool front) {
    if (front) {
      if (count_ < max_depth) materials_[std::size_t(count_++)] = &material;
      return;
    }
    for (int i = count_; i-- > 0;) {
      if (materials_[std::size_t(i)] != &material) continue;
      for (int j = i; j + 1 < count_; ++j)
        materials_[std::size_t(j)] = materials_[std::size_t(j + 1)];
      --count_;
      return;
    }
  }

 private:
  static constexpr int max_depth = 4;
  std::array<const Material*, max_depth> materials_{};
  int count_ = 0;
};

}  // namespace lumivec
