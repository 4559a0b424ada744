#include "integrator/solid_leaf.h"

#include <algorithm>
#include <cmath>

namespace lumivec {
namespace {

// Where a line is inside a convex shape; empty if last < first.
struct Stretch {
  double first = -std::numeric_limits<double>::infinity();
  double last = std::numeric_limits<double>::infinity();

  // Keeps low ≤ origin + t · direction ≤ high.
  void cut(double origin, double direction, double low, double high) {
    if (direction == 0.0) {
      if (origin < low || origin > high) last = -std::numeric_limits<double>::infinity();
      return;
    }
    const double a = (low - origin) / direction, b = (high - origin) / direction;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
};

Crossings of_stretch(const Stretch& stretch, double start, double stop) {
  Crossings result;
  if (!(stretch.first < stretch.last)) return result;
  result.inside_at_start = stretch.first <= start && start < stretch.last;
  for (const double t : {stretch.first, stretch.last}) {
    if (t > start && t <= stop) result.t[std::size_t(result.count++)] = t;
  }
  return result;
}

// Roots of a + 2 b t + c t², ascending.
bool quadratic(double a, double b, double c, double& first, double& last) {
  const double discriminant = b * b - a * c;
  if (!(discriminant > 0.0) || c == 0.0) return false;
  const double sum = -(b + std::copysign(std::sqrt(discriminant), b));
  first = sum / c;
  last = sum != 0.0 ? a / sum : -first;
  if (first > last) std::swap(first, last);
  return true;
}

// The middle of the line's chord is where the quadratic is best conditioned: distances from far
// away would lose their digits.
double nearest_to_origin(const Line& line) {
  return -line.origin.dot(line.direction) / line.direction.length2();
}

Stretch sphere_stretch(const Line& line, double radius) {
  const double middle = nearest_to_origin(line);
  const V3d p = line.origin + line.direction * middle;
  const double half2 = (radius * radius - p.length2()) / line.direction.length2();
  if (!(half2 > 0.0)) return {0.0, -1.0};
  const double half = std::sqrt(half2);
  return {middle - half, middle + half};
}

Stretch cone_stretch(const SolidLeaf& cone, const Line& line) {
  Stretch slab;
  slab.cut(line.origin.y, line.direction.y, 0.0, 1.0);
  const double most = std::max(cone.base_radius, cone.cap_radius);
  slab.cut(line.origin.x, line.direction.x, -most, most);
  slab.cut(line.origin.z, line.direction.z, -most, most);
  if (!(slab.first < slab.last) || !std::isfinite(slab.first) || !std::isfinite(slab.last))
    return {0.0, -1.0};
  const double middle = 0.5 * (slab.first + slab.last);
  const V3d o = line.origin + line.direction * middle;
  const V3d& d = line.direction;
  const double slope = cone.cap_radius - cone.base_radius;
  const double r = cone.base_radius + slope * o.y, dr = slope * d.y;
  const double a = o.x * o.x + o.z * o.z - r * r;
  const double b = o.x * d.x + o.z * d.z - r * dr;
  const double c = d.x * d.x + d.z * d.z - dr * dr;
  std::array<double, 4> ends = {slab.first - middle, slab.first - middle, slab.last - middle,
                                slab.last - middle};
  double first = 0.0, last = 0.0;
  if (quadratic(a, b, c, first, last)) {
    ends[1] = std::clamp(first, ends[0], ends[3]);
    ends[2] = std::clamp(last, ends[0], ends[3]);
  } else if (c == 0.0 && b != 0.0) {
    ends[1] = ends[2] = std::clamp(-0.5 * a / b, ends[0], ends[3]);
  }
  // Convex: between the lowest and the highest end of the stretches that are inside.
  Stretch result{1.0, -1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(ends[i] < ends[i + 1])) continue;
    const double t = 0.5 * (ends[i] + ends[i + 1]);
    if (!(a + t * (2.0 * b + t * c) < 0.0)) continue;
    if (result.last < result.first) result.first = ends[i] + middle;
    result.last = ends[i + 1] + middle;
  }
  return result;
}

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial p;
  p.degree = a.degree + b.degree;
  for (int i = 0; i <= a.degree; ++i) {
    for (int j = 0; j <= b.degree; ++j)
      p.c[std::size_t(i + j)] += a.c[std::size_t(i)] * b.c[std::size_t(j)];
  }
  return p;
}

Polynomial along(const SolidLeaf& leaf, const V3d& origin, const V3d& direction) {
  if (leaf.shape == SolidShape::torus) {
    // (|p|² + 1 - r²)² - 4 (x² + z²), the ring's radius being 1.
    Polynomial square;
    square.degree = 2;
    square.c = {origin.length2() + 1.0 - leaf.minor_radius * leaf.minor_radius,
                2.0 * origin.dot(direction), direction.length2()};
    Polynomial p = product(square, square);
    const double a = origin.x * origin.x + origin.z * origin.z;
    const double b = origin.x * direction.x + origin.z * direction.z;
    const double c = direction.x * direction.x + direction.z * direction.z;
    p.c[0] -= 4.0 * a;
    p.c[1] -= 8.0 * b;
    p.c[2] -= 4.0 * c;
    return p;
  }
  // Planes and quadrics need no products of polynomials.
  const auto is_quadratic = [](const PolynomialTerm& term) {
    return term.powers[0] + term.powers[1] + term.powers[2] <= 2;
  };
  if (std::all_of(leaf.terms.begin(), leaf.terms.end(), is_quadratic)) {
    Polynomial sum;
    sum.degree = 2;
    for (const PolynomialTerm& term : leaf.terms) {
      double constant = term.coefficient, linear = 0.0, square = 0.0;
      for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < term.powers[std::size_t(axis)]; ++i) {
          square = linear * direction[axis];
          linear = constant * direction[axis] + linear * origin[axis];
          constant *= origin[axis];
        }
      }
      sum.c[0] += constant;
      sum.c[1] += linear;
      sum.c[2] += square;
    }
    return sum;
  }
  std::array<std::array<Polynomial, max_polynomial_degree + 1>, 3> powers;
  std::array<int, 3> known{};
  for (std::size_t axis = 0; axis < 3; ++axis) powers[axis][0].c[0] = 1.0;
  Polynomial sum;
  for (const PolynomialTerm& term : leaf.terms) {
    Polynomial p;
    p.c[0] = term.coefficient;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int wanted = term.powers[axis];
      while (known[axis] < wanted) {
        Polynomial linear;
        linear.degree = 1;
        linear.c[0] = origin[int(axis)];
        linear.c[1] = direction[int(axis)];
        powers[axis][std::size_t(known[axis] + 1)] =
            product(powers[axis][std::size_t(known[axis])], linear);
        ++known[axis];
      }
      if (wanted > 0) p = product(p, powers[axis][std::size_t(wanted)]);
    }
    sum.degree = std::max(sum.degree, p.degree);
    for (int i = 0; i <= p.degree; ++i) sum.c[std::size_t(i)] += p.c[std::size_t(i)];
  }
  return sum;
}

// Expanded about the point of the line that is nearest to the origin, where the shape is.
Crossings polynomial_crossings(const SolidLeaf& leaf, const Line& line, double start, double stop) {
  const double middle = std::clamp(nearest_to_origin(line), start, stop);
  const double unit = std::max({stop - middle, middle - start, std::numeric_limits<double>::min()});
  const Polynomial p = along(leaf, line.origin + line.direction * middle, line.direction * unit);
  const double low = (start - middle) / unit;
  Crossings result;
  result.inside_at_start = p(low) < 0.0;
  const Roots roots = roots_between(p, low, (stop - middle) / unit);
  for (int i = 0; i < roots.count; ++i)
    result.t[std::size_t(result.count++)] = middle + unit * roots.x[std::size_t(i)];
  return result;
}

Crossings torus_crossings(const SolidLeaf& torus, const Line& line, double start, double stop) {
  // A little wider than the torus, so that the line is surely outside at both ends.
  constexpr double wider = 1.001;
  Stretch around = sphere_stretch(line, (1.0 + torus.minor_radius) * wider);
  const double half_height = torus.minor_radius * wider;
  around.cut(line.origin.y, line.direction.y, -half_height, half_height);
  const double from = std::max(start, around.first), to = std::min(stop, around.last);
  if (!(from < to)) return {};
  return polynomial_crossings(torus, line, from, to);
}

LeafField polynomial_field(const std::vector<PolynomialTerm>& terms, const V3d& p) {
  std::array<std::array<double, max_polynomial_degree + 1>, 3> powers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    powers[axis][0] = 1.0;
    for (std::size_t i = 1; i < powers[axis].size(); ++i)
      powers[axis][i] = powers[axis][i - 1] * p[int(axis)];
  }
  LeafField f;
  for (const PolynomialTerm& term : terms) {
    const auto& [i, j, k] = term.powers;
    const double x = powers[0][i], y = powers[1][j], z = powers[2][k], c = term.coefficient;
    f.value += c * x * y * z;
    if (i > 0) f.gradient.x += c * i * powers[0][std::size_t(i - 1)] * y * z;
    if (j > 0) f.gradient.y += c * j * x * powers[1][std::size_t(j - 1)] * z;
    if (k > 0) f.gradient.z += c * k * x * y * powers[2][std::size_t(k - 1)];
  }
  return f;
}

LeafField cone_field(const SolidLeaf& cone, const V3d& p) {
  const double slope = cone.cap_radius - cone.base_radius;
  const double across = std::hypot(p.x, p.z);
  LeafField side{across - cone.base_radius - slope * p.y, V3d(0.0, -slope, 0.0)};
  if (across > 0.0) {
    side.gradient.x = p.x / across;
    side.gradient.z = p.z / across;
  }
  LeafField nearest{-p.y, V3d(0.0, -1.0, 0.0)};
  if (p.y - 1.0 > nearest.value) nearest = {p.y - 1.0, V3d(0.0, 1.0, 0.0)};
  return side.value > nearest.value ? side : nearest;
}

LeafField box_field(const V3d& p) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(p[i]) > std::abs(p[axis])) axis = i;
  }
  LeafField f{std::abs(p[axis]) - 1.0, V3d(0.0)};
  f.gradient[axis] = p[axis] < 0.0 ? -1.0 : 1.0;
  return f;
}

LeafField torus_field(const SolidLeaf& torus, const V3d& p) {
  const double across = std::hypot(p.x, p.z);
  if (across == 0.0) return {1.0 - torus.minor_radius, V3d(0.0, 1.0, 0.0)};
  const V3d from_ring(p.x * (1.0 - 1.0 / across), p.y, p.z * (1.0 - 1.0 / across));
  const double distance = from_ring.length();
  return {distance - torus.minor_radius, distance > 0.0 ? from_ring / distance : V3d(0, 1, 0)};
}

}  // namespace

Crossings crossings(const SolidLeaf& leaf, const Line& line, double start, double stop) {
  switch (leaf.shape) {
    case SolidShape::box: {
      Stretch stretch;
      for (int i = 0; i < 3; ++i) stretch.cut(line.origin[i], line.direction[i], -1.0, 1.0);
      return of_stretch(stretch, start, stop);
    }
    case SolidShape::sphere:
      return of_stretch(sphere_stretch(line, 1.0), start, stop);
    case SolidShape::cone:
      return of_stretch(cone_stretch(leaf, line), start, stop);
    case SolidShape::torus:
      return torus_crossings(leaf, line, start, stop);
    case SolidShape::polynomial:
      return polynomial_crossings(leaf, line, start, stop);
  }
  return {};
}

LeafField field(const SolidLeaf& leaf, const V3d& p) {
  switch (leaf.shape) {
    case SolidShape::box:
      return box_field(p);
    case SolidShape::sphere:
      return {p.length() - 1.0, p.length() > 0.0 ? p.normalized() : V3d(0.0, 1.0, 0.0)};
    case SolidShape::cone:
      return cone_field(leaf, p);
    case SolidShape::torus:
      return torus_field(leaf, p);
    case SolidShape::polynomial:
      return polynomial_field(leaf.terms, p);
  }
  return {};
}

}  // namespace lumivec
