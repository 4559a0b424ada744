// Superellipsoids: |x|^(2/e) + |y|^(2/e) to the power e/n, plus |z|^(2/n), is 1.
//
// The root of that sum which grows in proportion to the distance from the origin is a norm while e
// and n are 2 at most, and convex along a line then: Newton's steps from outside never pass the
// surface, and where it does not fall toward the other side the line misses. Otherwise the shape
// has spikes along the axes, and is searched in steps between the planes of the axes; what turns
// between two steps is followed to its turn.
#include <algorithm>
#include <cmath>

#include "integrator/solid_shapes.h"

namespace lumivec {
namespace {

// (a^p + b^p)^(1/p) for a, b ≥ 0, without overflow, and its slopes by a and b.
struct PowerSum {
  double value = 0.0, by_a = 0.0, by_b = 0.0;

  PowerSum(double a, double b, double p) {
    const double most = std::max(a, b), least = std::min(a, b);
    if (most == 0.0) return;
    const double ratio = least / most;
    const double q = ratio > 0.0 ? std::pow(ratio, p) : 0.0;
    const double root = std::exp(std::log1p(q) / p);
    value = most * root;
    const double by_most = root / (1.0 + q);
    const double by_least = ratio > 0.0 ? by_most * q / ratio : (p > 1.0 ? 0.0 : by_most);
    by_a = a >= b ? by_most : by_least;
    by_b = a >= b ? by_least : by_most;
  }
};

// Below 1 inside.
struct Size {
  double value = 0.0;
  V3d gradient{0.0};
};

Size size_at(const SolidLeaf& leaf, const V3d& p) {
  const PowerSum ring(std::abs(p.x), std::abs(p.y), 2.0 / leaf.east_west);
  const PowerSum all(ring.value, std::abs(p.z), 2.0 / leaf.north_south);
  Size size;
  size.value = all.value;
  size.gradient.x = std::copysign(all.by_a * ring.by_a, p.x);
  size.gradient.y = std::copysign(all.by_a * ring.by_b, p.y);
  size.gradient.z = std::copysign(all.by_b, p.z);
  return size;
}

// Where a convex function falls to 0 from at toward limit; none: at limit, or nowhere.
template <class Function>
bool fall_to_zero(const Function& f, double limit, double& at) {
  // Where it only touches zero each step halves the way: then this many leave nothing.
  constexpr int most_steps = 60;
  for (int i = 0; i < most_steps; ++i) {
    const auto [value, slope] = f(at);
    if (value <= 0.0) return true;
    if (!(slope * (limit - at) < 0.0)) return false;
    const double next = at - value / slope;
    if ((next - at) * (limit - next) < 0.0) return false;
    if (std::abs(next - at) <= 0x1p-51 * std::abs(limit - at)) return true;
    at = next;
  }
  return true;
}

// Between a place outside and one inside, by false positions (the Illinois rule) and halving.
template <class Function>
double border(double outside, double inside, const Function& f) {
  const double enough = 0x1p-50 * (std::abs(outside) + std::abs(inside));
  double beyond = f(outside), within = f(inside);
  constexpr int most_steps = 150;  // halving alone, in every third, needs 50
  for (int i = 0; i < most_steps && std::abs(outside - inside) > enough; ++i) {
    double next = outside - beyond * (inside - outside) / (within - beyond);
    if (i % 3 == 2 || !((next - outside) * (next - inside) < 0.0)) next = 0.5 * (outside + inside);
    const double left = f(next);
    if (left < 0.0) {
      inside = next;
      within = left;
      beyond *= 0.5;
    } else {
      outside = next;
      beyond = left;
      within *= 0.5;
    }
  }
  return 0.5 * (outside + inside);
}

// The place of the least value between low and high, by the golden section, or of the first that is
// below 0.
template <class Function>
double least_place(double low, double high, const Function& f) {
  constexpr double golden = 0.6180339887498949;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double fa = f(a), fb = f(b);
  // Each step keeps 0.618 of what was left; around a least value half of a double's digits are all
  // that can be told.
  constexpr int steps = 45;
  for (int i = 0; i < steps && std::min(fa, fb) >= 0.0; ++i) {
    if (fa <= fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - golden * (high - low);
      fa = f(a);
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + golden * (high - low);
      fb = f(b);
    }
  }
  return fa <= fb ? a : b;
}

// Stretches inside between first and last, where the shape is spiked.
template <class Function, class Add>
void search(const std::array<double, 5>& ends, const Function& f, const Add& add) {
  constexpr int steps = 16;  // between two planes of the axes
  std::array<double, 4 * steps + 1> places{};
  std::array<double, 4 * steps + 1> values{};
  std::size_t count = 0;
  const auto see = [&](double t) {
    places[count] = t;
    values[count++] = f(t);
  };
  see(ends[0]);
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    for (int i = 1; i <= steps && ends[k] < ends[k + 1]; ++i)
      see(i == steps ? ends[k + 1] : ends[k] + (ends[k + 1] - ends[k]) * i / steps);
  }
  bool inside = false;
  double entry = ends[0], before = ends[0];
  const auto pass = [&](double t) {
    const bool now = f(t) < 0.0;
    if (now && !inside) entry = border(before, t, f);
    if (!now && inside) add(Stretch{entry, border(t, before, f)});
    inside = now;
    before = t;
  };
  for (std::size_t i = 1; i < count; ++i) {
    // Around a turn on the near side of zero there may be more of it.
    const double side = inside ? -1.0 : 1.0;
    const auto turned = [&](double t) { return side * f(t); };
    const bool turns = side * values[i] >= 0.0 && side * values[i] <= side * values[i - 1] &&
                       (i + 1 == count || side * values[i] <= side * values[i + 1]);
    if (turns) {
      const double turn = least_place(before, i + 1 < count ? places[i + 1] : places[i], turned);
      if (turned(turn) < 0.0) pass(turn);
    }
    if (places[i] > before) pass(places[i]);
  }
  if (inside) add(Stretch{entry, before});
}

}  // namespace

void superellipsoid_crossings(const SolidLeaf& leaf, const Line& line, double start, double stop,
                              Crossings& out) {
  Stretch box;
  for (int i = 0; i < 3; ++i) box.cut(line.origin[i], line.direction[i], -1.0, 1.0);
  if (!(box.first < box.last) || box.first > stop || box.last < start) return;
  // Numbers near to the shape keep their digits.
  const double middle = 0.5 * (box.first + box.last);
  const V3d origin = line.origin + line.direction * middle;
  const double first = box.first - middle, last = box.last - middle;
  if (leaf.east_west <= 2.0 && leaf.north_south <= 2.0) {
    const auto value_and_slope = [&](double t) {
      const Size size = size_at(leaf, origin + line.direction * t);
      return std::pair(size.value - 1.0, size.gradient.dot(line.direction));
    };
    double entry = first, exit = last;
    if (fall_to_zero(value_and_slope, last, entry) && fall_to_zero(value_and_slope, first, exit))
      add_stretch({middle + entry, middle + exit}, start, stop, out);
    return;
  }
  std::array<double, 5> ends = {first, first, first, first, last};
  for (int i = 0; i < 3; ++i) {
    const double t = -origin[i] / line.direction[i];
    if (t > first && t < last) ends[std::size_t(i + 1)] = t;
  }
  std::sort(ends.begin(), ends.end());
  search(
      ends, [&](double t) { return size_at(leaf, origin + line.direction * t).value - 1.0; },
      [&](const Stretch& stretch) {
        add_stretch({middle + stretch.first, middle + stretch.last}, start, stop, out);
      });
}

V3d superellipsoid_outward(const SolidLeaf& leaf, const V3d& point) {
  return size_at(leaf, point).gradient;
}

}  // namespace lumivec
