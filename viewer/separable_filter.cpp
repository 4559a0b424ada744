#include "viewer/separable_filter.h"

#include <algorithm>
#include <cassert>

#include "viewer/rows.h"

namespace lumivec {
namespace {

Plane convolved_across(const Plane& plane, const std::vector<float>& kernel) {
  const int radius = int(kernel.size() / 2);
  Plane result(plane.width, plane.height);
  for_each_row(plane.height, [&](int y) {
    const float* row = plane.values.data() + std::size_t(y) * std::size_t(plane.width);
    float* out = result.values.data() + std::size_t(y) * std::size_t(plane.width);
    std::vector<float> padded(std::size_t(plane.width + 2 * radius));
    for (int x = -radius; x < plane.width + radius; ++x) {
      padded[std::size_t(x + radius)] = row[std::clamp(x, 0, plane.width - 1)];
    }
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const float* shifted = padded.data() + k;
      for (int x = 0; x < plane.width; ++x) out[x] += kernel[kernel.size() - 1 - k] * shifted[x];
    }
  });
  return result;
}

Plane convolved_down(const Plane& plane, const std::vector<float>& kernel) {
  const int radius = int(kernel.size() / 2);
  Plane result(plane.width, plane.height);
  for_each_row(plane.height, [&](int y) {
    float* out = result.values.data() + std::size_t(y) * std::size_t(plane.width);
    for (std::size_t k = 0; k < kernel.size(); ++k) {
      const int source = std::clamp(y + int(k) - radius, 0, plane.height - 1);
      const float* row = plane.values.data() + std::size_t(source) * std::size_t(plane.width);
      const float weight = kernel[kernel.size() - 1 - k];
      for (int x = 0; x < plane.width; ++x) out[x] += weight * row[x];
    }
  });
  return result;
}

}  // namespace

void normalize_signs(std::vector<float>& kernel) {
  float positive = 0.0f, negative = 0.0f;
  for (float k : kernel) (k > 0.0f ? positive : negative) += k;
  for (float& k : kernel) {
    if (k > 0.0f) k /= positive;
    if (k < 0.0f) k /= -negative;
  }
}

Plane convolved(const Plane& plane, const std::vector<float>& across,
                const std::vector<float>& down) {
  assert(across.size() % 2 == 1 && down.size() % 2 == 1);
  if (plane.values.empty()) return plane;
  return convolved_down(convolved_across(plane, across), down);
}

}  // namespace lumivec
