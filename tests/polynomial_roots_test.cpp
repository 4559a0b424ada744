// Polynomials with known roots.
#include "integrator/polynomial_roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace {

using lumivec::Polynomial;

Polynomial with_roots(const std::vector<double>& roots) {
  Polynomial p;
  p.c[0] = 1.0;
  for (const double root : roots) {
    Polynomial next;
    next.degree = p.degree + 1;
    for (int i = 0; i <= p.degree; ++i) {
      next.c[std::size_t(i)] -= root * p.c[std::size_t(i)];
      next.c[std::size_t(i + 1)] += p.c[std::size_t(i)];
    }
    p = next;
  }
  return p;
}

TEST(PolynomialRoots, FindsAllSimpleRoots) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in_unit(-1.0, 1.0);
  for (int degree = 1; degree <= lumivec::max_polynomial_degree; ++degree) {
    for (int trial = 0; trial < 200; ++trial) {
      std::vector<double> wanted;
      while (int(wanted.size()) < degree) {
        const double x = in_unit(random);
        const bool apart = std::all_of(wanted.begin(), wanted.end(),
                                       [&](double y) { return std::abs(x - y) > 0.05; });
        if (apart) wanted.push_back(x);
      }
      std::sort(wanted.begin(), wanted.end());
      const auto found = roots_between(with_roots(wanted), -1.0, 1.0);
      ASSERT_EQ(found.count, degree);
      for (int i = 0; i < degree; ++i)
        EXPECT_NEAR(found.x[std::size_t(i)], wanted[std::size_t(i)], 1e-7);
    }
  }
}

TEST(PolynomialRoots, KeepsToTheInterval) {
  const auto found = roots_between(with_roots({-3.0, -0.5, 0.25, 2.0}), -1.0, 1.0);
  ASSERT_EQ(found.count, 2);
  EXPECT_NEAR(found.x[0], -0.5, 1e-14);
  EXPECT_NEAR(found.x[1], 0.25, 1e-14);
}

TEST(PolynomialRoots, LeadingZerosLowerTheDegree) {
  Polynomial p = with_roots({0.5});
  p.degree = 4;
  const auto found = roots_between(p, 0.0, 1.0);
  ASSERT_EQ(found.count, 1);
  EXPECT_DOUBLE_EQ(found.x[0], 0.5);
}

TEST(PolynomialRoots, CancellationLosesNoDigits) {
  const auto found = roots_between(with_roots({1e-9, 1.0}), -1.0, 2.0);
  ASSERT_EQ(found.count, 2);
  EXPECT_NEAR(found.x[0] / 1e-9, 1.0, 1e-6);
}

// A touching line may have no root or two, but never changes sides.
TEST(PolynomialRoots, DoubleRootsComeInPairs) {
  for (const double root : {-0.3, 0.1, 0.7}) {
    const auto found = roots_between(with_roots({root, root, -0.9, 0.95}), -1.0, 1.0);
    EXPECT_EQ(found.count % 2, 0) << root;
    EXPECT_GE(found.count, 2);
  }
}

TEST(PolynomialRoots, TripleRootsAreFound) {
  const auto found = roots_between(with_roots({0.2, 0.2, 0.2}), -1.0, 1.0);
  ASSERT_EQ(found.count % 2, 1);
  EXPECT_NEAR(found.x[0], 0.2, 1e-4);
}

}  // namespace
