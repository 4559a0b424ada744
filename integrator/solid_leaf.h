// The primitives of solids: where a line crosses their surfaces, and how those are turned. All in
// the primitive's own space and in double precision.
#pragma once

#include <array>

#include "integrator/polynomial_roots.h"
#include "loader/scene.h"

namespace lumivec {

struct Line {
  V3d origin{0.0};
  V3d direction{0.0};  // of any length but 0
};

// Where a line passes a surface, ascending, and on which side it is at the first.
struct Crossings {
  bool inside_at_start = false;
  std::array<double, max_polynomial_degree> t{};
  int count = 0;
};

// Crossings in start < t ≤ stop; both finite. At t = start the line is inside as said.
Crossings crossings(const SolidLeaf& leaf, const Line& line, double start, double stop);

// A function of the point that is 0 on the surface next to it and grows outward, and its gradient.
struct LeafField {
  double value = 0.0;
  V3d gradient{0.0};
};
LeafField field(const SolidLeaf& leaf, const V3d& point);

}  // namespace lumivec
