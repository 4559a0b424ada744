// Loops over the rows of a picture.
#pragma once

#include "integrator/parallel.h"

namespace lumivec {

// body(y) for y in [0, height), on all threads.
template <typename Body>
void for_each_row(int height, const Body& body) {
  constexpr std::size_t rows_at_once = 8;
  for_each_in_groups(static_cast<std::size_t>(height), rows_at_once,
                     [&](std::size_t y) { body(static_cast<int>(y)); });
}

}  // namespace lumivec
