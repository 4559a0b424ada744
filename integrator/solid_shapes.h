// The families of primitives, each in a file of its own, as solid_leaf.h puts them together: what
// the functions take and give is said there.
#pragma once

#include <limits>

#include "integrator/solid_leaf.h"

namespace lumivec {

// Where a line is inside a convex shape; empty if last < first.
struct Stretch {
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();

  // Keeps low ≤ origin + t · direction ≤ high.
  void cut(double origin, double direction, double low, double high);
};

// What lies in start < t ≤ stop of a stretch.
void add_stretch(const Stretch& stretch, double start, double stop, Crossings& out);

// A Bézier curve's control values: the cubic lies between the least and the greatest.
std::array<double, 4> control_values(const Cubic& cubic);

double value_at(const Cubic& cubic, double s);
double slope_at(const Cubic& cubic, double s);

// Prisms. The curve's bounds are in x and z, with y = 0.
std::vector<Imath::Box3d> prism_boxes(const SolidLeaf& prism);
void prism_crossings(const SolidLeaf& prism, const ElementTree& elements, const Line& line,
                     double start, double stop, Crossings& out);
V3d prism_outward(const SolidLeaf& prism, const Line& line, const Crossing& crossing);

// Lathes and sors.
std::vector<Imath::Box3d> revolution_boxes(const SolidLeaf& leaf);
void revolution_crossings(const SolidLeaf& leaf, const ElementTree& elements, const Line& line,
                          double start, double stop, Crossings& out);
V3d revolution_outward(const SolidLeaf& leaf, const Line& line, const Crossing& crossing);

std::vector<Imath::Box3d> blob_boxes(const SolidLeaf& blob);
void blob_crossings(const SolidLeaf& blob, const ElementTree& elements, const Line& line,
                    double start, double stop, Crossings& out);
V3d blob_outward(const SolidLeaf& blob, const ElementTree& elements, const Line& line, double t);

void superellipsoid_crossings(const SolidLeaf& leaf, const Line& line, double start, double stop,
                              Crossings& out);
V3d superellipsoid_outward(const SolidLeaf& leaf, const V3d& point);

std::vector<Imath::Box3d> sweep_boxes(const SolidLeaf& leaf);
void sweep_crossings(const SolidLeaf& leaf, const ElementTree& elements, const Line& line,
                     double start, double stop, Crossings& out);
V3d sweep_outward(const SolidLeaf& leaf, const Line& line, const Crossing& crossing);

}  // namespace lumivec
