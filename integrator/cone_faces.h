// The faces of an icosahedron's levels that a cone of directions touches. They are the same at
// every place of a cache, and are found once a look-up: 0.1 µs for a few degrees.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "integrator/icosahedron.h"

namespace lumivec {

class ConeFaces {
 public:
  // Faces [begin, end) of a level, counted from its first.
  struct Range {
    std::uint16_t begin, end;
  };
  static constexpr std::size_t most_ranges = 24;

  ConeFaces() = default;
  explicit ConeFaces(const DirectionCone& cone);

  const DirectionCone& cone() const { return cone_; }

  // All faces of a level, [0, deepest_face_level], that the cone touches, in ascending order; where
  // they are many, also some beside them. The ranges: begin(level) to end(level).
  void find(int level) {
    while (found_ < level) divide();
  }
  const Range* begin(int level) const { return ranges_[static_cast<std::size_t>(level)].data(); }
  const Range* end(int level) const {
    return begin(level) + counts_[static_cast<std::size_t>(level)];
  }

 private:
  // More faces than this are not looked at one by one: most of them are inside the cone.
  static constexpr std::uint32_t most_faces = 64;

  void divide();

  DirectionCone cone_;
  int found_ = -1;  // the last level that is known
  std::array<std::uint8_t, deepest_face_level + 1> counts_;
  std::array<std::array<Range, most_ranges>, deepest_face_level + 1> ranges_;
};

}  // namespace lumivec
