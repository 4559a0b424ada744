// Real roots of polynomials in an interval, by the roots of their derivatives: between two of those
// a polynomial is monotone and has at most one root, which bisection and Newton's steps find. Where
// a curve only touches zero there may be no root, one or two: what counts are the changes of sign.
// Costs about degree² evaluations.
#pragma once

#include <array>

#include "loader/scene.h"

namespace lumivec {

// Of the polynomials here; those of sphere sweeps are the highest.
constexpr int max_root_degree = 10;

// Coefficients from the constant up.
struct Polynomial {
  std::array<double, max_root_degree + 1> c{};
  int degree = 0;

  double operator()(double x) const {
    double sum = c[std::size_t(degree)];
    for (int i = degree - 1; i >= 0; --i) sum = sum * x + c[std::size_t(i)];
    return sum;
  }
};

Polynomial product(const Polynomial& a, const Polynomial& b);  // the degrees' sum must fit
Polynomial derivative(const Polynomial& p);

struct Roots {
  std::array<double, max_root_degree> x{};
  int count = 0;
  void add(double root) { x[std::size_t(count++)] = root; }
};

// Ascending, of all changes of sign in low ≤ x ≤ high; both finite.
Roots roots_between(const Polynomial& p, double low, double high);

}  // namespace lumivec
