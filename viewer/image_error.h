// How far one picture is from another, in numbers: RMSE, relMSE, mean absolute error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "viewer/picture.h"

namespace lumivec {

// Means over pixels and channels, pixels that are not finite in either picture left out; NaN if
// none is left.
struct ImageError {
  double rmse = 0.0;
  double relmse = 0.0;  // mean((a − b)² / (b² + 0.01)), b the reference
  double mean_absolute = 0.0;
  std::size_t pixels = 0;  // that were compared
};

// test and reference have the same size (asserted); values of any kind.
ImageError image_error(const Picture& test, const Picture& reference);

// Pixels that are not finite, row by row from the top.
struct NonFinite {
  std::size_t count = 0;
  int first_x = 0;  // of the first one, if there is one
  int first_y = 0;
};
NonFinite find_non_finite(const Picture& picture);

}  // namespace lumivec
