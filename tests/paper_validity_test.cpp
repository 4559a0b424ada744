#include "integrator/paper_validity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lumivec {
namespace {

const V3f up(0.0f, 0.0f, 1.0f);

V3f tilted(float cosine) {
  return V3f(std::sqrt(1.0f - cosine * cosine), 0.0f, cosine);
}

PaperRecord record() {
  PaperRecord r;
  r.normal = up;
  r.view = up;
  r.mean_distance = 2.0f;
  r.relative_variation = 0.1f;
  return r;
}

PaperParameters parameters() {
  PaperParameters p;
  p.max_variation = 0.3f;
  p.min_normal_cosine = 0.9f;
  p.min_direction_cosine = 0.8f;
  return p;
}

PaperValidity at(const V3f& position, const V3f& normal = up, const V3f& view = up,
                 const PaperRecord& r = record()) {
  return paper_validity(r, position, normal, view, parameters());
}

TEST(PaperValidity, IsOneAtTheRecordItself) {
  const PaperValidity v = at(V3f(0.0f));
  EXPECT_EQ(v.verdict, PaperVerdict::valid);
  EXPECT_FLOAT_EQ(v.weight, 1.0f);
}

TEST(PaperValidity, WeightIsTheProductOfTheFactors) {
  const PaperValidity v = at(V3f(0.0f, 0.5f, 0.0f), tilted(0.96f), tilted(0.85f));
  EXPECT_EQ(v.verdict, PaperVerdict::valid);
  const float distance = 1.0f - 0.5f / 2.0f, variation = 1.0f / (1.0f + 0.5f * 0.1f / 0.3f),
              curvature = (0.96f - 0.9f) / 0.1f, direction = (0.85f - 0.8f) / 0.2f;
  EXPECT_NEAR(v.weight, distance * variation * curvature * direction, 1e-5f);
}

TEST(PaperValidity, RejectsByDistance) {
  EXPECT_EQ(at(V3f(1.99f, 0.0f, 0.0f)).verdict, PaperVerdict::valid);
  EXPECT_EQ(at(V3f(2.0f, 0.0f, 0.0f)).verdict, PaperVerdict::distant);
  EXPECT_EQ(at(V3f(0.0f, 3.0f, 0.0f)).weight, 0.0f);
}

TEST(PaperValidity, RejectsByVariation) {
  PaperRecord r = record();
  r.relative_variation = 0.4f;
  EXPECT_EQ(at(V3f(0.74f, 0.0f, 0.0f), up, up, r).verdict, PaperVerdict::valid);
  EXPECT_EQ(at(V3f(0.76f, 0.0f, 0.0f), up, up, r).verdict, PaperVerdict::varying);
}

TEST(PaperValidity, RejectsByCurvatureAndView) {
  EXPECT_EQ(at(V3f(0.0f), tilted(0.89f)).verdict, PaperVerdict::curved);
  EXPECT_EQ(at(V3f(0.0f), up, tilted(0.79f)).verdict, PaperVerdict::other_view);
  EXPECT_EQ(at(V3f(0.0f), -up).verdict, PaperVerdict::curved);
}

TEST(PaperValidity, ARecordWithoutRoomIsValidNowhere) {
  PaperRecord r = record();
  r.mean_distance = 0.0f;
  EXPECT_EQ(at(V3f(0.0f), up, up, r).verdict, PaperVerdict::distant);
}

TEST(PaperValidity, WeightsAreFromZeroToOneAndZeroIfInvalid) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> u(-1.0f, 1.0f);
  int valid = 0;
  for (int i = 0; i < 20'000; ++i) {
    PaperRecord r = record();
    r.mean_distance = std::abs(u(random)) * 3.0f;
    r.relative_variation = std::abs(u(random));
    const V3f normal = tilted(1.0f - 0.1f * std::abs(u(random))),
              view = tilted(1.0f - 0.3f * std::abs(u(random)));
    const PaperValidity v = at(V3f(u(random), 0.0f, 0.0f), normal, view, r);
    EXPECT_GE(v.weight, 0.0f);
    EXPECT_LE(v.weight, 1.0f);
    if (v.verdict == PaperVerdict::valid) {
      ++valid;
    } else {
      EXPECT_EQ(v.weight, 0.0f);
    }
  }
  EXPECT_GT(valid, 1'000);
}

LightVector light(const V3f& direction, const Color& magnitude,
                  LightVectorForm form = LightVectorForm::exact) {
  LightVector v;
  v.direction = direction;
  v.magnitude = magnitude;
  v.form = form;
  return v;
}

TEST(LightVectorMean, OfEqualOnesIsTheSame) {
  LightVectorMean mean;
  const LightVector v = light(tilted(0.6f), Color(1.0f, 2.0f, 3.0f));
  mean.add(v, 0.2f);
  mean.add(v, 0.7f);
  EXPECT_EQ(mean.count(), 2);
  EXPECT_FLOAT_EQ(mean.mean_weight(), 0.45f);
  EXPECT_LT((mean.light().direction - v.direction).length(), 1e-6f);
  EXPECT_LT((mean.light().magnitude - v.magnitude).length(), 1e-6f);
  EXPECT_EQ(mean.radiance(), Color(0.0f));
}

TEST(LightVectorMean, WeighsMagnitudesAndVectors) {
  LightVectorMean mean;
  mean.add(light(V3f(1.0f, 0.0f, 0.0f), Color(3.0f)), 0.25f);
  mean.add(light(V3f(0.0f, 1.0f, 0.0f), Color(1.0f)), 0.75f);
  EXPECT_LT((mean.light().magnitude - Color(1.5f)).length(), 1e-6f);
  // Both bring the same share of the light.
  EXPECT_LT((mean.light().direction - V3f(1.0f, 1.0f, 0.0f).normalized()).length(), 1e-6f);
}

TEST(LightVectorMean, BlackOnesDoNotTurnTheDirection) {
  LightVectorMean mean;
  mean.add(light(V3f(1.0f, 0.0f, 0.0f), Color(0.0f)), 1.0f);
  mean.add(light(up, Color(2.0f)), 1.0f);
  EXPECT_EQ(mean.light().direction, up);
  EXPECT_EQ(mean.light().magnitude, Color(1.0f));
}

TEST(LightVectorMean, KeepsRadianceApart) {
  LightVectorMean mean;
  mean.add(light(up, Color(2.0f)), 0.5f);
  mean.add(light(up, Color(8.0f), LightVectorForm::radiance), 0.5f);
  EXPECT_EQ(mean.light().magnitude, Color(1.0f));
  EXPECT_EQ(mean.radiance(), Color(4.0f));
}

TEST(LightVectorMean, OppositeDirectionsAndNothingAreUnitVectors) {
  LightVectorMean mean;
  EXPECT_EQ(mean.light().direction.length(), 1.0f);
  EXPECT_EQ(mean.light().magnitude, Color(0.0f));
  EXPECT_EQ(mean.mean_weight(), 0.0f);
  mean.add(light(up, Color(1.0f)), 1.0f);
  mean.add(light(-up, Color(1.0f)), 1.0f);
  EXPECT_EQ(mean.light().direction, up);
}

}  // namespace
}  // namespace lumivec
