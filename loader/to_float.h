// Numbers of files and formulas as the scene holds them.
#pragma once

#include <algorithm>
#include <limits>

namespace lumivec {

// x as a float, with what float cannot hold brought to its largest finite value.
inline float to_float(double x) {
  constexpr double largest = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -largest, largest));
}

}  // namespace lumivec
