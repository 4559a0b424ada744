// Convolution of a plane of numbers by a product of two one-dimensional kernels.
#pragma once

#include <cstddef>
#include <vector>

namespace lumivec {

struct Plane {
  int width = 0;
  int height = 0;
  std::vector<float> values;  // width × height

  Plane() = default;
  Plane(int w, int h) : width(w), height(h), values(std::size_t(w) * std::size_t(h)) {}
};

// f at -radius … radius.
template <typename Function>
std::vector<float> sampled_kernel(int radius, const Function& f) {
  std::vector<float> kernel;
  for (int x = -radius; x <= radius; ++x) kernel.push_back(f(float(x)));
  return kernel;
}

// Scales the positive weights to a sum of 1 and the negative ones to -1; either kind may be
// missing.
void normalize_signs(std::vector<float>& kernel);

// Kernels of odd length, centred; across runs along rows, down along columns. Beyond the border the
// plane goes on with the values at the border. O(width · height · kernel length) time; rows run in
// parallel.
Plane convolved(const Plane& plane, const std::vector<float>& across,
                const std::vector<float>& down);

}  // namespace lumivec
