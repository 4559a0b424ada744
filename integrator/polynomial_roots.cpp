#include "integrator/polynomial_roots.h"

#include <algorithm>
#include <cmath>

namespace lumivec {
namespace {

// Of a monotone stretch with different signs at its ends.
double root_within(const Polynomial& p, const Polynomial& slope, double low, double high,
                   bool rising) {
  constexpr int max_steps = 100;  // halving alone needs 53 from any sensible interval
  double x = 0.5 * (low + high);
  for (int i = 0; i < max_steps; ++i) {
    const double value = p(x);
    if (value == 0.0) return x;
    ((value < 0.0) == rising ? low : high) = x;
    double next = x - value / slope(x);
    // Every third step halves, so that slow approaches of multiple roots end.
    if (!(next > low && next < high) || i % 3 == 2) next = 0.5 * (low + high);
    if (next == x || next <= low || next >= high) return x;
    constexpr double rounding = 0x1p-51;
    if (std::abs(next - x) <= rounding * std::abs(next) && i % 3 != 2) return next;
    x = next;
  }
  return x;
}

}  // namespace

Polynomial product(const Polynomial& a, const Polynomial& b) {
  Polynomial p;
  p.degree = a.degree + b.degree;
  for (int i = 0; i <= a.degree; ++i) {
    for (int j = 0; j <= b.degree; ++j)
      p.c[std::size_t(i + j)] += a.c[std::size_t(i)] * b.c[std::size_t(j)];
  }
  return p;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial d;
  d.degree = std::max(p.degree - 1, 0);
  for (int i = 1; i <= p.degree; ++i) d.c[std::size_t(i - 1)] = p.c[std::size_t(i)] * i;
  return d;
}

Roots roots_between(const Polynomial& polynomial, double low, double high) {
  Polynomial p = polynomial;
  while (p.degree > 0 && p.c[std::size_t(p.degree)] == 0.0) --p.degree;
  Roots roots;
  const auto add = [&](double x) {
    if (x >= low && x <= high) roots.add(x);
  };
  if (p.degree == 0 || !(low <= high)) return roots;
  if (p.degree == 1) {
    add(-p.c[0] / p.c[1]);
    return roots;
  }
  if (p.degree == 2) {
    const double half = -0.5 * p.c[1];
    const double discriminant = half * half - p.c[0] * p.c[2];
    if (!(discriminant > 0.0)) return roots;
    // Added with equal signs, so that no digits cancel.
    const double sum = half + std::copysign(std::sqrt(discriminant), half);
    const double a = sum / p.c[2], b = p.c[0] / sum;
    add(std::min(a, b));
    add(std::max(a, b));
    return roots;
  }
  const Polynomial slope = derivative(p);
  const Roots turns = roots_between(slope, low, high);
  double left = low, left_value = p(low);
  for (int i = 0; i <= turns.count; ++i) {
    const double right = i < turns.count ? turns.x[std::size_t(i)] : high;
    const double right_value = p(right);
    // Zero counts as positive, so that a root at a turn is found in one of the stretches only.
    if ((left_value < 0.0) != (right_value < 0.0))
      roots.add(root_within(p, slope, left, right, left_value < 0.0));
    left = right;
    left_value = right_value;
  }
  return roots;
}

}  // namespace lumivec
