#include "viewer/window/surface_view.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "viewer/exposure.h"
#include "viewer/heat_colors.h"

namespace lumivec {
namespace {

// Neighbouring numbers get colours far apart: hues by the golden ratio.
Color object_color(std::int32_t object) {
  constexpr float golden = 0.618034f;
  const float hue = std::fmod(float(object + 1) * golden, 1.0f);
  const auto channel = [hue](float shift) {
    const float place = std::fmod(hue + shift, 1.0f) * 6.0f;
    return 0.25f + 0.65f * std::clamp(std::abs(place - 3.0f) - 1.0f, 0.0f, 1.0f);
  };
  return Color(channel(0.0f), channel(2.0f / 3.0f), channel(1.0f / 3.0f));
}

}  // namespace

Picture surface_picture(const VisibleSurfaces& seen, int width, int height, Layer layer) {
  Picture picture(width, height);
  assert(seen.size() == picture.pixels.size());
  float least = VisibleSurfaces::nothing, most = 0.0f;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen.object[i] < 0 || !(seen.depth[i] > 0.0f)) continue;
    least = std::min(least, seen.depth[i]);
    most = std::max(most, seen.depth[i]);
  }
  const float range = most > least ? std::log(most / least) : 1.0f;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen.object[i] < 0) continue;
    Color& c = picture.pixels[i];
    if (layer == Layer::objects) {
      c = object_color(seen.object[i]);
    } else if (layer == Layer::normals) {
      const V3f n = unpack_normal(seen.normal[i]);
      c = Color(0.5f + 0.5f * n.x, 0.5f + 0.5f * n.y, 0.5f + 0.5f * n.z);
    } else if (layer == Layer::depth) {
      const float share = std::log(std::max(seen.depth[i], least) / least) / range;
      c = Color(1.0f - 0.9f * share);
    }
  }
  return picture;
}

Picture error_picture(const std::vector<Color>& picture, const std::vector<Color>& reference,
                      int width, int height) {
  assert(picture.size() == reference.size());
  double mean = 0.0;
  std::size_t finite = 0;
  for (const Color& c : reference) {
    const float bright = luminance(c);
    if (!std::isfinite(bright)) continue;
    mean += double(bright);
    ++finite;
  }
  mean /= double(std::max<std::size_t>(finite, 1));
  const auto floor = float(std::max(mean * 1e-3, 1e-30));
  std::vector<float> values(picture.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float expected = luminance(reference[i]);
    const float error = std::abs(luminance(picture[i]) - expected) / (expected + floor);
    if (!std::isfinite(expected)) continue;  // nothing is known there
    values[i] = std::isfinite(error) ? error / most_shown_error : 1.0f;
  }
  return heat_picture(values, width, height);
}

}  // namespace lumivec
