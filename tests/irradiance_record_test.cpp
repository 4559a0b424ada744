// The split of summed light into a sky and a source, against closed forms.
#include "integrator/irradiance_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace lumivec {
namespace {

constexpr float pi_f = std::numbers::pi_v<float>;
const V3f up(0.0f, 0.0f, 1.0f);

Color relit(const LightSum& sum, const V3f& normal) {
  const SkyAndSource light = split_light(sum, up);
  return light.sky_irradiance(up, normal) + light.source_irradiance(normal);
}

V3f tilted(float angle, float azimuth = 0.0f) {
  return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth),
          std::cos(angle)};
}

// The sum of an evenly bright sky: ∫ ω dω = π n, ∫ dω = 2 π.
LightSum sky(const Color& radiance) {
  LightSum sum;
  for (int c = 0; c < 3; ++c) sum.vector[std::size_t(c)] = radiance[c] * pi_f * up;
  sum.flux = radiance * (2.0f * pi_f);
  return sum;
}

TEST(irradiance_record, even_sky_on_a_bent_normal) {
  const Color radiance(1.0f, 0.5f, 3.0f);
  for (float angle = 0.0f; angle < 1.5f; angle += 0.1f) {
    const Color e = relit(sky(radiance), tilted(angle));
    const float expected = pi_f * 0.5f * (1.0f + std::cos(angle));
    // The sky is a double root there, which rounding moves by its square root.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c], radiance[c] * expected, 1e-3f * radiance[c]);
  }
}

TEST(irradiance_record, one_source_on_a_bent_normal) {
  const V3f direction = tilted(0.7f, 2.0f);
  LightSum sum;
  sum.add(Color(2.0f, 1.0f, 0.0f), direction);
  for (float angle = 0.0f; angle < 1.5f; angle += 0.1f) {
    const V3f n = tilted(angle, -0.5f);
    const Color e = relit(sum, n);
    const float cosine = std::max(0.0f, n.dot(direction));
    EXPECT_NEAR(e.x, 2.0f * cosine, 2e-3f);
    EXPECT_NEAR(e.y, cosine, 2e-3f);
    EXPECT_EQ(e.z, 0.0f);
  }
}

TEST(irradiance_record, both_at_once) {
  LightSum sum = sky(Color(1.0f));
  const V3f direction = tilted(0.4f, 1.0f);
  sum.add(Color(5.0f), direction);
  const V3f n = tilted(0.5f, 3.0f);
  const float expected = pi_f * 0.5f * (1.0f + n.dot(up)) + 5.0f * std::max(0.0f, n.dot(direction));
  EXPECT_NEAR(relit(sum, n).x, expected, 1e-3f * expected);
}

// Whatever came: nothing negative, nothing infinite, and on the surface itself exactly D · n.
TEST(irradiance_record, random_light) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
  for (int i = 0; i < 2000; ++i) {
    LightSum sum;
    const int sources = 1 + int(4 * uniform(random));
    for (int s = 0; s < sources; ++s) {
      const float strength = std::pow(10.0f, 12.0f * uniform(random) - 6.0f);
      sum.add(Color(strength, strength * uniform(random), 0.0f),
              tilted(0.5f * pi_f * uniform(random), 7.0f * uniform(random)));
    }
    const Color e = relit(sum, up), exact = sum.irradiance(up);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(e[c], exact[c], 1e-5f * exact[c] + 1e-12f);
    const Color bent = relit(sum, tilted(uniform(random), 7.0f * uniform(random)));
    for (int c = 0; c < 3; ++c) {
      EXPECT_TRUE(std::isfinite(bent[c]));
      EXPECT_GE(bent[c], 0.0f);
    }
  }
  const Color none = relit(LightSum(), up);
  EXPECT_EQ(none, Color(0.0f));
}

}  // namespace
}  // namespace lumivec
