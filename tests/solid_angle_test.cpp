#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "integrator/sobol.h"
#include "integrator/solid_angle_sampling.h"

namespace lumivec {
namespace {

constexpr double pi = std::numbers::pi;

double triangle_angle(const V3d& a, const V3d& b, const V3d& c) {
  const double la = a.length(), lb = b.length(), lc = c.length();
  return 2.0 * std::abs(std::atan2(a.dot(b.cross(c)),
                                   la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb));
}

V2f point(std::uint32_t i, std::uint32_t seed) {
  const std::array<float, 4> p = sobol_point(i, seed);
  return {p[0], p[1]};
}

// The samples of a polygon fall into each of its parts as often as the part's solid angle says. The
// parts: n × n sub-parallelograms of one corner and two edges, halves along a diagonal for
// triangles.
struct Part {
  double expected = 0.0;  // share
  int count = 0;
};

void expect_uniform(const std::vector<Part>& parts, int samples) {
  double chi2 = 0.0;
  int used = 0;
  for (const Part& part : parts) {
    const double expected = part.expected * samples;
    if (expected < 5.0) continue;
    chi2 += (part.count - expected) * (part.count - expected) / expected;
    ++used;
  }
  // Wilson and Hilferty: the cube root is nearly normal. Low-discrepancy points lie below.
  const double k = used - 1.0;
  if (k < 1.0) return;
  const double z = (std::cbrt(chi2 / k) - (1.0 - 2.0 / (9.0 * k))) / std::sqrt(2.0 / (9.0 * k));
  EXPECT_LT(z, 4.0) << "chi2 " << chi2 << " at " << k << " degrees of freedom";
}

constexpr int cells = 8;
constexpr int samples = 1 << 15;

void check_triangle(const std::array<V3f, 3>& corners, double tolerance = 2e-4) {
  const V3d a(corners[0]), b(corners[1]), c(corners[2]);
  const double solid_angle = triangle_angle(a, b, c);
  EXPECT_NEAR(triangle_solid_angle(corners), solid_angle, tolerance * solid_angle);
  if (solid_angle < min_solid_angle) return;
  const V3d u = b - a, v = c - a, n = u.cross(v);
  std::vector<Part> parts(2 * cells * cells);
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; i + j < cells; ++j) {
      const auto at = [&](int x, int y) {
        return a + u * (double(x) / cells) + v * (double(y) / cells);
      };
      parts[std::size_t(2 * (i * cells + j))].expected =
          triangle_angle(at(i, j), at(i + 1, j), at(i, j + 1)) / solid_angle;
      if (i + j + 1 < cells) {
        parts[std::size_t(2 * (i * cells + j) + 1)].expected =
            triangle_angle(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) / solid_angle;
      }
    }
  }
  for (std::uint32_t s = 0; s < samples; ++s) {
    const V3f w = sample_spherical_triangle(corners, point(s, 1));
    ASSERT_NEAR(w.length(), 1.0f, 1e-5f);
    const V3d d(w);
    const double t = a.dot(n) / d.dot(n);
    ASSERT_GT(t, 0.0);
    const V3d on = d * t - a;
    const double x = on.cross(v).dot(n) / n.length2(), y = u.cross(on).dot(n) / n.length2();
    ASSERT_GT(x, -2e-3);
    ASSERT_GT(y, -2e-3);
    ASSERT_LT(x + y, 1.0 + 2e-3);
    const int i = std::clamp(static_cast<int>(x * cells), 0, cells - 1);
    const int j = std::clamp(static_cast<int>(y * cells), 0, cells - 1 - i);
    const bool upper = x * cells - i + y * cells - j > 1.0 && i + j + 1 < cells;
    ++parts[std::size_t(2 * (i * cells + j) + upper)].count;
  }
  expect_uniform(parts, samples);
}

TEST(solid_angle, triangle) {
  check_triangle({V3f(-1, 1, -1), V3f(1, 1, -1), V3f(0, 1, 1)});
}
TEST(solid_angle, triangle_other_winding) {
  check_triangle({V3f(1, 1, -1), V3f(-1, 1, -1), V3f(0, 1, 1)});
}
TEST(solid_angle, octant) {
  const std::array<V3f, 3> corners = {V3f(1, 0, 0), V3f(0, 1, 0), V3f(0, 0, 1)};
  EXPECT_NEAR(triangle_solid_angle(corners), pi / 2, 1e-5);
  check_triangle(corners);
}
TEST(solid_angle, close_triangle) {
  check_triangle({V3f(-1, 0.02f, -1), V3f(1, 0.02f, -1), V3f(0, 0.02f, 1)}, 2e-3);
}
TEST(solid_angle, far_triangle) {
  check_triangle({V3f(-1, 1000, -1), V3f(1, 1000, -1), V3f(0, 1000, 1)}, 1e-3);
}
TEST(solid_angle, triangle_just_large_enough_to_be_sampled) {
  check_triangle({V3f(-1, 30, -1), V3f(1, 30, -1), V3f(0, 30, 1)}, 2e-3);
  check_triangle({V3f(-1, 40, -1), V3f(1, 40, -1), V3f(0, 40, 1)}, 2e-3);
}
TEST(solid_angle, grazing_triangle) {
  check_triangle({V3f(1, 0.05f, -1), V3f(3, 0.05f, 0), V3f(1, 0.05f, 1)}, 2e-3);
}
TEST(solid_angle, sliver) {
  check_triangle({V3f(-1, 1, 0), V3f(1, 1, 0), V3f(0, 1, 0.02f)}, 2e-3);
}
TEST(solid_angle, scaled_triangles) {
  for (const float s : {1e-6f, 1e-3f, 1e3f, 1e6f}) {
    check_triangle({V3f(-s, s, -s), V3f(s, s, -s), V3f(0, s, s)});
  }
}

void check_rectangle(const V3f& corner, const V3f& edge_u, const V3f& edge_v,
                     double tolerance = 2e-4) {
  const V3d a(corner), u(edge_u), v(edge_v), n = u.cross(v);
  const auto angle = [](const V3d& p, const V3d& du, const V3d& dv) {
    return triangle_angle(p, p + du, p + du + dv) + triangle_angle(p, p + du + dv, p + dv);
  };
  const double solid_angle = angle(a, u, v);
  const SphericalRectangle r = spherical_rectangle(corner, edge_u, edge_v);
  EXPECT_NEAR(r.solid_angle, solid_angle, tolerance * solid_angle + 4e-6);
  if (r.solid_angle < min_solid_angle) return;
  std::vector<Part> parts(cells * cells);
  for (int i = 0; i < cells; ++i) {
    for (int j = 0; j < cells; ++j) {
      parts[std::size_t(i * cells + j)].expected =
          angle(a + u * (double(i) / cells) + v * (double(j) / cells), u / cells, v / cells) /
          solid_angle;
    }
  }
  for (std::uint32_t s = 0; s < samples; ++s) {
    const V3d on = V3d(sample_spherical_rectangle(r, point(s, 1))) - a;
    const double x = on.dot(u) / u.length2(), y = on.dot(v) / v.length2();
    ASSERT_GT(x, -1e-4);
    ASSERT_GT(y, -1e-4);
    ASSERT_LT(x, 1.0 + 1e-4);
    ASSERT_LT(y, 1.0 + 1e-4);
    ASSERT_NEAR(on.dot(n) / n.length(), 0.0, 1e-5 * (a.length() + u.length() + v.length()));
    ++parts[std::size_t(std::clamp(static_cast<int>(x * cells), 0, cells - 1) * cells +
                        std::clamp(static_cast<int>(y * cells), 0, cells - 1))]
          .count;
  }
  expect_uniform(parts, samples);
}

TEST(solid_angle, rectangle) {
  check_rectangle({-1, 1, -1}, {2, 0, 0}, {0, 0, 2});
}
TEST(solid_angle, face_of_a_cube) {
  EXPECT_NEAR(spherical_rectangle({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}).solid_angle, 4 * pi / 6, 1e-5);
  EXPECT_NEAR(spherical_rectangle({-1, -1, -1}, {0, 2, 0}, {2, 0, 0}).solid_angle, 4 * pi / 6,
              1e-5);
}
TEST(solid_angle, rectangle_to_the_side) {
  check_rectangle({2, 1, 3}, {2, 0, 0}, {0, 0, 1});
}
TEST(solid_angle, tilted_rectangle) {
  check_rectangle({0.3f, 0.9f, -0.3f}, {0.5f, 0.5f, 0}, {0.4f, -0.4f, 0.8f});
}
TEST(solid_angle, close_rectangle) {
  check_rectangle({-1, 0.01f, -1}, {2, 0, 0}, {0, 0, 2}, 1e-3);
}
TEST(solid_angle, far_rectangle) {
  check_rectangle({-1, 1000, -1}, {2, 0, 0}, {0, 0, 2});
}
TEST(solid_angle, rectangle_just_large_enough_to_be_sampled) {
  check_rectangle({-1, 60, -1}, {2, 0, 0}, {0, 0, 2}, 2e-3);
}
TEST(solid_angle, grazing_rectangle) {
  check_rectangle({1, 0.05f, -1}, {2, 0, 0}, {0, 0, 2}, 1e-3);
}
TEST(solid_angle, huge_rectangle) {
  check_rectangle({-1000, 1, -1000}, {2000, 0, 0}, {0, 0, 2000}, 1e-3);
}
TEST(solid_angle, long_rectangle) {
  check_rectangle({0.1f, 0.5f, -100}, {0.05f, 0, 0}, {0, 0, 200}, 2e-3);
}
TEST(solid_angle, scaled_rectangles) {
  for (const float s : {1e-6f, 1e-3f, 1e3f, 1e6f}) {
    check_rectangle({-s, s, -s}, {2 * s, 0, 0}, {0, 0, 2 * s});
  }
}

void check_sphere(const V3f& center, float radius) {
  const SphereCone cone = sphere_cone(center, radius);
  const double d = V3d(center).length(), sine = double(radius) / d;
  const double one_minus_cos = sine * sine / (1.0 + std::sqrt(1.0 - sine * sine));
  EXPECT_NEAR(cone.pdf * 2.0 * pi * one_minus_cos, 1.0, 2e-3);
  constexpr int rings = 16, spokes = 16;
  std::vector<Part> parts(rings * spokes);
  for (Part& part : parts) part.expected = 1.0 / (rings * spokes);
  const V3d axis = V3d(center).normalized();
  const V3d t = (std::abs(axis.x) < 0.5 ? V3d(1, 0, 0) : V3d(0, 1, 0)).cross(axis).normalized();
  const V3d b = axis.cross(t);
  int at_the_rim = 0;
  for (std::uint32_t s = 0; s < samples; ++s) {
    float distance = 0.0f;
    const V3f w = sample_sphere_cone(cone, radius, point(s, 1), distance);
    ASSERT_NEAR(w.length(), 1.0f, 1e-5f);
    const V3d on = V3d(w) * double(distance);
    // Relative to what single precision can say of the sphere at this distance.
    ASSERT_NEAR((on - V3d(center)).length(), radius, 2e-3 * radius + 1e-6 * d);
    ASSERT_LT(distance, d);
    const V3d direction = V3d(w).normalized();
    const double sin2 = direction.cross(axis).length2();
    const double height = sin2 / (1.0 + std::sqrt(std::max(0.0, 1.0 - sin2))) / one_minus_cos;
    ASSERT_LT(height, 1.01);
    at_the_rim += height > 0.99;
    const double phi = std::atan2(direction.dot(b), direction.dot(t)) / (2.0 * pi) + 0.5;
    ++parts[std::size_t(std::clamp(static_cast<int>(height * rings), 0, rings - 1) * spokes +
                        std::clamp(static_cast<int>(phi * spokes), 0, spokes - 1))]
          .count;
  }
  EXPECT_GT(at_the_rim, 0);
  // Of tiny cones single precision cannot resolve the cells.
  if (sine > 1e-3) expect_uniform(parts, samples);
}

TEST(solid_angle, sphere) {
  check_sphere({0.3f, 2, -1}, 0.7f);
}
TEST(solid_angle, sphere_overhead) {
  check_sphere({0, 0, 3}, 0.7f);
}
TEST(solid_angle, sphere_that_fills_half_the_view) {
  check_sphere({0, 1.0001f, 0}, 1.0f);
}
TEST(solid_angle, far_sphere) {
  check_sphere({300, 400, 0}, 1.0f);
}
TEST(solid_angle, tiny_sphere) {
  check_sphere({0, 1, 0.5f}, 1e-4f);
}
TEST(solid_angle, scaled_spheres) {
  for (const float s : {1e-6f, 1e-3f, 1e3f, 1e6f}) check_sphere({0.3f * s, 2 * s, -s}, 0.7f * s);
}

}  // namespace
}  // namespace lumivec
