// Edge terms against the closed form of a rectangle, and their derivatives against differences.
#include "integrator/form_factor_derivatives.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lumivec {
namespace {

// Irradiance of a rectangle of radiance 1 parallel to the receiver, one corner right above it.
// Source: Howell's catalogue of configuration factors, C-4.
double corner_irradiance(double a, double b, double height) {
  const double x = a / height, y = b / height;
  const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return 0.5 * (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry));
}

double polygon(const std::vector<V3d>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    sum += edge_form_factor(corners[i], corners[(i + 1) % corners.size()]).value;
  }
  return sum;
}

TEST(form_factor_derivatives, rectangle) {
  for (const double height : {0.1, 1.0, 30.0}) {
    const double e = polygon({{0, 0, height}, {2, 0, height}, {2, 3, height}, {0, 3, height}});
    EXPECT_NEAR(e, corner_irradiance(2, 3, height), 1e-12);
  }
}

TEST(form_factor_derivatives, agree_with_differences) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const V3d a(uniform(random), uniform(random), 0.2 + std::abs(uniform(random)));
    // Edges of all lengths, so that both ways of evaluation are met.
    const double length = std::pow(10.0, -2.0 + 2.0 * std::abs(uniform(random)));
    V3d b = a + V3d(uniform(random), uniform(random), uniform(random)) * length;
    b.z = std::max(b.z, 0.1);
    const double h = 1e-4;
    const auto at = [&](double x, double y) {
      return edge_form_factor(a - V3d(x, y, 0), b - V3d(x, y, 0));
    };
    const PlaneDerivatives d = at(0, 0);
    const double scale = std::abs(d.value) + length;
    EXPECT_NEAR(d.gx, (at(h, 0).value - at(-h, 0).value) / (2 * h), 1e-4 * scale);
    EXPECT_NEAR(d.gy, (at(0, h).value - at(0, -h).value) / (2 * h), 1e-4 * scale);
    EXPECT_NEAR(d.hxx, (at(h, 0).gx - at(-h, 0).gx) / (2 * h), 1e-3 * scale);
    EXPECT_NEAR(d.hxy, (at(0, h).gx - at(0, -h).gx) / (2 * h), 1e-3 * scale);
    EXPECT_NEAR(d.hxy, (at(h, 0).gy - at(-h, 0).gy) / (2 * h), 1e-3 * scale);
    EXPECT_NEAR(d.hyy, (at(0, h).gy - at(0, -h).gy) / (2 * h), 1e-3 * scale);
  }
}

TEST(form_factor_derivatives, degenerate_edges_are_finite) {
  const V3d p(0.3, -0.2, 0.7);
  for (const auto& [a, b] : {std::pair(p, p), std::pair(p, -p), std::pair(p, 2.0 * p),
                             std::pair(V3d(0.0), p), std::pair(p * 1e-20, p * 1e20)}) {
    const PlaneDerivatives d = edge_form_factor(a, b);
    for (const double v : {d.value, d.gx, d.gy, d.hxx, d.hxy, d.hyy}) EXPECT_TRUE(std::isfinite(v));
  }
}

TEST(form_factor_derivatives, principal_curvature_diagonalises) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    PlaneDerivatives d;
    d.hxx = uniform(random);
    d.hxy = uniform(random);
    d.hyy = uniform(random);
    const Curvature c = principal_curvature(d);
    const double x = c.axis_x, y = c.axis_y;
    EXPECT_NEAR(x * x + y * y, 1.0, 1e-12);
    EXPECT_GE(c.large, c.small);
    EXPECT_NEAR(std::hypot(d.hxx * x + d.hxy * y, d.hxy * x + d.hyy * y), c.large, 1e-12);
    EXPECT_NEAR(std::abs(d.hxx * y * y - 2 * d.hxy * x * y + d.hyy * x * x), c.small, 1e-12);
  }
}

}  // namespace
}  // namespace lumivec
