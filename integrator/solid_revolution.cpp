// Surfaces of revolution around y: lathes and sors.
//
// On a line through (o, d), d of unit length, with h its distance from the axis, m the length of d
// across it, and heights counted from where the two are nearest, a stretch of the profile with
// squared radius q(s) and height v(s) is met where (q - h²) dy² - (v m)² = 0: of degree 6 for
// cubics. What is found so is made exact by Newton's steps on the two equations that this comes
// from.
#include <algorithm>
#include <cmath>

#include "integrator/solid_curve_roots.h"
#include "integrator/solid_shapes.h"

namespace lumivec {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Lines that are more level than this are searched as if they were level: the roots would merge.
constexpr double almost_level = 1e-6;

Polynomial of_cubic(const Cubic& cubic) {
  Polynomial p;
  for (std::size_t i = 0; i < 4; ++i) {
    p.c[i] = cubic[i];
    if (cubic[i] != 0.0) p.degree = static_cast<int>(i);
  }
  return p;
}

Polynomial square_of_radius(const SolidLeaf& leaf, const CurvePiece& piece) {
  const Polynomial u = of_cubic(piece.u);
  return leaf.shape == SolidShape::sor ? u : product(u, u);
}

// A line as its distance from the axis has it: t is counted from the nearest place.
struct TurnedLine {
  double shift = 0.0;   // t of the nearest place
  double length = 1.0;  // of the direction
  double height = 0.0;  // of the nearest place
  double rise = 0.0;    // dy, of a unit direction
  double across = 0.0;  // m
  double distance2 = 0.0;

  explicit TurnedLine(const Line& line) : length(line.direction.length()) {
    const V3d d = line.direction / length;
    const double across2 = d.x * d.x + d.z * d.z;
    const double nearest =
        across2 > 0.0 ? -(line.origin.x * d.x + line.origin.z * d.z) / across2 : -line.origin.y;
    const V3d o = line.origin + d * nearest;
    shift = nearest;
    height = o.y;
    rise = d.y;
    across = std::sqrt(across2);
    distance2 = o.x * o.x + o.z * o.z;
  }

  bool is_level() const { return std::abs(rise) < almost_level; }

  // 0 where the point (q, v) of the profile is on the line's hyperbola, above 0 around the axis.
  double side(double q, double v) const {
    if (is_level()) return v - height;
    const double from = (v - height) * across;
    return (q - distance2) * rise * rise - from * from;
  }
};

struct Finder {
  const SolidLeaf& leaf;
  const TurnedLine& line;
  std::vector<Crossing>& out;

  double square(double u) const { return leaf.shape == SolidShape::sor ? u : u * u; }

  void add(double t, int element, double s) const {
    const bool hidden = leaf.curve[std::size_t(element)].hidden;
    if (!std::isnan(t)) out.push_back({(line.shift + t) / line.length, element, s, false, hidden});
  }

  // Newton's steps for v(s) = height + t rise and q(s) = distance² + (t across)².
  void refine(const Polynomial& q, const Polynomial& v, double s, double t, int element) const {
    const Polynomial dq = derivative(q), dv = derivative(v);
    const auto residuals = [&](double at_s, double at_t) {
      const double run = at_t * line.across;
      return Imath::V2d(v(at_s) - line.height - at_t * line.rise,
                        q(at_s) - line.distance2 - run * run);
    };
    Imath::V2d left = residuals(s, t);
    constexpr int most_steps = 4;
    for (int i = 0; i < most_steps && left != Imath::V2d(0.0); ++i) {
      const double a = dv(s), b = -line.rise, c = dq(s), e = -2.0 * t * line.across * line.across;
      const double det = a * e - b * c;
      const double next_s = s - (left.x * e - b * left.y) / det;
      const double next_t = t - (a * left.y - left.x * c) / det;
      if (!(next_s >= 0.0 && next_s <= 1.0) || !std::isfinite(next_t)) break;
      const Imath::V2d next_left = residuals(next_s, next_t);
      if (!(std::abs(next_left.x) <= std::abs(left.x) && std::abs(next_left.y) <= std::abs(left.y)))
        break;
      s = next_s;
      t = next_t;
      left = next_left;
    }
    add(t, element, s);
  }

  void cross(int element) const {
    const CurvePiece& piece = leaf.curve[std::size_t(element)];
    const Polynomial q = square_of_radius(leaf, piece), v = of_cubic(piece.v);
    Polynomial f = v;
    f.c[0] -= line.height;
    if (!line.is_level()) {
      const double rise2 = line.rise * line.rise, across2 = line.across * line.across;
      Polynomial squared = product(f, f);
      f = Polynomial();
      f.degree = std::max(squared.degree, q.degree);
      for (std::size_t i = 0; i <= std::size_t(f.degree); ++i)
        f.c[i] = q.c[i] * rise2 - squared.c[i] * across2;
      f.c[0] -= line.distance2 * rise2;
    }
    const double from = line.side(square(piece.u[0]), piece.v[0]);
    const double to = line.side(square(piece.end[0]), piece.end[1]);
    const Roots roots = sign_changes(f, from, to);
    for (int i = 0; i < roots.count; ++i) {
      const double s = roots.x[std::size_t(i)];
      const double run = std::sqrt(std::max(q(s) - line.distance2, 0.0)) / line.across;
      if (line.is_level()) {
        if (!(q(s) > line.distance2)) continue;
        for (const double t : {-run, run}) refine(q, v, s, t, element);
        continue;
      }
      double t = (v(s) - line.height) / line.rise;
      // The radius tells better how far along the line it is where that is nearly level.
      if (std::abs(line.rise) < line.across && run > 0.0) t = std::copysign(run, t);
      refine(q, v, s, t, element);
    }
  }
};

}  // namespace

std::vector<Imath::Box3d> revolution_boxes(const SolidLeaf& leaf) {
  std::vector<Imath::Box3d> boxes;
  for (const CurvePiece& piece : leaf.curve) {
    double radius = 0.0;
    for (const double u : control_values(piece.u)) radius = std::max(radius, std::abs(u));
    if (leaf.shape == SolidShape::sor) radius = std::sqrt(radius);
    Imath::Box3d box;
    for (const double v : control_values(piece.v)) {
      box.extendBy(V3d(-radius, v, -radius));
      box.extendBy(V3d(radius, v, radius));
    }
    boxes.push_back(box);
  }
  return boxes;
}

void revolution_crossings(const SolidLeaf& leaf, const ElementTree& elements, const Line& line,
                          double start, double stop, Crossings& out) {
  const TurnedLine turned(line);
  thread_local std::vector<Crossing> crossed;
  crossed.clear();
  const Finder finder{leaf, turned, crossed};
  elements.along(line, -infinity, infinity, [&](int element) { finder.cross(element); });
  std::sort(crossed.begin(), crossed.end(),
            [](const Crossing& a, const Crossing& b) { return a.t < b.t; });
  bool inside = false;
  for (Crossing& crossing : crossed) {
    crossing.entering = inside = !inside;
    if (crossing.t <= start) {
      out.inside_at_start = inside;
    } else if (crossing.t <= stop) {
      out.list.push_back(crossing);
    }
  }
}

V3d revolution_outward(const SolidLeaf& leaf, const Line& line, const Crossing& crossing) {
  V3d normal(0.0, 1.0, 0.0);
  const V3d point = line.origin + line.direction * crossing.t;
  const double radius = std::hypot(point.x, point.z);
  if (crossing.element >= 0 && radius > 0.0) {
    const CurvePiece& piece = leaf.curve[std::size_t(crossing.element)];
    const auto slopes = [&](double s) {
      const double u = slope_at(piece.u, s), v = slope_at(piece.v, s);
      if (leaf.shape == SolidShape::sor) return Imath::V2d(u, 2.0 * radius * v);
      return Imath::V2d(value_at(piece.u, s) < 0.0 ? -u : u, v);
    };
    const double s = crossing.parameter;
    Imath::V2d along = slopes(s);
    constexpr double farther = 1e-5;
    if (along.length2() == 0.0) along = slopes(s < 0.5 ? s + farther : s - farther);
    normal = V3d(along.y * point.x / radius, -along.x, along.y * point.z / radius);
  }
  return (normal.dot(line.direction) < 0.0) == crossing.entering ? normal : -normal;
}

}  // namespace lumivec
