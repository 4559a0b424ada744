// The primitives of solids: where a line crosses their surfaces, and how those are turned. All in
// the primitive's own space and in double precision. Each family has a file of its own; this is the
// door to all.
#pragma once

#include <vector>

#include "integrator/element_tree.h"
#include "loader/scene.h"

namespace lumivec {

// Where a line passes a surface.
struct Crossing {
  double t = 0.0;
  int element = -1;        // of a curve or a sweep; -1: a flat end, or the primitive has none
  double parameter = 0.0;  // s on the element
  bool entering = false;   // into a primitive with a curve; others do not say
  bool hidden = false;     // changes sides, but there is nothing to see
};

// In ascending order, and on which side the line is at its start.
struct Crossings {
  bool inside_at_start = false;
  std::vector<Crossing> list;

  void clear() {
    inside_at_start = false;
    list.clear();
  }
  void add(double t, bool hidden = false) { list.push_back({t, -1, 0.0, false, hidden}); }
};

// What find_crossings needs of a leaf; empty for those without elements.
ElementTree elements_of(const SolidLeaf& leaf);

// Crossings in start < t ≤ stop; both finite. At t = start the line is inside as said. out keeps
// its memory from call to call.
void find_crossings(const SolidLeaf& leaf, const ElementTree& elements, const Line& line,
                    double start, double stop, Crossings& out);

// Of the surface at a crossing, outward, of any length; 0 where it has no direction.
V3d outward_at(const SolidLeaf& leaf, const ElementTree& elements, const Line& line,
               const Crossing& crossing);

}  // namespace lumivec
