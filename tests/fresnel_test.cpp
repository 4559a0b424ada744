#include "integrator/fresnel.h"

#include <gtest/gtest.h>

namespace lumivec {
namespace {

TEST(Fresnel, NormalIncidence) {
  EXPECT_NEAR(fresnel_dielectric(1.0f, 1.5f).reflectance, 0.04f, 1e-7f);
  EXPECT_NEAR(fresnel_dielectric(1.0f, 1.0f / 1.5f).reflectance, 0.04f, 1e-7f);
  EXPECT_NEAR(fresnel_dielectric(1.0f, 2.0f).reflectance, 1.0f / 9.0f, 1e-7f);
  EXPECT_NEAR(normal_reflectance(1.5f), 0.04f, 1e-7f);
  EXPECT_EQ(normal_reflectance(0.0f), 1.0f);
}

// At Brewster's angle, tanθ = η, nothing of the parallel polarisation is reflected.
TEST(Fresnel, BrewsterAngle) {
  const float eta = 1.5f;
  const float c = 1.0f / std::sqrt(1.0f + eta * eta);
  const float perpendicular = (eta * eta - 1.0f) / (eta * eta + 1.0f);
  EXPECT_NEAR(fresnel_dielectric(c, eta).reflectance, 0.5f * perpendicular * perpendicular, 1e-6f);
}

TEST(Fresnel, GrazingIncidenceReflectsAll) {
  for (const float eta : {1.0001f, 1.33f, 1.5f, 2.42f, 100.0f, 1.0f / 1.5f})
    EXPECT_NEAR(fresnel_dielectric(0.0f, eta).reflectance, 1.0f, 1e-6f) << eta;
}

TEST(Fresnel, TotalInternalReflection) {
  const float eta = 1.0f / 1.5f;
  const float critical = std::sqrt(1.0f - eta * eta);
  EXPECT_EQ(fresnel_dielectric(critical - 1e-4f, eta).reflectance, 1.0f);
  EXPECT_EQ(fresnel_dielectric(critical - 1e-4f, eta).cos_transmitted, 0.0f);
  EXPECT_LT(fresnel_dielectric(critical + 1e-4f, eta).reflectance, 1.0f);
  EXPECT_GT(fresnel_dielectric(critical + 1e-4f, eta).cos_transmitted, 0.0f);
}

TEST(Fresnel, BothSidesReflectEqually) {
  for (const float eta : {1.001f, 1.33f, 1.5f, 2.42f})
    for (float c = 0.01f; c <= 1.0f; c += 0.01f) {
      const Refraction outside = fresnel_dielectric(c, eta);
      const Refraction inside = fresnel_dielectric(outside.cos_transmitted, 1.0f / eta);
      EXPECT_NEAR(inside.reflectance, outside.reflectance, 1e-3f) << eta << ' ' << c;
      EXPECT_NEAR(inside.cos_transmitted, c, 1e-3f) << eta << ' ' << c;
    }
}

TEST(Fresnel, SnellsLaw) {
  const Refraction r = fresnel_dielectric(0.8f, 1.5f);  // sin 0.6 becomes sin 0.4
  EXPECT_NEAR(r.cos_transmitted, std::sqrt(1.0f - 0.16f), 1e-6f);
}

TEST(Fresnel, NegativeCosinesOfRoundingAreGrazing) {
  for (const float eta : {1.0f, 1.5f, 1.0f / 1.5f})
    EXPECT_NEAR(fresnel_dielectric(-1e-8f, eta).reflectance, 1.0f, 1e-6f) << eta;
}

TEST(Fresnel, EqualIndicesReflectNothing) {
  for (const float c : {1e-6f, 1e-3f, 0.5f, 1.0f}) {
    EXPECT_NEAR(fresnel_dielectric(c, 1.0f).reflectance, 0.0f, 1e-9f) << c;
    EXPECT_NEAR(fresnel_dielectric(c, 1.0f).cos_transmitted, c, 1e-7f) << c;
  }
}

// Near equal indices the angles cancel in Snell's usual form; the reflectance must not.
TEST(Fresnel, NearlyEqualIndicesKeepTheirDigits) {
  const double eta = 1.0 + 0x1p-12, c = 0.05;
  const double t = std::sqrt((eta - 1.0) * (eta + 1.0) + c * c) / eta;
  const double parallel = (eta * c - t) / (eta * c + t),
               perpendicular = (c - eta * t) / (c + eta * t);
  const double exact = 0.5 * (parallel * parallel + perpendicular * perpendicular);
  EXPECT_NEAR(fresnel_dielectric(0.05f, 1.0f + 0x1p-12f).reflectance, exact, 1e-3 * exact);
}

TEST(Fresnel, SchlickRunsFromZeroToOne) {
  EXPECT_EQ(schlick_weight(1.0f), 0.0f);
  EXPECT_EQ(schlick_weight(0.0f), 1.0f);
  EXPECT_EQ(schlick_weight(1.0000001f), 0.0f);
  EXPECT_NEAR(schlick_weight(0.5f), 1.0f / 32.0f, 1e-7f);
}

TEST(Fresnel, ShapeOfUnreshapedCurveIsExact) {
  for (const float eta : {1.33f, 1.5f, 2.42f, 1.0f / 1.5f})
    for (float c = 0.0f; c <= 1.0f; c += 0.02f) {
      const float f0 = normal_reflectance(eta);
      EXPECT_NEAR(f0 + (1.0f - f0) * fresnel_shape(c, eta).exact,
                  fresnel_dielectric(c, eta).reflectance, 1e-6f);
    }
}

TEST(Fresnel, ShapeOfTotalReflection) {
  const FresnelShape shape = fresnel_shape(0.3f, 1.0f / 1.5f);
  EXPECT_NEAR(shape.exact, 1.0f, 1e-6f);
  EXPECT_EQ(shape.total, 1.0f);
  EXPECT_EQ(fresnel_shape(0.9f, 1.0f / 1.5f).total, 0.0f);
}

TEST(Fresnel, CurveAddsItsParts) {
  const FresnelCurve curve = {Color(0.1f), Color(0.2f, 0.0f, 0.0f), Color(0.0f, 0.3f, 0.0f),
                              Color(0.0f, 0.0f, 0.4f)};
  const Color value = curve.at({0.5f, 0.25f, 1.0f, 0.0f});
  EXPECT_NEAR(value.x, 0.2f, 1e-6f);
  EXPECT_NEAR(value.y, 0.175f, 1e-6f);
  EXPECT_NEAR(value.z, 0.5f, 1e-6f);
}

}  // namespace
}  // namespace lumivec
