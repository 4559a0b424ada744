// Animation channels between their keys, against values worked out by hand.
#include "loader/keyframes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace {

using lumivec::AnimationChannel;
using lumivec::AnimationTarget;
using lumivec::Interpolation;
using lumivec::value_at;
using Numbers = std::vector<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();

AnimationChannel translation(Interpolation interpolation, std::vector<float> times,
                             std::vector<float> values) {
  return {0, AnimationTarget::translation, interpolation, std::move(times), std::move(values)};
}

// A turn about z.
Numbers turned(double degrees) {
  const double half = degrees * std::numbers::pi / 360.0;
  return {0.0, 0.0, std::sin(half), std::cos(half)};
}

AnimationChannel turns(const std::vector<double>& degrees, double sign_of_last = 1.0) {
  AnimationChannel channel{0, AnimationTarget::rotation, Interpolation::linear, {}, {}};
  for (std::size_t i = 0; i < degrees.size(); ++i) {
    channel.times.push_back(static_cast<float>(i));
    const double sign = i + 1 == degrees.size() ? sign_of_last : 1.0;
    for (const double x : turned(degrees[i])) {
      channel.values.push_back(static_cast<float>(sign * x));
    }
  }
  return channel;
}

void expect_near(const Numbers& a, const Numbers& b, double tolerance = 1e-7) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

TEST(Keyframes, StepsHoldTheKeyBefore) {
  const auto channel = translation(Interpolation::step, {1, 2, 4}, {1, 2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_EQ(value_at(channel, 1.999), (Numbers{1, 2, 3}));
  EXPECT_EQ(value_at(channel, 2.0), (Numbers{4, 5, 6}));
  EXPECT_EQ(value_at(channel, 3.999), (Numbers{4, 5, 6}));
  EXPECT_EQ(value_at(channel, 4.0), (Numbers{7, 8, 9}));
}

TEST(Keyframes, LinesAreStraight) {
  const auto channel = translation(Interpolation::linear, {1, 3}, {0, 10, -2, 4, 10, 2});
  EXPECT_EQ(value_at(channel, 1.5), (Numbers{1, 10, -1}));
  EXPECT_EQ(value_at(channel, 2.0), (Numbers{2, 10, 0}));
}

TEST(Keyframes, TimesOutsideAreClamped) {
  for (const auto interpolation : {Interpolation::step, Interpolation::linear}) {
    const auto channel = translation(interpolation, {1, 3}, {1, 2, 3, 4, 5, 6});
    for (const double early : {-infinity, -5.0, 0.0, 1.0}) {
      EXPECT_EQ(value_at(channel, early), (Numbers{1, 2, 3})) << early;
    }
    for (const double late : {3.0, 5.0, infinity}) {
      EXPECT_EQ(value_at(channel, late), (Numbers{4, 5, 6})) << late;
    }
  }
}

TEST(Keyframes, NoTimeIsAfterTheLastKey) {
  const auto channel = translation(Interpolation::linear, {1, 3}, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(value_at(channel, std::nan("")), (Numbers{4, 5, 6}));
}

TEST(Keyframes, OneKeyIsAlwaysThere) {
  for (const double t : {0.0, 1.0, 2.0}) {
    EXPECT_EQ(value_at(translation(Interpolation::linear, {1}, {1, 2, 3}), t), (Numbers{1, 2, 3}));
    EXPECT_EQ(
        value_at(translation(Interpolation::cubic_spline, {1}, {9, 9, 9, 1, 2, 3, 8, 8, 8}), t),
        (Numbers{1, 2, 3}));
  }
}

// From 1 to 5 within two seconds, leaving at 3 and arriving at -1 a second.
TEST(Keyframes, SplinesAreCubicHermite) {
  const auto channel = translation(Interpolation::cubic_spline, {1, 3},
                                   {7, 7, 7, 1, 0, 0, 3, 0, 0, -1, 0, 0, 5, 0, 0, 7, 7, 7});
  // At u = 1/2: (1 + 5) / 2 + 2 s × (3 - (-1)) / 8 = 4.
  EXPECT_NEAR(value_at(channel, 2.0)[0], 4.0, 1e-12);
  // At u = 1/4: 27/32 × 1 + 9/64 × 2 × 3 + 5/32 × 5 - 3/64 × 2 × -1 = 2.5625.
  EXPECT_NEAR(value_at(channel, 1.5)[0], 2.5625, 1e-12);
  EXPECT_EQ(value_at(channel, 1.0)[0], 1.0);
  EXPECT_EQ(value_at(channel, 3.0)[0], 5.0);
  EXPECT_EQ(value_at(channel, 0.0)[0], 1.0);
  EXPECT_EQ(value_at(channel, 9.0)[0], 5.0);
  // It leaves as fast as it says.
  EXPECT_NEAR((value_at(channel, 1.0 + 1e-6)[0] - 1.0) / 1e-6, 3.0, 1e-4);
}

TEST(Keyframes, RotationsTurnEvenly) {
  const auto channel = turns({0, 90});
  expect_near(value_at(channel, 1.0 / 3.0), turned(30));
  expect_near(value_at(channel, 0.5), turned(45));
  expect_near(value_at(channel, 0.9), turned(81));
}

TEST(Keyframes, RotationsTakeTheShorterWay) {
  // The same rotation by the opposite quaternion, and one by more than half a turn.
  expect_near(value_at(turns({0, 90}, -1.0), 0.5), turned(45));
  expect_near(value_at(turns({0, 270}), 0.5), turned(-45));
}

TEST(Keyframes, NearbyRotationsDoNotDivideByZero) {
  expect_near(value_at(turns({10, 10}), 0.5), turned(10));
  expect_near(value_at(turns({10, 10}, -1.0), 0.5), turned(10));
  expect_near(value_at(turns({10, 10.00001}), 0.5), turned(10.000005));
}

TEST(Keyframes, RotationsAreUnit) {
  AnimationChannel channel = turns({0, 90});
  for (float& x : channel.values) x *= 3.0f;
  expect_near(value_at(channel, 0.0), turned(0));
  expect_near(value_at(channel, 0.5), turned(45));
  channel.interpolation = Interpolation::step;
  expect_near(value_at(channel, 1.0), turned(90));
}

TEST(Keyframes, RotationsBySplineAreUnit) {
  AnimationChannel channel{0, AnimationTarget::rotation, Interpolation::cubic_spline, {0, 1}, {}};
  const float s = std::numbers::sqrt2_v<float> / 2.0f;
  channel.values = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, s, s, 0, 0, 0, 0};
  expect_near(value_at(channel, 0.5), turned(45));
  // Straight through zero: from the identity to its opposite without tangents.
  channel.values = {0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -1, 0, 0, 0, 0};
  expect_near(value_at(channel, 0.5), turned(0));
}

TEST(Keyframes, WeightsHaveOneNumberPerTarget) {
  const AnimationChannel channel{
      0, AnimationTarget::weights, Interpolation::linear, {0, 2}, {0, 1, .5f, 1, 0, .5f}};
  EXPECT_EQ(numbers_per_key(channel), 3u);
  EXPECT_EQ(value_at(channel, 0.5), (Numbers{0.25, 0.75, 0.5}));
}

TEST(Keyframes, WeightsBySplineKeepTangentsTogether) {
  // in-tangents, values and out-tangents of two targets, key by key.
  const AnimationChannel channel{0,
                                 AnimationTarget::weights,
                                 Interpolation::cubic_spline,
                                 {0, 1},
                                 {0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0}};
  const Numbers half = value_at(channel, 0.5);
  EXPECT_NEAR(half[0], 0.5 + 0.125, 1e-12);
  EXPECT_NEAR(half[1], 0.5, 1e-12);
}

}  // namespace
