#include "integrator/solid_leaf.h"

#include <algorithm>
#include <cmath>

#include "integrator/polynomial_roots.h"
#include "integrator/solid_shapes.h"

namespace lumivec {
namespace {

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

void cone_crossings(const SolidLeaf& cone, const Line& line, double start, double stop,
                    Crossings& out) {
  Stretch slab;
  slab.cut(line.origin.y, line.direction.y, 0.0, 1.0);
  const Stretch ends_apart = slab;
  const double most = std::max(cone.base_radius, cone.cap_radius);
  slab.cut(line.origin.x, line.direction.x, -most, most);
  slab.cut(line.origin.z, line.direction.z, -most, most);
  if (!(slab.first < slab.last) || !std::isfinite(slab.first) || !std::isfinite(slab.last)) return;
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
  add_stretch(result, start, stop, out);
  if (!cone.open) return;
  const double rounding = 0x1p-40 * (slab.last - slab.first);
  for (Crossing& crossing : out.list) {
    crossing.hidden = std::abs(crossing.t - ends_apart.first) < rounding ||
                      std::abs(crossing.t - ends_apart.last) < rounding;
  }
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
void polynomial_crossings(const SolidLeaf& leaf, const Line& line, double start, double stop,
                          Crossings& out) {
  const double middle = std::clamp(nearest_to_origin(line), start, stop);
  const double unit = std::max({stop - middle, middle - start, std::numeric_limits<double>::min()});
  const Polynomial p = along(leaf, line.origin + line.direction * middle, line.direction * unit);
  const double low = (start - middle) / unit;
  out.inside_at_start = p(low) < 0.0;
  const Roots roots = roots_between(p, low, (stop - middle) / unit);
  for (int i = 0; i < roots.count; ++i) out.add(middle + unit * roots.x[std::size_t(i)]);
}

void torus_crossings(const SolidLeaf& torus, const Line& line, double start, double stop,
                     Crossings& out) {
  // A little wider than the torus, so that the line is surely outside at both ends.
  constexpr double wider = 1.001;
  Stretch around = sphere_stretch(line, (1.0 + torus.minor_radius) * wider);
  const double half_height = torus.minor_radius * wider;
  around.cut(line.origin.y, line.direction.y, -half_height, half_height);
  const double from = std::max(start, around.first), to = std::min(stop, around.last);
  if (from < to) polynomial_crossings(torus, line, from, to, out);
}

V3d polynomial_outward(const std::vector<PolynomialTerm>& terms, const V3d& p) {
  std::array<std::array<double, max_polynomial_degree + 1>, 3> powers;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    powers[axis][0] = 1.0;
    for (std::size_t i = 1; i < powers[axis].size(); ++i)
      powers[axis][i] = powers[axis][i - 1] * p[int(axis)];
  }
  V3d gradient(0.0);
  for (const PolynomialTerm& term : terms) {
    const auto& [i, j, k] = term.powers;
    const double x = powers[0][i], y = powers[1][j], z = powers[2][k], c = term.coefficient;
    if (i > 0) gradient.x += c * i * powers[0][std::size_t(i - 1)] * y * z;
    if (j > 0) gradient.y += c * j * x * powers[1][std::size_t(j - 1)] * z;
    if (k > 0) gradient.z += c * k * x * y * powers[2][std::size_t(k - 1)];
  }
  return gradient;
}

V3d cone_outward(const SolidLeaf& cone, const V3d& p) {
  const double slope = cone.cap_radius - cone.base_radius;
  const double across = std::hypot(p.x, p.z);
  const double beyond_side = across - cone.base_radius - slope * p.y;
  if (beyond_side > std::max(-p.y, p.y - 1.0) || cone.open)
    return across > 0.0 ? V3d(p.x / across, -slope, p.z / across) : V3d(0.0, -slope, 0.0);
  return V3d(0.0, p.y - 1.0 > -p.y ? 1.0 : -1.0, 0.0);
}

V3d box_outward(const V3d& p) {
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(p[i]) > std::abs(p[axis])) axis = i;
  }
  V3d outward(0.0);
  outward[axis] = p[axis] < 0.0 ? -1.0 : 1.0;
  return outward;
}

V3d torus_outward(const V3d& p) {
  const double across = std::hypot(p.x, p.z);
  if (across == 0.0) return V3d(0.0, 1.0, 0.0);
  return {p.x * (1.0 - 1.0 / across), p.y, p.z * (1.0 - 1.0 / across)};
}

}  // namespace

void Stretch::cut(double origin, double direction, double low, double high) {
  if (direction == 0.0) {
    if (origin < low || origin > high) last = -std::numeric_limits<double>::infinity();
    return;
  }
  const double a = (low - origin) / direction, b = (high - origin) / direction;
  first = std::max(first, std::min(a, b));
  last = std::min(last, std::max(a, b));
}

void add_stretch(const Stretch& stretch, double start, double stop, Crossings& out) {
  if (!(stretch.first < stretch.last)) return;
  if (stretch.first <= start && start < stretch.last) out.inside_at_start = true;
  for (const double t : {stretch.first, stretch.last}) {
    if (t > start && t <= stop) out.add(t);
  }
}

std::array<double, 4> control_values(const Cubic& c) {
  return {c[0], c[0] + c[1] / 3.0, c[0] + (2.0 * c[1] + c[2]) / 3.0, c[0] + c[1] + c[2] + c[3]};
}

double value_at(const Cubic& c, double s) {
  return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
}

double slope_at(const Cubic& c, double s) {
  return c[1] + s * (2.0 * c[2] + 3.0 * s * c[3]);
}

ElementTree elements_of(const SolidLeaf& leaf) {
  switch (leaf.shape) {
    case SolidShape::prism:
      return ElementTree(prism_boxes(leaf));
    case SolidShape::lathe:
    case SolidShape::sor:
      return ElementTree(revolution_boxes(leaf));
    case SolidShape::blob:
      return ElementTree(blob_boxes(leaf));
    case SolidShape::sweep:
      return ElementTree(sweep_boxes(leaf));
    default:
      return {};
  }
}

void find_crossings(const SolidLeaf& leaf, const ElementTree& elements, const Line& line,
                    double start, double stop, Crossings& out) {
  out.clear();
  switch (leaf.shape) {
    case SolidShape::box: {
      Stretch stretch;
      for (int i = 0; i < 3; ++i) stretch.cut(line.origin[i], line.direction[i], -1.0, 1.0);
      return add_stretch(stretch, start, stop, out);
    }
    case SolidShape::sphere:
      return add_stretch(sphere_stretch(line, 1.0), start, stop, out);
    case SolidShape::cone:
      return cone_crossings(leaf, line, start, stop, out);
    case SolidShape::torus:
      return torus_crossings(leaf, line, start, stop, out);
    case SolidShape::polynomial:
      return polynomial_crossings(leaf, line, start, stop, out);
    case SolidShape::prism:
      return prism_crossings(leaf, elements, line, start, stop, out);
    case SolidShape::lathe:
    case SolidShape::sor:
      return revolution_crossings(leaf, elements, line, start, stop, out);
    case SolidShape::superellipsoid:
      return superellipsoid_crossings(leaf, line, start, stop, out);
    case SolidShape::blob:
      return blob_crossings(leaf, elements, line, start, stop, out);
    case SolidShape::sweep:
      return sweep_crossings(leaf, elements, line, start, stop, out);
  }
}

V3d outward_at(const SolidLeaf& leaf, const ElementTree& elements, const Line& line,
               const Crossing& crossing) {
  const V3d p = line.origin + line.direction * crossing.t;
  switch (leaf.shape) {
    case SolidShape::box:
      return box_outward(p);
    case SolidShape::sphere:
      return p;
    case SolidShape::cone:
      return cone_outward(leaf, p);
    case SolidShape::torus:
      return torus_outward(p);
    case SolidShape::polynomial:
      return polynomial_outward(leaf.terms, p);
    case SolidShape::prism:
      return prism_outward(leaf, line, crossing);
    case SolidShape::lathe:
    case SolidShape::sor:
      return revolution_outward(leaf, line, crossing);
    case SolidShape::superellipsoid:
      return superellipsoid_outward(leaf, p);
    case SolidShape::blob:
      return blob_outward(leaf, elements, line, crossing.t);
    case SolidShape::sweep:
      return sweep_outward(leaf, line, crossing);
  }
  return V3d(0.0);
}

}  // namespace lumivec
