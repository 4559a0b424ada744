// No parameters and directions within their ranges make the BSDF return anything but finite,
// non-negative light.
#include <gtest/gtest.h>

#include <array>

#include "bsdf_fixture.h"

namespace lumivec {
namespace {

// Values where formulas degenerate, as often as ordinary ones.
float extreme(Random& random) {
  constexpr std::array<float, 10> values = {0.0f,    1.0f,   1e-8f,   1e-3f, 0.0299999f,
                                            0.0300f, 0.031f, 0.1499f, 0.15f, 0.9999999f};
  const float u = random();
  return u < 0.5f ? random() : values[static_cast<std::size_t>(random() * values.size())];
}

float extreme_eta(Random& random) {
  constexpr std::array<float, 14> values = {0.0f,   1.0f,     0.9999999f,  1.0000001f, 0.9999f,
                                            1.001f, 1.5f,     1.0f / 1.5f, 1.33f,      2.42f,
                                            1e-2f,  1.0f / 3, 3.0f,        100.0f};
  return random() < 0.3f ? 0.3f + 3.0f * random()
                         : values[static_cast<std::size_t>(random() * values.size())];
}

// Exactly along, across or within rounding of the axes, or anywhere.
V3f extreme_direction(Random& random) {
  const float u = random();
  if (u < 0.3f) return random.direction();
  V3f v(0.0f);
  if (u < 0.6f) {
    v[static_cast<int>(3.0f * random())] = random() < 0.5f ? -1.0f : 1.0f;
    return v;
  }
  const float phi = 2.0f * pi * random();
  const float z = (random() - 0.5f) * (u < 0.8f ? 1e-7f : 1e-3f);
  return V3f(std::cos(phi), std::sin(phi), z).normalized();
}

SurfaceParameters extreme_surface(Random& random) {
  SurfaceParameters p;
  p.base_color = Color(extreme(random), extreme(random), extreme(random));
  p.metallic = random() < 0.5f ? 0.0f : extreme(random);
  p.roughness = extreme(random);
  p.specular = random() < 0.5f ? 1.0f : extreme(random);
  p.specular_color = Color(1.0f);
  if (random() < 0.3f) p.specular_color = Color(extreme(random), extreme(random) * 30.0f, 1.0f);
  p.transmission = random() < 0.5f ? 0.0f : extreme(random);
  p.thin_walled = random() < 0.5f;
  p.clearcoat = random() < 0.5f ? 0.0f : extreme(random);
  p.clearcoat_roughness = extreme(random);
  p.eta = extreme_eta(random);
  return p;
}

bool sound(const Color& c) {
  return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z) && c.x >= 0.0f &&
         c.y >= 0.0f && c.z >= 0.0f;
}

bool sound(float x) {
  return std::isfinite(x) && x >= 0.0f;
}

bool sound(const BsdfValue& v) {
  return std::all_of(v.f_cos.begin(), v.f_cos.end(), [](const Color& c) { return sound(c); }) &&
         std::all_of(v.pdf.begin(), v.pdf.end(), [](float p) { return sound(p); });
}

std::string describe(const SurfaceParameters& p, const V3f& g, const V3f& wo) {
  std::ostringstream s;
  s.precision(9);
  s << "normal " << p.normal << " coat " << p.coat_normal << " geometric " << g << " wo " << wo
    << " base " << p.base_color << " metallic " << p.metallic << " roughness " << p.roughness
    << " specular " << p.specular << ' ' << p.specular_color << " transmission " << p.transmission
    << " thin " << p.thin_walled << " coat " << p.clearcoat << ' ' << p.clearcoat_roughness
    << " eta " << p.eta;
  return s.str();
}

TEST(BsdfRobustness, AnyInputGivesFiniteLight) {
  Random random(1);
  for (int i = 0; i < 1000000; ++i) {
    SurfaceParameters p = extreme_surface(random);
    const V3f wo = extreme_direction(random);
    V3f geometric = random() < 0.5f ? up : extreme_direction(random);
    if (geometric.dot(wo) < 0.0f) geometric = -geometric;
    p.normal = random() < 0.5f ? geometric : extreme_direction(random);
    p.coat_normal = random() < 0.5f ? p.normal : extreme_direction(random);
    const Bsdf bsdf(p, geometric, wo, test_tables(), extreme(random),
                    random() < 0.5f ? Transport::radiance : Transport::importance);
    ASSERT_TRUE(sound(bsdf.thin_transmittance())) << describe(p, geometric, wo);
    for (int k = 0; k < 3; ++k) {
      V3f wi = extreme_direction(random);
      if (k == 1) wi = wo;
      if (k == 2) wi = -wo;
      ASSERT_TRUE(sound(bsdf.eval(wi))) << describe(p, geometric, wo) << " wi " << wi;
    }
    for (int k = 0; k < 3; ++k) {
      constexpr float last = 1.0f - 0x1p-24f;
      const V2f u =
          k == 0 ? random.pair() : V2f(k == 1 ? 0.0f : last, random() < 0.5f ? last : 0.0f);
      BsdfSample sample;
      if (!bsdf.sample(k == 2 ? last : random(), u, sample)) continue;
      ASSERT_TRUE(sound(sample.weight))
          << describe(p, geometric, wo) << " weight " << sample.weight;
      ASSERT_TRUE(sound(sample.pdf) && sample.pdf > 0.0f) << describe(p, geometric, wo);
      ASSERT_NEAR(sample.wi.length(), 1.0f, 1e-5f) << describe(p, geometric, wo);
      ASSERT_EQ(sample.transmitted, sample.wi.dot(geometric) < 0.0f) << describe(p, geometric, wo);
      ASSERT_TRUE(bsdf.has(sample.kind));
      if (sample.delta) continue;
      ASSERT_TRUE(bsdf.has_non_delta());
      ASSERT_TRUE(sound(bsdf.eval(sample.wi))) << describe(p, geometric, wo);
    }
  }
}

}  // namespace
}  // namespace lumivec
