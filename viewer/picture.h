// An RGB picture in memory, scene-linear Rec. 709 or displayed: the functions that take it say
// which.
#pragma once

#include <cstddef>
#include <vector>

#include "loader/scene.h"

namespace lumivec {

struct Picture {
  int width = 0;              // pixels
  int height = 0;             // pixels
  std::vector<Color> pixels;  // width × height, row 0 at the top

  Picture() = default;
  Picture(int w, int h, Color fill = Color(0.0f))
      : width(w), height(h), pixels(std::size_t(w) * std::size_t(h), fill) {}
};

}  // namespace lumivec
