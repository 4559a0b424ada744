#include "integrator/sampling.h"

#include <gtest/gtest.h>

#include "bsdf_fixture.h"

namespace lumivec {
namespace {

TEST(Sampling, UnitCircleTurnsOnce) {
  for (int i = 0; i < 1 << 14; ++i) {
    const float u = i * 0x1p-14f;
    const V2f p = unit_circle(u);
    EXPECT_NEAR(p.x, std::cos(2.0 * std::numbers::pi * u), 2e-7);
    EXPECT_NEAR(p.y, std::sin(2.0 * std::numbers::pi * u), 2e-7);
  }
  EXPECT_NEAR(unit_circle(0x1.fffffep-1f).x, 1.0f, 1e-6f);
}

TEST(Sampling, DiscIsFilledEvenly) {
  // Means of x², y², x²y² over the unit disc are 1/4, 1/4, 1/24.
  double xx = 0.0, yy = 0.0, xxyy = 0.0;
  constexpr int n = 512;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const V2f d = sample_disc({(i + 0.5f) / n, (k + 0.5f) / n});
      ASSERT_LE(d.length(), 1.0f);
      xx += double(d.x) * d.x;
      yy += double(d.y) * d.y;
      xxyy += double(d.x) * d.x * d.y * d.y;
    }
  EXPECT_NEAR(xx / (n * n), 0.25, 1e-4);
  EXPECT_NEAR(yy / (n * n), 0.25, 1e-4);
  EXPECT_NEAR(xxyy / (n * n), 1.0 / 24.0, 1e-4);
}

TEST(Sampling, CosineHemisphereHasItsMoments) {
  // Means of cosθ and cos²θ under the density cosθ/π are 2/3 and 1/2.
  double first = 0.0, second = 0.0;
  constexpr int n = 512;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const V3f w = sample_cosine_hemisphere({(i + 0.5f) / n, (k + 0.5f) / n});
      ASSERT_NEAR(w.length(), 1.0f, 1e-6f);
      ASSERT_GE(w.z, 0.0f);
      first += w.z;
      second += double(w.z) * w.z;
    }
  EXPECT_NEAR(first / (n * n), 2.0 / 3.0, 1e-4);
  EXPECT_NEAR(second / (n * n), 0.5, 1e-4);
}

TEST(Sampling, EightDirectionsAreThoseOfEachPoint) {
  constexpr float last = 1.0f - 0x1p-24f;
  const std::array<std::array<float, 4>, 8> points = {{{0.9f, 0.5f, 0.5f, 0.9f},
                                                       {0.9f, 0.0f, 0.0f, 0.9f},
                                                       {0.9f, last, 0.0f, 0.9f},
                                                       {0.9f, 0.0f, last, 0.9f},
                                                       {0.9f, 0.5f, 0.2f, 0.9f},
                                                       {0.9f, 0.3f, 0.5f, 0.9f},
                                                       {0.9f, 0.7f, 0.6f, 0.9f},
                                                       {0.9f, 0.41f, 0.93f, 0.9f}}};
  std::array<V3f, 8> directions;
  sample_cosine_hemispheres(points, directions);
  for (std::size_t i = 0; i < 8; ++i) {
    const V3f alone = sample_cosine_hemisphere({points[i][1], points[i][2]});
    EXPECT_NEAR((directions[i] - alone).length(), 0.0f, 2e-7f) << i;
  }
}

TEST(Sampling, CornersOfTheSquareAreOnTheHorizon) {
  constexpr float last = 1.0f - 0x1p-24f;
  for (const V2f& u : {V2f(0.0f, 0.0f), V2f(last, 0.0f), V2f(0.0f, last), V2f(0.0f, 0.5f)}) {
    const V3f w = sample_cosine_hemisphere(u);
    EXPECT_NEAR(w.length(), 1.0f, 1e-6f);
    EXPECT_NEAR(w.z, 0.0f, 1e-3f);
  }
  EXPECT_EQ(sample_cosine_hemisphere({0.5f, 0.5f}), up);
}

TEST(Frame, IsOrthonormalAndRightHanded) {
  Random random(51);
  for (int i = 0; i < 10000; ++i) {
    V3f n = random.direction();
    if (i < 3) n = V3f(i == 0, i == 1, i == 2);
    if (i == 3) n = V3f(0.0f, 0.0f, -1.0f);
    if (i == 4) n = V3f(0.0f, 1.0f, -0.0f);
    const Frame f = make_frame(n);
    EXPECT_NEAR(f.t.length(), 1.0f, 1e-5f);
    EXPECT_NEAR((f.t.cross(f.b) - n).length(), 0.0f, 1e-5f);
    EXPECT_NEAR(f.t.dot(f.b), 0.0f, 1e-5f);
    const V3f w = random.direction();
    EXPECT_NEAR((f.to_world(f.to_local(w)) - w).length(), 0.0f, 1e-5f);
  }
}

}  // namespace
}  // namespace lumivec
