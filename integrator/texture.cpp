#include "integrator/texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace lumivec {
namespace {

float srgb_to_linear(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

const std::array<float, 256>& srgb_table() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (int i = 0; i < 256; ++i)
      t[std::size_t(i)] = srgb_to_linear(static_cast<float>(i) / 255.0f);
    return t;
  }();
  return table;
}

// Texel index for any integer position.
int wrap_index(int i, int size, Wrap wrap) {
  switch (wrap) {
    case Wrap::clamp_to_edge:
      return std::clamp(i, 0, size - 1);
    case Wrap::mirrored_repeat: {
      const int period = 2 * size;
      const int j = ((i % period) + period) % period;
      return j < size ? j : period - 1 - j;
    }
    case Wrap::repeat:
      break;
  }
  return ((i % size) + size) % size;
}

V4f texel(const Image& image, Encoding encoding, int x, int y) {
  const std::size_t offset = 4 * (std::size_t(y) * std::size_t(image.width) + std::size_t(x));
  if (!image.rgba8.empty()) {
    const std::uint8_t* p = image.rgba8.data() + offset;
    if (encoding == Encoding::srgb) {
      const std::array<float, 256>& table = srgb_table();
      return {table[p[0]], table[p[1]], table[p[2]], static_cast<float>(p[3]) / 255.0f};
    }
    constexpr float scale = 1.0f / 255.0f;
    return V4f(static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2]),
               static_cast<float>(p[3])) *
           scale;
  }
  const float* p = image.rgba32f.data() + offset;
  if (encoding == Encoding::srgb) {
    return {srgb_to_linear(p[0]), srgb_to_linear(p[1]), srgb_to_linear(p[2]), p[3]};
  }
  return {p[0], p[1], p[2], p[3]};
}

// Brings a coordinate near zero so that its conversion to an integer cannot overflow; all wraps
// have period 2.
float reduce(float coordinate, Wrap wrap) {
  if (!std::isfinite(coordinate)) return 0.0f;
  if (wrap == Wrap::clamp_to_edge) return std::clamp(coordinate, -1.0f, 2.0f);
  return coordinate - 2.0f * std::floor(0.5f * coordinate);
}

}  // namespace

V4f sample_texture(const Scene& scene, const TextureMap& map, const V2f& uv) {
  if (map.image < 0) return V4f(1.0f);
  const Image& image = scene.images[std::size_t(map.image)];
  const M33f& m = map.uv_transform;
  const float u = reduce(uv.x * m[0][0] + uv.y * m[1][0] + m[2][0], map.wrap_u);
  const float v = reduce(uv.x * m[0][1] + uv.y * m[1][1] + m[2][1], map.wrap_v);
  const float x = u * static_cast<float>(image.width);
  const float y = v * static_cast<float>(image.height);
  if (map.filter == Filter::nearest) {
    return texel(image, map.encoding,
                 wrap_index(static_cast<int>(std::floor(x)), image.width, map.wrap_u),
                 wrap_index(static_cast<int>(std::floor(y)), image.height, map.wrap_v));
  }
  const float left = std::floor(x - 0.5f);
  const float top = std::floor(y - 0.5f);
  const float fx = x - 0.5f - left;
  const float fy = y - 0.5f - top;
  const int x0 = wrap_index(static_cast<int>(left), image.width, map.wrap_u);
  const int x1 = wrap_index(static_cast<int>(left) + 1, image.width, map.wrap_u);
  const int y0 = wrap_index(static_cast<int>(top), image.height, map.wrap_v);
  const int y1 = wrap_index(static_cast<int>(top) + 1, image.height, map.wrap_v);
  const V4f upper =
      texel(image, map.encoding, x0, y0) * (1.0f - fx) + texel(image, map.encoding, x1, y0) * fx;
  const V4f lower =
      texel(image, map.encoding, x0, y1) * (1.0f - fx) + texel(image, map.encoding, x1, y1) * fx;
  return upper * (1.0f - fy) + lower * fy;
}

}  // namespace lumivec
