// Prisms: a plane curve swept along y, or toward the origin.
//
// The plane through the line and the direction of the sweep (or its apex) cuts the curve's plane in
// a line, and each stretch of the curve crosses that where a cubic is 0. Sides are told by counting
// from where the line is surely outside.
#include <algorithm>
#include <cmath>

#include "integrator/solid_curve_roots.h"
#include "integrator/solid_shapes.h"

namespace lumivec {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// a u + b v + c = 0, in the curve's plane.
struct PlaneLine {
  double a = 0.0, b = 0.0, c = 0.0;
  double operator()(double u, double v) const { return a * u + b * v + c; }
};

// Calls visit(element, s) for each crossing of the curve.
template <class Visit>
void cross_curve(const SolidLeaf& prism, const ElementTree& elements, const PlaneLine& across,
                 const Visit& visit) {
  const double square = across.a * across.a + across.b * across.b;
  if (!(square > 0.0) || !std::isfinite(square) || !std::isfinite(across.c)) return;
  const double away = -across.c / square;
  const Line in_plane{V3d(across.a * away, 0.0, across.b * away), V3d(-across.b, 0.0, across.a)};
  elements.along(in_plane, -infinity, infinity, [&](int element) {
    const CurvePiece& piece = prism.curve[std::size_t(element)];
    const double from = across(piece.u[0], piece.v[0]);
    const double to = across(piece.end[0], piece.end[1]);
    Polynomial f;
    f.degree = 3;
    for (std::size_t i = 0; i < 4; ++i) f.c[i] = across.a * piece.u[i] + across.b * piece.v[i];
    f.c[0] = from;
    const Roots roots = sign_changes(f, from, to);
    for (int i = 0; i < roots.count; ++i) visit(element, roots.x[std::size_t(i)]);
  });
}

bool is_within(const SolidLeaf& prism, const ElementTree& elements, double u, double v) {
  bool inside = false;
  cross_curve(prism, elements, {0.0, 1.0, -v}, [&](int element, double s) {
    if (value_at(prism.curve[std::size_t(element)].u, s) > u) inside = !inside;
  });
  return inside;
}

// The crossings of all of the line with the endless sides, ascending.
void sides(const SolidLeaf& prism, const ElementTree& elements, const Line& line,
           const PlaneLine& across, std::vector<Crossing>& out) {
  const V3d &o = line.origin, &d = line.direction;
  cross_curve(prism, elements, across, [&](int element, double s) {
    const CurvePiece& piece = prism.curve[std::size_t(element)];
    const double u = value_at(piece.u, s), v = value_at(piece.v, s);
    // The point of the line that is nearest to the side's.
    const double size = prism.conic ? o.y : 1.0, growth = prism.conic ? d.y : 0.0;
    const double x = d.x - growth * u, z = d.z - growth * v;
    const double t = ((size * u - o.x) * x + (size * v - o.z) * z) / (x * x + z * z);
    if (!std::isnan(t)) out.push_back({t, element, s, false, false});
  });
  std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.t < b.t; });
}

}  // namespace

std::vector<Imath::Box3d> prism_boxes(const SolidLeaf& prism) {
  std::vector<Imath::Box3d> boxes;
  for (const CurvePiece& piece : prism.curve) {
    Imath::Box3d box;
    const auto u = control_values(piece.u), v = control_values(piece.v);
    for (std::size_t i = 0; i < 4; ++i) box.extendBy(V3d(u[i], 0.0, v[i]));
    boxes.push_back(box);
  }
  return boxes;
}

void prism_crossings(const SolidLeaf& prism, const ElementTree& elements, const Line& line,
                     double start, double stop, Crossings& out) {
  const V3d &o = line.origin, &d = line.direction;
  Stretch slab;
  slab.cut(o.y, d.y, prism.low, prism.high);
  if (!(slab.first < slab.last) || slab.first > stop || slab.last < start) return;
  PlaneLine across{d.z, -d.x, d.x * o.z - d.z * o.x};
  if (prism.conic) {
    const V3d normal = o.cross(d);
    across = {normal.x, normal.z, normal.y};
  }
  thread_local std::vector<Crossing> crossed;
  crossed.clear();
  bool inside = false;
  if (across.a == 0.0 && across.b == 0.0) {
    // Along the sweep.
    inside = prism.conic ? d.y != 0.0 && is_within(prism, elements, d.x / d.y, d.z / d.y)
                         : is_within(prism, elements, o.x, o.z);
  } else {
    sides(prism, elements, line, across, crossed);
    // Endless cones are surely not around the line where it is as high as their apex.
    const double outside = prism.conic && d.y != 0.0 ? -o.y / d.y : -infinity;
    for (const Crossing& side : crossed) {
      if ((side.t <= slab.first) != (side.t <= outside)) inside = !inside;
    }
  }
  const auto pass = [&](Crossing crossing) {
    crossing.entering = inside = !inside;
    if (crossing.t <= start) {
      out.inside_at_start = inside;
    } else if (crossing.t <= stop) {
      out.list.push_back(crossing);
    }
  };
  if (inside) {
    inside = false;
    pass({slab.first, -1, 0.0, false, prism.open});
  }
  for (const Crossing& side : crossed) {
    if (side.t > slab.first && side.t < slab.last) pass(side);
  }
  if (inside) pass({slab.last, -1, 0.0, false, prism.open});
}

V3d prism_outward(const SolidLeaf& prism, const Line& line, const Crossing& crossing) {
  V3d normal(0.0, 1.0, 0.0);
  if (crossing.element >= 0) {
    const CurvePiece& piece = prism.curve[std::size_t(crossing.element)];
    const double s = crossing.parameter;
    V3d along(slope_at(piece.u, s), 0.0, slope_at(piece.v, s));
    // Where control points coincide, the curve turns as it does a little farther on.
    constexpr double farther = 1e-5;
    if (along.length2() == 0.0) {
      const double near = s < 0.5 ? s + farther : s - farther;
      along = V3d(slope_at(piece.u, near), 0.0, slope_at(piece.v, near));
    }
    const V3d sweep =
        prism.conic ? V3d(value_at(piece.u, s), 1.0, value_at(piece.v, s)) : V3d(0.0, 1.0, 0.0);
    normal = sweep.cross(along);
  }
  return (normal.dot(line.direction) < 0.0) == crossing.entering ? normal : -normal;
}

}  // namespace lumivec
