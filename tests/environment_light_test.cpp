#include "integrator/environment_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "integrator/sobol.h"
#include "test_scenes.h"

namespace lumivec::test {
namespace {

// Bright columns, a sun, dark ground, and three colours.
Scene varied(float turn = 0.0f) {
  Scene scene;
  set_environment(scene, 32, 16, [](int x, int y) {
    if (x == 5 && y == 3) return Color(5000.0f, 4000.0f, 3000.0f);
    return y >= 12 ? Color(0.0f) : Color(0.1f * static_cast<float>(x), 1.0f, 0.2f);
  });
  scene.environment.radiance = Color(2.0f, 1.0f, 0.5f);
  scene.environment.rotation = turn;
  return scene;
}

template <typename Function>
double sphere_integral(Function f) {
  constexpr int n = 512;
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    const double theta = pi * (i + 0.5) / n, r = std::sin(theta);
    for (int j = 0; j < 2 * n; ++j) {
      const double phi = pi * (j + 0.5) / n;
      sum += r * f(V3f(static_cast<float>(r * std::cos(phi)), static_cast<float>(std::cos(theta)),
                       static_cast<float>(r * std::sin(phi))));
    }
  }
  return sum * (pi / n) * (pi / n);
}

TEST(environment_light, density_integrates_to_one) {
  for (const float turn : {0.0f, 0.7f}) {
    const Scene scene = varied(turn);
    const EnvironmentLight light(scene);
    EXPECT_NEAR(sphere_integral([&](const V3f& w) { return double(light.pdf(w)); }), 1.0, 5e-3);
  }
  Scene constant;
  constant.environment.radiance = Color(1.0f);
  const EnvironmentLight light(constant);
  EXPECT_NEAR(sphere_integral([&](const V3f& w) { return double(light.pdf(w)); }), 1.0, 1e-4);
}

// Of a sky with a sun, the share of directions that are drawn toward the sun.
TEST(environment_light, share_above_a_density) {
  const Scene scene = varied();
  const EnvironmentLight light(scene);
  constexpr float bright = 1.27f;  // 16 times an even sky's
  constexpr int n = 512;
  int above = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      float pdf = 0.0f;
      light.sample({(i + 0.5f) / n, (j + 0.5f) / n}, pdf);
      above += pdf > bright;
    }
  }
  const double share = light.share_above(bright);
  EXPECT_GT(share, 0.1);
  EXPECT_LT(share, 1.0);
  EXPECT_NEAR(share, double(above) / (n * n), 2.0 / n);  // of the grid
  EXPECT_NEAR(light.share_above(0.0f), 1.0, 1e-5);
  // The texels around the pole are left: the density has no bound there.
  EXPECT_LT(light.share_above(1e9f), 0.01f);
  Scene constant;
  constant.environment.radiance = Color(1.0f);
  EXPECT_EQ(EnvironmentLight(constant).share_above(0.07f), 1.0f);
  EXPECT_EQ(EnvironmentLight(constant).share_above(0.09f), 0.0f);
}

TEST(environment_light, mean_radiance) {
  const Scene scene = varied();
  const EnvironmentLight light(scene);
  const double mean = sphere_integral([&](const V3f& w) {
                        const Color c = light.radiance(w);
                        return double(c.x + c.y + c.z) / 3.0;
                      }) /
                      (4.0 * pi);
  EXPECT_NEAR(light.mean_radiance(), mean, 0.03 * mean);
}

TEST(environment_light, samples_follow_the_density) {
  for (const float turn : {0.0f, -2.0f}) {
    const Scene scene = varied(turn);
    const EnvironmentLight light(scene);
    // Where samples lie, by a grid of directions that does not follow the map's.
    constexpr int rings = 4, spokes = 6, samples = 1 << 18;
    std::vector<double> expected(rings * spokes), counts(rings * spokes);
    const auto cell = [](const V3f& w) {
      const int i = std::clamp(static_cast<int>((w.x + 1.0f) * 0.5f * rings), 0, rings - 1);
      const double phi = std::atan2(w.y, w.z) / (2.0 * pi) + 0.5;
      return std::size_t(i * spokes + std::clamp(static_cast<int>(phi * spokes), 0, spokes - 1));
    };
    for (std::size_t i = 0; i < expected.size(); ++i) {
      expected[i] =
          sphere_integral([&](const V3f& w) { return cell(w) == i ? double(light.pdf(w)) : 0.0; });
    }
    for (std::uint32_t s = 0; s < samples; ++s) {
      const std::array<float, 4> u = sobol_point(s, 3);
      float pdf = 0.0f;
      const V3f w = light.sample(V2f(u[0], u[1]), pdf);
      ASSERT_NEAR(w.length(), 1.0f, 1e-5f);
      ASSERT_GT(pdf, 0.0f);
      ASSERT_NEAR(pdf, light.pdf(w), 1e-3f * pdf);
      counts[cell(w)] += 1.0 / samples;
    }
    for (std::size_t i = 0; i < counts.size(); ++i) {
      EXPECT_NEAR(counts[i], expected[i], 5.0 * std::sqrt(expected[i] / samples) + 5e-4);
    }
  }
}

// Whatever the map, radiance / pdf is bounded by a few times its mean: no fireflies.
TEST(environment_light, weights_are_bounded) {
  const Scene scene = varied();
  const EnvironmentLight light(scene);
  for (std::uint32_t s = 0; s < 100000; ++s) {
    const std::array<float, 4> u = sobol_point(s, 3);
    float pdf = 0.0f;
    const V3f w = light.sample(V2f(u[0], u[1]), pdf);
    const Color c = light.radiance(w);
    ASSERT_LT((c.x + c.y + c.z) / 3.0f / pdf,
              20.0f * 4.0f * static_cast<float>(pi) * light.mean_radiance());
  }
}

TEST(environment_light, what_has_radiance_has_density) {
  const Scene scene = varied();
  const EnvironmentLight light(scene);
  sphere_integral([&](const V3f& w) {
    if (light.radiance(w) != Color(0.0f)) {
      EXPECT_GT(light.pdf(w), 0.0f);
    }
    return 0.0;
  });
}

float seen(const V3f& w, float turn) {
  Scene scene;
  // One bright texel a quarter to the right of the centre, a little above the horizon.
  set_environment(scene, 64, 32, [](int x, int y) {
    return Color(x >= 46 && x <= 49 && y >= 12 && y <= 15 ? 1.0f : 0.0f);
  });
  scene.environment.rotation = turn;
  return EnvironmentLight(scene).radiance(w.normalized()).x;
}

TEST(environment_light, directions) {
  const auto quarter = static_cast<float>(pi / 2);
  EXPECT_EQ(seen({1, 0.2f, 0}, 0.0f), 1.0f);
  EXPECT_EQ(seen({1, -0.2f, 0}, 0.0f), 0.0f);
  EXPECT_EQ(seen({-1, 0.2f, 0}, 0.0f), 0.0f);
  EXPECT_EQ(seen({0, 0.2f, 1}, 0.0f), 0.0f);
  EXPECT_EQ(seen({0, 0.2f, -1}, 0.0f), 0.0f);
  // Counter-clockwise from above: +X turns to -Z.
  EXPECT_EQ(seen({0, 0.2f, -1}, quarter), 1.0f);
  EXPECT_EQ(seen({0, 0.2f, 1}, -quarter), 1.0f);
  EXPECT_EQ(seen({-1, 0.2f, 0}, 2 * quarter), 1.0f);
}

TEST(environment_light, the_seam_and_the_poles_are_continuous) {
  const Scene scene = varied();
  const EnvironmentLight light(scene);
  const Color left = light.radiance(V3f(-1e-6f, 0.1f, 1).normalized());
  const Color right = light.radiance(V3f(1e-6f, 0.1f, 1).normalized());
  EXPECT_NEAR(left.x, right.x, 1e-3f);
  for (const float y : {1.0f, -1.0f}) {
    const Color c = light.radiance(V3f(0, y, 0));
    EXPECT_TRUE(std::isfinite(c.x));
    EXPECT_TRUE(std::isfinite(light.pdf(V3f(0, y, 0))));
  }
}

TEST(environment_light, black) {
  Scene none;
  EXPECT_TRUE(EnvironmentLight(none).black());
  set_environment(none, 4, 2, [](int, int) { return Color(0.0f); });
  EXPECT_TRUE(EnvironmentLight(none).black());
}

}  // namespace
}  // namespace lumivec::test
