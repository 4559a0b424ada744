// Energy: in a uniform white surrounding, what does not absorb is as bright as the surrounding, and
// nothing is brighter.
#include <gtest/gtest.h>

#include <array>

#include "bsdf_fixture.h"

namespace lumivec {
namespace {

struct Estimate {
  V3d mean{0.0};
  V3d error{0.0};  // standard
};

// Directional albedo as seen from wo: the mean of sample()'s weights.
Estimate albedo(const Bsdf& bsdf, Random& random, int samples) {
  V3d sum(0.0), squares(0.0);
  for (int i = 0; i < samples; ++i) {
    BsdfSample sample;
    const float u_lobe =
        (i + random()) / samples;  // stratified: which lobe is the largest source of variance
    if (!bsdf.sample(std::min(u_lobe, 0x1.fffffep-1f), random.pair(), sample)) continue;
    const V3d w(sample.weight.x, sample.weight.y, sample.weight.z);
    sum += w;
    squares += w * w;
  }
  Estimate e;
  e.mean = sum / samples;
  for (int c = 0; c < 3; ++c)
    e.error[c] = std::sqrt(std::max(0.0, squares[c] / samples - e.mean[c] * e.mean[c]) / samples);
  return e;
}

constexpr std::array<float, 7> roughnesses = {0.0f, 0.031f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f};
constexpr std::array<float, 6> cosines = {0.03f, 0.2f, 0.45f, 0.7f, 0.8f, 1.0f};

// Of the tables: quadrature and interpolation. Larger where albedos jump from row to row: at
// grazing incidence and around the critical angle.
constexpr double table_error = 5e-3;
constexpr double table_error_grazing = 2e-2;
constexpr double deviations = 5.0;  // of thousands of comparisons none should fail by chance

TEST(BsdfFurnace, LosslessSurfacesNeitherLoseNorGain) {
  Random random(2);
  for (const float roughness : roughnesses)
    for (const NamedSurface& s : white_surfaces(roughness))
      for (const float cosine : cosines) {
        const Estimate e = albedo(make_bsdf(s.surface, at_cosine(cosine)), random, 20000);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(e.mean[c], 1.0,
                      deviations * e.error[c] + (cosine < 0.1f ? table_error_grazing : table_error))
              << s.name << ", cosine " << cosine;
      }
}

TEST(BsdfFurnace, CoatedLosslessSurfacesNeverGainAndLoseLittle) {
  Random random(3);
  for (const float coat_roughness : {0.0f, 0.3f, 1.0f})
    for (const float strength : {1.0f, 0.5f})
      for (const float roughness : {0.0f, 0.1f, 0.4f, 1.0f})
        for (const NamedSurface& s : coated_surfaces(roughness, coat_roughness, strength))
          for (const float cosine : cosines) {
            const Estimate e = albedo(make_bsdf(s.surface, at_cosine(cosine)), random, 2000);
            const double error =
                deviations * e.error.x + (cosine < 0.1f ? table_error_grazing : table_error);
            EXPECT_LT(e.mean.x, 1.0 + error) << s.name << ", cosine " << cosine;
            EXPECT_GT(e.mean.x, 0.92 - error) << s.name << ", cosine " << cosine;
          }
}

// Mirrors and diffuse surfaces under a coat: there the coupling is exact.
TEST(BsdfFurnace, CoatOverMirrorOrDiffuseLosesNothing) {
  Random random(4);
  for (const float coat_roughness : {0.0f, 0.2f, 1.0f})
    for (const bool mirror : {false, true})
      for (const float cosine : cosines) {
        SurfaceParameters p = surface(mirror ? 0.0f : 1.0f);
        p.specular = mirror ? 1.0f : 0.0f;
        p.metallic = mirror ? 1.0f : 0.0f;
        p.clearcoat = 1.0f;
        p.clearcoat_roughness = coat_roughness;
        const Estimate e = albedo(make_bsdf(p, at_cosine(cosine)), random, 20000);
        EXPECT_NEAR(e.mean.x, 1.0, deviations * e.error.x + table_error)
            << "mirror " << mirror << ", coat roughness " << coat_roughness << ", cosine "
            << cosine;
      }
}

TEST(BsdfFurnace, WithoutSpecularTheDiffuseLobeIsLambert) {
  SurfaceParameters p = surface(0.4f);
  p.base_color = Color(0.8f, 0.5f, 0.1f);
  p.specular = 0.0f;
  for (const float coat : {0.0f, 1e-20f}) {  // the second takes the general path
    p.clearcoat = coat;
    const BsdfValue v = make_bsdf(p, at_cosine(0.6f)).eval(at_cosine(0.3f, 2.0f));
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(v.non_specular()[c], p.base_color[c] * 0.3f / pi);
    EXPECT_EQ(v.of(LobeKind::specular), Color(0.0f));
    EXPECT_NEAR(v.pdf_of(LobeKind::diffuse), 0.3f / pi, 1e-6f);
  }
}

TEST(BsdfFurnace, RandomSurfacesWithBentNormalsNeverGain) {
  Random random(5);
  const auto tilted = [&] { return (up + 0.7f * random() * random.direction()).normalized(); };
  for (int i = 0; i < 1500; ++i) {
    SurfaceParameters p = surface(random());
    p.base_color = Color(random(), 1.0f, 0.9f);
    p.metallic = random() < 0.5f ? 0.0f : random();
    p.specular = random() < 0.5f ? 1.0f : random();
    p.transmission = random() < 0.5f ? 0.0f : random();
    p.thin_walled = random() < 0.5f;
    p.clearcoat = random() < 0.3f ? 0.0f : 1.0f;
    p.clearcoat_roughness = random() < 0.3f ? 0.0f : random();
    constexpr std::array<float, 6> etas = {0.0f, 1.0f, 1.33f, 1.5f, 1.0f / 1.5f, 2.42f};
    p.eta = etas[static_cast<std::size_t>(random() * etas.size())];
    p.normal = tilted();
    p.coat_normal = random() < 0.5f ? p.normal : tilted();
    V3f wo = random.direction();
    if (wo.z < 0.0f) wo = -wo;
    const Estimate e = albedo(make_bsdf(p, wo), random, 3000);
    for (int c = 0; c < 3; ++c)
      EXPECT_LT(e.mean[c], 1.0 + deviations * e.error[c] + table_error_grazing)
          << "case " << i << " roughness " << p.roughness << " metallic " << p.metallic
          << " transmission " << p.transmission << " thin " << p.thin_walled << " eta " << p.eta
          << " coat " << p.clearcoat << ' ' << p.clearcoat_roughness << " normals " << p.normal
          << p.coat_normal << " wo " << wo;
  }
}

// Radiance is squeezed into the denser medium's narrower cone, and released behind it: a slab
// changes nothing.
TEST(BsdfFurnace, RadianceIsScaledByTheSquaredIndex) {
  Random random(6);
  for (const float roughness : {0.0f, 0.3f})
    for (const float eta : {1.5f, 1.0f / 1.5f}) {
      SurfaceParameters p = surface(roughness);
      p.transmission = 1.0f;
      p.thin_walled = false;
      p.eta = eta;
      const Bsdf importance = make_bsdf(p, at_cosine(0.9f));
      const Bsdf radiance = make_bsdf(p, at_cosine(0.9f), 0.15f, Transport::radiance);
      int transmitted = 0;
      for (int i = 0; i < 1000; ++i) {
        const float u_lobe = random();
        const V2f u = random.pair();
        BsdfSample a, b;
        const bool found = importance.sample(u_lobe, u, a);
        ASSERT_EQ(found, radiance.sample(u_lobe, u, b));
        if (!found) continue;
        ASSERT_EQ(a.transmitted, b.transmitted);
        transmitted += a.transmitted;
        const float factor = a.transmitted ? 1.0f / (eta * eta) : 1.0f;
        EXPECT_NEAR(b.weight.x, a.weight.x * factor, 1e-5f * a.weight.x);
        if (a.delta) continue;
        EXPECT_NEAR(radiance.eval(a.wi).non_specular().x,
                    importance.eval(a.wi).non_specular().x * factor,
                    1e-5f * importance.eval(a.wi).non_specular().x);
      }
      EXPECT_GT(transmitted, 100);
    }
}

}  // namespace
}  // namespace lumivec
