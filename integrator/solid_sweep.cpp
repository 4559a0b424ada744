// Sphere sweeps: all spheres whose centre C(s) and radius r(s) move along cubics.
//
// A line that passes a sphere at the distance c(s) of its centre is inside it between a(s) - √h and
// a(s) + √h, a(s) being where it is nearest and h = r² - c². Where h stays above 0, of degree 6,
// these stretches overlap from one s to the next, so that together they are one stretch. It ends
// where a' = ± h' / (2 √h), a polynomial of degree 10, or where the piece or h > 0 ends.
#include <algorithm>
#include <cmath>

#include "integrator/polynomial_roots.h"
#include "integrator/solid_shapes.h"

namespace lumivec {
namespace {

using Imath::Box3d;

// An end of the stretch where the line is inside, and the sphere that it lies on.
struct End {
  double t = 0.0;
  int element = -1;
  double s = 0.0;
};
struct Inside {
  End first, last;
};

Polynomial trimmed(Polynomial p) {
  while (p.degree > 0 && p.c[std::size_t(p.degree)] == 0.0) --p.degree;
  return p;
}

// The centre's coordinate along an axis, counted from the origin.
Polynomial along(const SweepPiece& piece, const V3d& axis, const V3d& origin) {
  Polynomial p;
  p.degree = 3;
  for (std::size_t i = 0; i < 4; ++i) {
    for (int k = 0; k < 3; ++k) p.c[i] += piece.center[std::size_t(k)][i] * axis[k];
  }
  p.c[0] -= origin.dot(axis);
  return trimmed(p);
}

Polynomial sum(const Polynomial& a, const Polynomial& b, double weight) {
  Polynomial p = a;
  p.degree = std::max(a.degree, b.degree);
  for (int i = 0; i <= b.degree; ++i) p.c[std::size_t(i)] += weight * b.c[std::size_t(i)];
  return trimmed(p);
}

struct Axes {
  V3d along, u, v;
};

Axes axes_of(const V3d& direction) {
  Axes axes;
  axes.along = direction.normalized();
  int least = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(axes.along[i]) < std::abs(axes.along[least])) least = i;
  }
  V3d other(0.0);
  other[least] = 1.0;
  axes.u = axes.along.cross(other).normalized();
  axes.v = axes.along.cross(axes.u);
  return axes;
}

void add_inside(const SweepPiece& piece, int element, const Axes& axes, const V3d& origin,
                std::vector<Inside>& out) {
  const Polynomial a = along(piece, axes.along, origin);
  const Polynomial u = along(piece, axes.u, origin), v = along(piece, axes.v, origin);
  Polynomial r;
  r.degree = 3;
  for (std::size_t i = 0; i < 4; ++i) r.c[i] = piece.radius[i];
  r = trimmed(r);
  const Polynomial h = sum(sum(product(r, r), product(u, u), -1.0), product(v, v), -1.0);
  const Roots ends = roots_between(h, 0.0, 1.0);
  Roots turns, tops;
  bool turns_known = false;
  for (int i = 0; i <= ends.count; ++i) {
    const double low = i > 0 ? ends.x[std::size_t(i - 1)] : 0.0;
    const double high = i < ends.count ? ends.x[std::size_t(i)] : 1.0;
    if (!(h(0.5 * (low + high)) > 0.0)) continue;
    if (!turns_known) {
      const Polynomial da = derivative(a), dh = derivative(h);
      turns =
          roots_between(trimmed(sum(product(dh, dh), product(h, product(da, da)), -4.0)), 0.0, 1.0);
      // Where a does not change the polynomial only touches 0, where h' is 0.
      tops = roots_between(dh, 0.0, 1.0);
      turns_known = true;
    }
    Inside inside;
    inside.first = {std::numeric_limits<double>::infinity(), element, low};
    inside.last = {-std::numeric_limits<double>::infinity(), element, low};
    const auto widen = [&](double s) {
      const double middle = a(s), half = std::sqrt(std::max(h(s), 0.0));
      if (middle - half < inside.first.t) inside.first = {middle - half, element, s};
      if (middle + half > inside.last.t) inside.last = {middle + half, element, s};
    };
    widen(low);
    widen(high);
    for (const Roots* roots : {&turns, &tops}) {
      for (int k = 0; k < roots->count; ++k) {
        const double s = roots->x[std::size_t(k)];
        if (s > low && s < high) widen(s);
      }
    }
    if (inside.first.t < inside.last.t) out.push_back(inside);
  }
}

}  // namespace

std::vector<Box3d> sweep_boxes(const SolidLeaf& leaf) {
  std::vector<Box3d> boxes;
  for (const SweepPiece& piece : leaf.sweep) {
    double radius = 0.0;
    for (const double r : control_values(piece.radius)) radius = std::max(radius, std::abs(r));
    Box3d box;
    for (int i = 0; i < 3; ++i) {
      const auto values = control_values(piece.center[std::size_t(i)]);
      const auto [least, most] = std::minmax_element(values.begin(), values.end());
      box.min[i] = *least - radius;
      box.max[i] = *most + radius;
    }
    boxes.push_back(box);
  }
  return boxes;
}

void sweep_crossings(const SolidLeaf& leaf, const ElementTree& elements, const Line& line,
                     double start, double stop, Crossings& out) {
  const Axes axes = axes_of(line.direction);
  const double length = line.direction.length();
  thread_local std::vector<Inside> found;
  found.clear();
  elements.along(line, start, stop, [&](int element) {
    const SweepPiece& piece = leaf.sweep[std::size_t(element)];
    // Numbers near to the piece keep their digits.
    V3d begin;
    for (int i = 0; i < 3; ++i) begin[i] = piece.center[std::size_t(i)][0];
    const double nearest = (begin - line.origin).dot(axes.along);
    const std::size_t before = found.size();
    add_inside(piece, element, axes, line.origin + axes.along * nearest, found);
    for (std::size_t i = before; i < found.size(); ++i) {
      for (End* end : {&found[i].first, &found[i].last}) end->t = (end->t + nearest) / length;
    }
  });
  std::sort(found.begin(), found.end(),
            [](const Inside& a, const Inside& b) { return a.first.t < b.first.t; });
  const auto add = [&](const End& end) {
    if (end.t > start && end.t <= stop)
      out.list.push_back({end.t, end.element, end.s, false, false});
  };
  for (std::size_t i = 0; i < found.size();) {
    const End first = found[i].first;
    End last = found[i].last;
    for (++i; i < found.size() && found[i].first.t <= last.t; ++i) {
      if (found[i].last.t > last.t) last = found[i].last;
    }
    if (first.t <= start && start < last.t) out.inside_at_start = true;
    add(first);
    add(last);
  }
}

V3d sweep_outward(const SolidLeaf& leaf, const Line& line, const Crossing& crossing) {
  if (crossing.element < 0) return V3d(0.0);
  const SweepPiece& piece = leaf.sweep[std::size_t(crossing.element)];
  V3d outward = line.origin + line.direction * crossing.t;
  for (int i = 0; i < 3; ++i)
    outward[i] -= value_at(piece.center[std::size_t(i)], crossing.parameter);
  return outward;
}

}  // namespace lumivec
