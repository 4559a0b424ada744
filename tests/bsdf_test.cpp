// What the BSDF promises its callers: kinds, sides, reciprocity, delta lobes, agreement of sample()
// with eval().
#include <gtest/gtest.h>

#include <array>

#include "bsdf_fixture.h"

namespace lumivec {
namespace {

Color sum(const BsdfValue& v) {
  return v.non_specular() + v.of(LobeKind::specular);
}

SurfaceParameters glass(float roughness, float eta) {
  SurfaceParameters p = surface(roughness);
  p.transmission = 1.0f;
  p.thin_walled = false;
  p.eta = eta;
  return p;
}

SurfaceParameters thin(float roughness) {
  SurfaceParameters p = surface(roughness);
  p.transmission = 1.0f;
  return p;
}

std::vector<NamedSurface> all_surfaces() {
  std::vector<NamedSurface> all;
  for (const float roughness : {0.0f, 0.031f, 0.1f, 0.3f, 1.0f}) {
    for (const NamedSurface& s : white_surfaces(roughness)) all.push_back(s);
    for (const float coat_roughness : {0.0f, 0.05f, 0.5f})
      for (const NamedSurface& s : coated_surfaces(roughness, coat_roughness, 0.8f))
        all.push_back(s);
  }
  return all;
}

TEST(Bsdf, SampleTimesDensityIsEval) {
  Random random(21);
  for (const NamedSurface& s : all_surfaces()) {
    const Bsdf bsdf = make_bsdf(s.surface, at_cosine(0.05f + 0.95f * random()));
    for (int i = 0; i < 50; ++i) {
      BsdfSample sample;
      if (!bsdf.sample(random(), random.pair(), sample) || sample.delta) continue;
      const BsdfValue v = bsdf.eval(sample.wi);
      const Color value = v.of(sample.kind);
      EXPECT_FLOAT_EQ(sample.pdf, v.pdf_of(sample.kind)) << s.name;
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sample.weight[c] * sample.pdf, value[c], 1e-5f * value[c]) << s.name;
    }
  }
}

// Light goes either way equally: f(o, i) cos_o = f(i, o) cos_i, and with η² for what crosses into
// another index.
TEST(Bsdf, IsReciprocal) {
  Random random(22);
  for (const NamedSurface& s : all_surfaces()) {
    for (int i = 0; i < 60; ++i) {
      V3f wo = random.direction();
      if (wo.z < 0.0f) wo = -wo;
      const Bsdf forth = make_bsdf(s.surface, wo, 0.15f, Transport::radiance);
      BsdfSample sample;  // directions that matter …
      V3f wi = random.direction();
      if (i % 2 == 0 && forth.sample(random(), random.pair(), sample) && !sample.delta)
        wi = sample.wi;
      if (std::abs(wi.z) < 1e-3f || wo.z < 1e-3f)
        continue;  // … but not those whose normals would be bent
      const bool crosses = wi.z < 0.0f;
      const Bsdf back =
          make_bsdf(crosses ? from_below(s.surface) : s.surface, wi, 0.15f, Transport::radiance);
      const BsdfValue a = forth.eval(wi);
      const BsdfValue b = back.eval(wo);
      const float eta2 = crosses && !s.surface.thin_walled ? s.surface.eta * s.surface.eta : 1.0f;
      for (int c = 0; c < 3; ++c)
        for (const LobeKind kind :
             {LobeKind::diffuse, LobeKind::broad, LobeKind::glossy, LobeKind::specular}) {
          const float f = a.of(kind)[c] / std::abs(wi.z) * eta2;
          const float g = b.of(kind)[c] / wo.z;
          // Half vectors of sharp lobes are only as good as single precision.
          const float tolerance = s.surface.roughness < 0.2f ? 2e-2f : 2e-3f;
          EXPECT_NEAR(f, g, tolerance * std::max(f, g) + 1e-5f)
              << s.name << ", wo " << wo << ", wi " << wi << ", kind " << int(kind);
        }
    }
  }
}

TEST(Bsdf, DeltaBelowTheLimitAndSpecularBelowTheThreshold) {
  SurfaceParameters p = surface(0.0f);
  p.metallic = 1.0f;
  const V3f wo = at_cosine(0.7f);
  for (const auto& [roughness, specular, delta] : {std::tuple(0.0f, true, true),
                                                   {0.0299f, true, true},
                                                   {0.0301f, true, false},
                                                   {0.1499f, true, false},
                                                   {0.15f, false, false},
                                                   {1.0f, false, false}}) {
    p.roughness = roughness;
    const Bsdf bsdf = make_bsdf(p, wo);
    EXPECT_EQ(bsdf.has(LobeKind::specular), specular) << roughness;
    EXPECT_EQ(bsdf.has_non_specular(), !specular) << roughness;
    EXPECT_EQ(bsdf.has(LobeKind::glossy), !specular && roughness < glossy_roughness) << roughness;
    EXPECT_EQ(bsdf.has_non_delta(), !delta) << roughness;
    BsdfSample sample;
    ASSERT_TRUE(bsdf.sample(0.3f, V2f(0.3f, 0.1f), sample)) << roughness;
    EXPECT_EQ(sample.kind == LobeKind::specular, specular) << roughness;
    EXPECT_EQ(sample.delta, delta) << roughness;
  }
}

TEST(Bsdf, ThresholdOfOneMakesAllButDiffuseSpecular) {
  SurfaceParameters p = surface(0.9f);
  p.clearcoat = 1.0f;
  p.clearcoat_roughness = 0.8f;
  const Bsdf bsdf = make_bsdf(p, at_cosine(0.5f), 1.0f);
  const BsdfValue v = bsdf.eval(at_cosine(0.5f, 3.0f));
  EXPECT_GT(v.of(LobeKind::specular).x, 0.0f);
  EXPECT_GT(v.non_specular().x, 0.0f);
  EXPECT_TRUE(bsdf.has(LobeKind::specular));
  EXPECT_TRUE(bsdf.has(LobeKind::diffuse));
}

// The threshold sorts light into terms and changes nothing of it.
TEST(Bsdf, KindsAddUpToTheSameForAnyThreshold) {
  Random random(23);
  for (const NamedSurface& s : coated_surfaces(0.3f, 0.1f)) {
    const V3f wo = at_cosine(0.6f);
    for (int i = 0; i < 20; ++i) {
      const V3f wi = random.direction();
      const Color reference = sum(make_bsdf(s.surface, wo, 0.0f).eval(wi));
      for (const float threshold : {0.15f, 0.31f, 1.0f}) {
        const Color value = sum(make_bsdf(s.surface, wo, threshold).eval(wi));
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(value[c], reference[c], 1e-5f * reference[c]) << s.name;
      }
    }
  }
}

TEST(Bsdf, IsContinuousInRoughnessAcrossTheThreshold) {
  for (const auto& change :
       {+[](SurfaceParameters&) {}, +[](SurfaceParameters& p) { p.metallic = 1.0f; },
        +[](SurfaceParameters& p) { p.transmission = 0.5f; },
        +[](SurfaceParameters& p) {
          p.transmission = 1.0f;
          p.thin_walled = false;
        }}) {
    for (const V3f& wi : {at_cosine(0.8f, 3.3f), at_cosine(0.2f, 1.0f), -at_cosine(0.9f, 1.0f)}) {
      float before = -1.0f;
      for (float roughness = 0.1f; roughness < 0.2f; roughness += 1e-4f) {
        SurfaceParameters p = surface(roughness);
        change(p);
        const float value = sum(make_bsdf(p, at_cosine(0.7f)).eval(wi)).x;
        if (before >= 0.0f) {
          EXPECT_NEAR(value, before, 0.02f * before + 1e-5f) << roughness;
        }
        before = value;
      }
    }
  }
}

TEST(Bsdf, ReflectsAndTransmitsByTheGeometricNormal) {
  Random random(24);
  for (const NamedSurface& s : coated_surfaces(0.5f, 0.4f)) {
    SurfaceParameters p = s.surface;
    p.normal = V3f(0.28f, 0.0f, 0.96f);
    p.coat_normal = V3f(0.0f, -0.28f, 0.96f);
    const Bsdf bsdf = make_bsdf(p, at_cosine(0.7f));
    for (int i = 0; i < 200; ++i) {
      BsdfSample sample;
      if (bsdf.sample(random(), random.pair(), sample)) {
        EXPECT_EQ(sample.transmitted, sample.wi.z < 0.0f) << s.name;
        const bool coat = sample.wi.z > 0.0f && sample.wi.dot(p.coat_normal) > 0.0f;
        EXPECT_TRUE(coat || sample.wi.z * sample.wi.dot(p.normal) > 0.0f) << s.name;
      }
      const V3f wi = random.direction();
      const bool sides_differ =
          wi.z * wi.dot(p.normal) < 0.0f && wi.z * wi.dot(p.coat_normal) < 0.0f;
      if (sides_differ) {
        EXPECT_EQ(sum(bsdf.eval(wi)), Color(0.0f)) << s.name;
      }
    }
  }
}

TEST(Bsdf, ShadingNormalThatMirrorsBelowTheSurfaceIsBent) {
  SurfaceParameters p = surface(0.0f);
  p.metallic = 1.0f;
  Random random(25);
  for (int i = 0; i < 1000; ++i) {
    p.normal = random.direction();
    p.normal.z = std::abs(p.normal.z) + 1e-3f;
    p.normal = p.coat_normal = p.normal.normalized();
    const V3f wo = at_cosine(0.002f + 0.998f * random());
    const Bsdf bsdf = make_bsdf(p, wo);
    BsdfSample sample;
    ASSERT_TRUE(bsdf.sample(0.5f, random.pair(), sample)) << p.normal << wo;
    EXPECT_GT(sample.wi.z, 0.0f);
    const V3f mirrored = 2.0f * p.normal.dot(wo) * p.normal - wo;
    if (p.normal.dot(wo) > 0.01f && mirrored.z > 0.02f) {
      EXPECT_LT((sample.wi - mirrored).length(), 1e-4f) << "bent without need";
    }
  }
}

TEST(Bsdf, ShadingNormalBehindTheViewIsBentToIt) {
  const V3f wo = at_cosine(0.02f, 0.0f);
  for (const float specular : {0.0f, 1.0f}) {
    SurfaceParameters p = surface(0.8f);
    p.specular = specular;
    p.normal = V3f(-0.3f, 0.0f, 1.0f).normalized();
    ASSERT_LT(wo.dot(p.normal), 0.0f);
    const Bsdf bsdf = make_bsdf(p, wo);
    EXPECT_GT(sum(bsdf.eval(up)).x, 0.0f);
    BsdfSample sample;
    EXPECT_TRUE(bsdf.sample(0.9f, V2f(0.5f), sample));
  }
}

TEST(Bsdf, OpaqueSurfacesPassNothing) {
  Random random(25);
  const Bsdf bsdf = make_bsdf(surface(0.4f), at_cosine(0.6f));
  for (int i = 0; i < 100; ++i) {
    const V3f wi = random.direction();
    if (wi.z < 0.0f) {
      EXPECT_EQ(sum(bsdf.eval(wi)), Color(0.0f));
    }
  }
  EXPECT_EQ(bsdf.thin_transmittance(), Color(0.0f));
}

TEST(Bsdf, BlackSurfaceAbsorbs) {
  SurfaceParameters p = surface(0.5f);
  p.base_color = Color(0.0f);
  p.specular = 0.0f;
  for (const float coat : {0.0f, 1e-20f}) {
    p.clearcoat = coat;
    const Bsdf bsdf = make_bsdf(p, at_cosine(0.6f));
    BsdfSample sample;
    EXPECT_FALSE(bsdf.sample(0.5f, V2f(0.4f, 0.6f), sample));
    EXPECT_FALSE(bsdf.has_broad());
    EXPECT_FALSE(bsdf.has_non_delta());
  }
}

TEST(Bsdf, SmoothGlassReflectsAndRefractsAsFresnelAndSnellSay) {
  const SurfaceParameters p = glass(0.0f, 1.5f);
  const V3f wo = at_cosine(1.0f);
  const Bsdf bsdf = make_bsdf(p, wo, 0.15f, Transport::radiance);
  BsdfSample sample;
  ASSERT_TRUE(bsdf.sample(0.02f, V2f(0.5f), sample));
  EXPECT_FALSE(sample.transmitted);
  EXPECT_NEAR(sample.pdf * sample.weight.x, 0.04f, 1e-6f);
  ASSERT_TRUE(bsdf.sample(0.5f, V2f(0.5f), sample));
  EXPECT_TRUE(sample.transmitted);
  EXPECT_TRUE(sample.delta);
  EXPECT_NEAR(sample.pdf * sample.weight.x, 0.96f / 2.25f, 1e-5f);
  const V3f oblique(0.6f, 0.0f, 0.8f);
  ASSERT_TRUE(make_bsdf(p, oblique).sample(0.9f, V2f(0.5f), sample));
  EXPECT_NEAR(sample.wi.x, -0.4f, 1e-6f);
  EXPECT_LT(sample.wi.z, 0.0f);
  EXPECT_FALSE(bsdf.has_non_delta());
}

TEST(Bsdf, RadianceThroughASlabKeepsItsValue) {
  const V3f wo(0.6f, 0.0f, 0.8f);
  BsdfSample in, out;
  ASSERT_TRUE(
      make_bsdf(glass(0.0f, 1.5f), wo, 0.15f, Transport::radiance).sample(0.9f, V2f(0.5f), in));
  ASSERT_TRUE(in.transmitted);
  const V3f inside = -in.wi;  // as the slab's far face sees it
  ASSERT_TRUE(make_bsdf(glass(0.0f, 1.0f / 1.5f), inside, 0.15f, Transport::radiance)
                  .sample(0.9f, V2f(0.5f), out));
  ASSERT_TRUE(out.transmitted);
  EXPECT_NEAR(out.wi.x, -0.6f, 1e-6f);
  EXPECT_NEAR(in.weight.x * in.pdf * out.weight.x * out.pdf, std::pow(1.0f - 0.0439f, 2.0f), 1e-4f);
  EXPECT_NEAR(in.weight.x * out.weight.x, 1.0f, 1e-5f);
}

TEST(Bsdf, TransmissionIsTintedOncePerCrossing) {
  const Color tint(0.9f, 0.4f, 0.1f);
  for (const float roughness : {0.0f, 0.3f})
    for (const bool thin_walled : {false, true}) {
      SurfaceParameters p = thin_walled ? thin(roughness) : glass(roughness, 1.5f);
      const Bsdf white = make_bsdf(p, at_cosine(0.7f));
      p.base_color = tint;
      const Bsdf tinted = make_bsdf(p, at_cosine(0.7f));
      const V3f wi = -at_cosine(0.8f, 3.0f);
      for (int c = 0; c < 3; ++c) {
        if (roughness > 0.0f) {
          EXPECT_NEAR(sum(tinted.eval(wi))[c], tint[c] * sum(white.eval(wi))[c], 1e-4f);
          EXPECT_NEAR(sum(tinted.eval(-wi))[c], sum(white.eval(-wi))[c], 1e-4f);
        } else if (thin_walled) {
          EXPECT_NEAR(tinted.thin_transmittance()[c], tint[c] * white.thin_transmittance()[c],
                      1e-6f);
        }
      }
    }
}

TEST(Bsdf, ThinTransmittanceIsTheDeltaLobeStraightThrough) {
  const V3f wo = at_cosine(0.3f);
  for (const float coat : {0.0f, 1.0f}) {
    SurfaceParameters p = thin(0.0f);
    p.base_color = Color(0.9f, 0.8f, 0.1f);
    p.clearcoat = coat;
    const Bsdf bsdf = make_bsdf(p, wo);
    BsdfSample sample;
    ASSERT_TRUE(bsdf.sample(0.999f, V2f(0.5f), sample));
    ASSERT_TRUE(sample.transmitted && sample.delta);
    EXPECT_NEAR((sample.wi + wo).length(), 0.0f, 1e-6f);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(bsdf.thin_transmittance()[c], sample.weight[c] * sample.pdf, 1e-6f);
    EXPECT_GT(bsdf.thin_transmittance().x, 0.0f);
  }
  EXPECT_EQ(make_bsdf(thin(0.2f), wo).thin_transmittance(), Color(0.0f));
  EXPECT_EQ(make_bsdf(glass(0.0f, 1.5f), wo).thin_transmittance(), Color(0.0f));
}

// A rough boundary between equal indices is no boundary.
TEST(Bsdf, MatchedIndexPassesStraight) {
  for (const float roughness : {0.0f, 0.5f, 1.0f}) {
    const V3f wo = at_cosine(0.4f);
    const Bsdf bsdf = make_bsdf(glass(roughness, 1.0f), wo);
    BsdfSample sample;
    ASSERT_TRUE(bsdf.sample(0.7f, V2f(0.2f, 0.7f), sample)) << roughness;
    EXPECT_TRUE(sample.delta && sample.transmitted);
    EXPECT_NEAR((sample.wi + wo).length(), 0.0f, 1e-6f);
    EXPECT_NEAR(sample.weight.x, 1.0f, 1e-6f);
  }
}

// Light that strikes from within beyond the critical angle cannot leave, whatever the strength of
// the reflection.
TEST(Bsdf, TotalReflectionIsTotal) {
  for (const float specular : {1.0f, 0.2f, 0.0f}) {
    SurfaceParameters p = glass(0.0f, 1.0f / 1.5f);
    p.specular = specular;
    BsdfSample sample;
    ASSERT_TRUE(make_bsdf(p, at_cosine(0.5f)).sample(0.99f, V2f(0.5f), sample));
    EXPECT_FALSE(sample.transmitted);
    EXPECT_NEAR(sample.weight.x, 1.0f, 1e-6f);
  }
}

TEST(Bsdf, SpecularFactorsScaleTheDielectricsReflection) {
  const V3f wo = at_cosine(1.0f);
  const auto reflectance = [&](const SurfaceParameters& p) {
    BsdfSample sample;
    EXPECT_TRUE(make_bsdf(p, wo).sample(0.0f, V2f(0.5f), sample));
    return Color(sample.weight * sample.pdf);
  };
  SurfaceParameters p = surface(0.0f);
  EXPECT_NEAR(reflectance(p).x, 0.04f, 1e-6f);
  p.specular = 0.5f;
  EXPECT_NEAR(reflectance(p).x, 0.02f, 1e-6f);
  p.specular = 1.0f;
  p.specular_color = Color(0.5f, 2.0f, 100.0f);
  EXPECT_NEAR(reflectance(p).x, 0.02f, 1e-6f);
  EXPECT_NEAR(reflectance(p).y, 0.08f, 1e-6f);
  EXPECT_NEAR(reflectance(p).z, 1.0f, 1e-6f);
  p.eta = 0.0f;
  EXPECT_NEAR(reflectance(p).x, 0.5f, 1e-6f);
}

TEST(Bsdf, MetalReflectsItsColour) {
  SurfaceParameters p = surface(0.0f);
  p.metallic = 1.0f;
  p.base_color = Color(1.0f, 0.7f, 0.3f);
  BsdfSample sample;
  ASSERT_TRUE(make_bsdf(p, at_cosine(1.0f)).sample(0.5f, V2f(0.5f), sample));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sample.weight[c], p.base_color[c], 1e-6f);
  ASSERT_TRUE(make_bsdf(p, at_cosine(0.001f)).sample(0.5f, V2f(0.5f), sample));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sample.weight[c], 1.0f, 1e-2f);
}

TEST(Bsdf, CoatHasItsOwnNormalAndRoughness) {
  SurfaceParameters p = surface(1.0f);
  p.clearcoat = 1.0f;
  p.coat_normal = V3f(0.6f, 0.0f, 0.8f);
  const Bsdf bsdf = make_bsdf(p, up);
  BsdfSample sample;
  ASSERT_TRUE(bsdf.sample(0.0f, V2f(0.5f), sample));
  EXPECT_TRUE(sample.delta);
  EXPECT_EQ(sample.kind, LobeKind::specular);
  EXPECT_NEAR(sample.wi.x, 0.96f, 1e-6f);
  EXPECT_TRUE(bsdf.has(LobeKind::diffuse));
}

TEST(Bsdf, InPartsEveryDeltaLobeIsDrawnAndTheSumStays) {
  SurfaceParameters p = surface(0.0f);
  p.transmission = 1.0f;
  p.thin_walled = false;
  p.eta = 1.5f;
  for (const float clearcoat : {0.0f, 0.5f}) {
    p.clearcoat = clearcoat;
    p.clearcoat_roughness = 0.0f;
    const Bsdf bsdf = make_bsdf(p, at_cosine(0.8f));
    const int lobes = clearcoat > 0.0f ? 3 : 2;
    ASSERT_EQ(bsdf.delta_lobe_count(), lobes);
    for (const int parts : {3, 8}) {
      const Bsdf split = bsdf.with_probabilities_in_parts(parts);
      // Smooth glass: what each lobe returns is its share, and together they return everything.
      float sum = 0.0f, reflected = 0.0f;
      for (int i = 0; i < parts; ++i) {
        BsdfSample sample;
        ASSERT_TRUE(split.sample((float(i) + 0.5f) / float(parts), V2f(0.5f), sample));
        sum += sample.weight.x / float(parts);
        if (!sample.transmitted) reflected += sample.weight.x / float(parts);
      }
      EXPECT_NEAR(sum, 1.0f, 1e-5f) << parts << " parts, coat " << clearcoat;
      EXPECT_GT(reflected, 0.03f);
      if (clearcoat == 0.0f) {
        EXPECT_NEAR(reflected, fresnel_dielectric(0.8f, 1.5f).reflectance, 1e-5f);
      }
    }
  }
  EXPECT_EQ(make_bsdf(surface(1.0f), up).delta_lobe_count(), 0);
  p.roughness = 0.4f;
  EXPECT_EQ(make_bsdf(p, at_cosine(0.8f)).delta_lobe_count(), 0);
}

}  // namespace
}  // namespace lumivec
