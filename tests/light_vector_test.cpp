#include "integrator/light_vector.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace lumivec {
namespace {

using FCos = std::function<Color(const V3f&)>;
const V3f up(0.0f, 0.0f, 1.0f);

class LightVectorTest : public testing::Test {
 protected:
  float uniform(float low = 0.0f, float high = 1.0f) {
    return std::uniform_real_distribution<float>(low, high)(random_);
  }
  V3f direction() {
    const float z = uniform(), phi = uniform(0.0f, 2.0f * std::numbers::pi_v<float>);
    const float r = std::sqrt(1.0f - z * z);
    return V3f(r * std::cos(phi), r * std::sin(phi), z);
  }
  Color color(float high = 1.0f) {
    const float r = uniform(0.0f, high), g = uniform(0.0f, high);
    return Color(r, g, uniform(0.0f, high));
  }

  std::mt19937 random_{1};
};

FCos diffuse(const Color& albedo) {
  return [=](const V3f& wi) { return albedo * (std::max(0.0f, wi.z) / std::numbers::pi_v<float>); };
}

// A Phong lobe around an axis.
FCos lobe(const V3f& axis, float exponent, const Color& weight) {
  return [=](const V3f& wi) {
    return weight * (std::pow(std::max(0.0f, axis.dot(wi)), exponent) * std::max(0.0f, wi.z));
  };
}

LightIntegrals gather(const FCos& f_cos, const std::vector<std::pair<V3f, Color>>& light) {
  LightIntegrals sum;
  for (const auto& [wi, l] : light) sum.add(wi, l, f_cos(wi));
  return sum;
}

// What holds of every light vector.
void expect_sound(const LightVector& v, const LightIntegrals& light, const FCos& f_cos) {
  EXPECT_NEAR(v.direction.length(), 1.0f, 1e-5f);
  const Color back = relit(v, f_cos(v.direction));
  for (int c = 0; c < 3; ++c) {
    EXPECT_TRUE(std::isfinite(v.magnitude[c]));
    EXPECT_GE(v.magnitude[c], 0.0f);
    EXPECT_NEAR(back[c], light.reflected[c], 1e-5f * light.reflected[c]) << "form " << int(v.form);
    if (v.form != LightVectorForm::radiance) {
      EXPECT_LE(v.magnitude[c], max_brightening * light.incident[c]);
    }
  }
}

TEST_F(LightVectorTest, ReproducesTheRecordForRandomLobesAndLights) {
  int exact = 0;
  constexpr int cases = 3'000;
  for (int i = 0; i < cases; ++i) {
    const FCos broad = diffuse(color()),
               sharp = lobe(direction(), std::exp(uniform(0.0f, 9.0f)), color(10.0f));
    const float mixture = i % 3 == 0 ? 0.0f : i % 3 == 1 ? 1.0f : uniform();
    const FCos f_cos = [&](const V3f& w) { return broad(w) * mixture + sharp(w) * (1 - mixture); };
    std::vector<std::pair<V3f, Color>> light;
    const int lights = 1 + i % 20;
    for (int l = 0; l < lights; ++l) light.emplace_back(direction(), color(100.0f));
    const LightIntegrals sum = gather(f_cos, light);
    const LightVector v = make_light_vector(sum, up, f_cos);
    expect_sound(v, sum, f_cos);
    exact += v.form == LightVectorForm::exact ? 1 : 0;
  }
  EXPECT_GT(exact, cases / 2);
}

TEST_F(LightVectorTest, OfADiffuseSurfaceTheMagnitudeIsThatOfD) {
  const FCos f_cos = diffuse(Color(0.7f, 0.5f, 0.3f));
  std::vector<std::pair<V3f, Color>> light;
  for (int l = 0; l < 50; ++l) light.emplace_back(direction(), Color(uniform()));
  const LightIntegrals sum = gather(f_cos, light);
  const LightVector v = make_light_vector(sum, up, f_cos);
  EXPECT_EQ(v.form, LightVectorForm::exact);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(v.magnitude[c], sum.vector.length(), 1e-4f * sum.vector.length());
}

TEST_F(LightVectorTest, OneSourceIsItself) {
  const V3f wi = V3f(1.0f, 2.0f, 3.0f).normalized();
  const FCos f_cos = lobe(up, 5.0f, Color(1.0f));
  const LightVector v =
      make_light_vector(gather(f_cos, {{wi, Color(4.0f, 2.0f, 1.0f)}}), up, f_cos);
  EXPECT_EQ(v.form, LightVectorForm::exact);
  EXPECT_LT((v.direction - wi).length(), 1e-6f);
  EXPECT_LT((v.magnitude - Color(4.0f, 2.0f, 1.0f)).length(), 1e-5f);
}

TEST_F(LightVectorTest, AnAlbedoMayBeLeftOut) {
  std::vector<std::pair<V3f, Color>> light;
  for (int l = 0; l < 10; ++l) light.emplace_back(direction(), color());
  const FCos with = diffuse(Color(0.2f, 0.4f, 0.6f)), without = diffuse(Color(1.0f));
  const LightVector a = make_light_vector(gather(with, light), up, with),
                    b = make_light_vector(gather(without, light), up, without);
  EXPECT_LT((a.direction - b.direction).length(), 1e-6f);
  EXPECT_LT((a.magnitude - b.magnitude).length(), 1e-5f * b.magnitude.length());
}

TEST_F(LightVectorTest, NoLightIsBlackAndNoFallBack) {
  const FCos f_cos = diffuse(Color(0.5f));
  const LightVector v = make_light_vector(LightIntegrals(), up, f_cos);
  EXPECT_EQ(v.form, LightVectorForm::exact);
  EXPECT_EQ(v.magnitude, Color(0.0f));
  EXPECT_EQ(v.direction, up);
}

TEST_F(LightVectorTest, LightThatIsNotReflectedIsBlackAndNoFallBack) {
  const FCos f_cos = lobe(V3f(1.0f, 0.0f, 0.0f), 50.0f, Color(1.0f));
  const LightIntegrals sum = gather(f_cos, {{V3f(-0.6f, 0.0f, 0.8f), Color(3.0f)}});
  const LightVector v = make_light_vector(sum, up, f_cos);
  EXPECT_EQ(v.form, LightVectorForm::exact);
  EXPECT_EQ(v.magnitude, Color(0.0f));
}

TEST_F(LightVectorTest, BlackChannelsStayBlack) {
  const FCos f_cos = diffuse(Color(0.5f, 0.0f, 0.5f));
  const LightIntegrals sum = gather(f_cos, {{direction(), Color(1.0f, 1.0f, 0.0f)}});
  const LightVector v = make_light_vector(sum, up, f_cos);
  EXPECT_EQ(v.form, LightVectorForm::exact);
  EXPECT_GT(v.magnitude.x, 0.0f);
  EXPECT_EQ(v.magnitude.y, 0.0f);
  EXPECT_EQ(v.magnitude.z, 0.0f);
  expect_sound(v, sum, f_cos);
}

// A sharp lobe and light from everywhere: D is the normal, far from the lobe.
TEST_F(LightVectorTest, DOutsideTheLobeFallsBackOnWhatIsReflected) {
  const V3f mirror = V3f(0.9f, 0.0f, 0.435f).normalized();
  const FCos f_cos = lobe(mirror, 200.0f, Color(10.0f));
  std::vector<std::pair<V3f, Color>> light;
  for (int l = 0; l < 5'000; ++l) light.emplace_back(direction(), Color(0.001f));
  const LightIntegrals sum = gather(f_cos, light);
  const LightVector v = make_light_vector(sum, up, f_cos);
  EXPECT_EQ(v.form, LightVectorForm::weighted);
  EXPECT_GT(v.direction.dot(mirror), 0.98f);
  expect_sound(v, sum, f_cos);
}

TEST_F(LightVectorTest, OppositeLightsCancelInD) {
  // Two lights at the horizon, a hair above it.
  const V3f a = V3f(1.0f, 0.0f, 1e-4f).normalized(), b = V3f(-1.0f, 0.0f, 1e-4f).normalized();
  const FCos f_cos = diffuse(Color(0.5f));
  const LightIntegrals sum = gather(f_cos, {{a, Color(1.0f)}, {b, Color(1.0f)}});
  expect_sound(make_light_vector(sum, up, f_cos), sum, f_cos);
  // D and the reflected vector exactly zero.
  LightIntegrals nothing = sum;
  nothing.vector = nothing.reflected_vector = V3f(0.0f);
  const LightVector v = make_light_vector(nothing, up, f_cos);
  EXPECT_EQ(v.form, LightVectorForm::normal);
  expect_sound(v, nothing, f_cos);
}

TEST_F(LightVectorTest, WithoutAnyDirectionTheRadianceIsKept) {
  // Two narrow lobes, no light in between where D is.
  const V3f a = V3f(0.8f, 0.0f, 0.6f), b = V3f(-0.8f, 0.0f, 0.6f);
  const FCos one = lobe(a, 300.0f, Color(1.0f, 0.0f, 0.0f)),
             two = lobe(b, 300.0f, Color(0.0f, 1.0f, 0.0f));
  const FCos f_cos = [&](const V3f& w) { return one(w) + two(w); };
  const LightIntegrals sum = gather(f_cos, {{a, Color(1.0f)}, {b, Color(1.0f)}});
  const LightVector v = make_light_vector(sum, up, f_cos);
  EXPECT_EQ(v.form, LightVectorForm::radiance);
  EXPECT_EQ(relit(v, Color(123.0f)), sum.reflected);
}

TEST_F(LightVectorTest, GrazingLight) {
  for (const float z : {1e-2f, 1e-4f, 1e-8f, 1e-20f, 1e-38f, 0.0f}) {
    const V3f wi = V3f(1.0f, 0.5f, z).normalized();
    for (const FCos& f_cos :
         {diffuse(Color(0.5f)), lobe(wi, 1000.0f, Color(1e3f)), lobe(up, 1.0f, Color(1e-3f))}) {
      const LightIntegrals sum = gather(f_cos, {{wi, Color(1.0f)}});
      expect_sound(make_light_vector(sum, up, f_cos), sum, f_cos);
    }
  }
}

TEST_F(LightVectorTest, ExtremeRadiance) {
  for (const float scale : {1e-36f, 1e-20f, 1e-6f, 1e6f, 1e20f, 1e35f}) {
    for (int i = 0; i < 200; ++i) {
      const FCos f_cos = i % 2 == 0 ? diffuse(color()) : lobe(direction(), 100.0f, color(10.0f));
      std::vector<std::pair<V3f, Color>> light;
      for (int l = 0; l < 5; ++l) light.emplace_back(direction(), color() * scale);
      const LightIntegrals sum = gather(f_cos, light);
      const LightVector v = make_light_vector(sum, up, f_cos);
      const Color back = relit(v, f_cos(v.direction));
      for (int c = 0; c < 3; ++c) {
        ASSERT_TRUE(std::isfinite(v.magnitude[c]) && v.magnitude[c] >= 0.0f) << scale;
        ASSERT_TRUE(std::isfinite(v.direction[c]));
        ASSERT_NEAR(back[c], sum.reflected[c], 1e-5f * sum.reflected[c] + 1e-37f) << scale;
      }
    }
  }
}

TEST_F(LightVectorTest, UnitDirectionsOfAllLengths) {
  for (const float length : {1e-37f, 1e-30f, 1.0f, 1e30f, 3e38f}) {
    V3f unit(0.0f);
    ASSERT_TRUE(unit_direction(V3f(0.0f, -length, 0.0f), unit));
    EXPECT_EQ(unit, V3f(0.0f, -1.0f, 0.0f));
  }
  V3f unit = up;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(unit_direction(V3f(0.0f), unit));
  EXPECT_FALSE(unit_direction(V3f(nan, 1.0f, 0.0f), unit));
  EXPECT_FALSE(unit_direction(V3f(1.0f, nan, 0.0f), unit));
  EXPECT_FALSE(unit_direction(V3f(std::numeric_limits<float>::infinity(), 0.0f, 0.0f), unit));
  EXPECT_EQ(unit, up);
}

}  // namespace
}  // namespace lumivec
