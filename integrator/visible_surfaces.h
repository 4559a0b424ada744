// What the eye sees through the middles of all pixels: enough to know a surface again in the next
// view.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "loader/scene.h"

namespace lumivec {

// A direction in three signed bytes, least significant first: less than half a degree off.
constexpr int normal_scale = 127;
inline std::uint32_t pack_normal(const V3f& unit) {
  const auto byte = [](float x) {
    const float scaled = std::clamp(x, -1.0f, 1.0f) * static_cast<float>(normal_scale);
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::rint(scaled))) & 0xffu;
  };
  return byte(unit.x) | byte(unit.y) << 8 | byte(unit.z) << 16;
}
// Axis 0 to 2, times normal_scale.
inline std::int32_t packed_component(std::uint32_t normal, unsigned axis) {
  return static_cast<std::int32_t>(normal << (24 - 8 * axis)) >> 24;
}
inline V3f unpack_normal(std::uint32_t normal) {
  return V3f(static_cast<float>(packed_component(normal, 0)),
             static_cast<float>(packed_component(normal, 1)),
             static_cast<float>(packed_component(normal, 2))) *
         (1.0f / static_cast<float>(normal_scale));
}

// Normals of one surface at neighbouring pixels differ by less than about 25°.
constexpr float least_normal_cosine = 0.9f;
constexpr auto least_normal_product =
    static_cast<std::int32_t>(least_normal_cosine * normal_scale * normal_scale);
inline bool normals_alike(std::uint32_t a, std::uint32_t b) {
  return packed_component(a, 0) * packed_component(b, 0) +
             packed_component(a, 1) * packed_component(b, 1) +
             packed_component(a, 2) * packed_component(b, 2) >=
         least_normal_product;
}

// How far from the first hit what its specular lobe shows is, as an inverse (in optics, a
// vergence), scene units⁻¹; 0: infinitely far.
constexpr float shows_nothing = -1.0f;        // no such lobe was followed
constexpr float shows_by_refraction = -2.0f;  // not where a mirror would show it

// Row by row.
struct VisibleSurfaces {
  static constexpr float nothing = std::numeric_limits<float>::infinity();
  static constexpr std::int32_t unknown = -2;  // an object, where nobody has looked

  std::vector<float> depth;           // along the view axis, scene units; nothing: nothing
  std::vector<std::uint32_t> normal;  // packed, geometric, on the eye's side
  std::vector<std::int32_t> object;   // index into Scene::instances; -1: nothing

  std::size_t size() const { return object.size(); }
  void resize(std::size_t pixels) {
    depth.resize(pixels);
    normal.resize(pixels);
    object.resize(pixels);
  }
};

}  // namespace lumivec
