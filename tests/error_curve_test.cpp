#include "tools/error_curve.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace lumivec;
using Kind = CostToReach::Kind;

TEST(ErrorCurve, IsInterpolatedInLogarithms) {
  // Along error = 1 / cost a line in logarithms is exact.
  const CostToReach cost = cost_to_reach({{1.0, 1.0}, {16.0, 1.0 / 16.0}}, 0.25);
  EXPECT_EQ(cost.kind, Kind::interpolated);
  EXPECT_NEAR(cost.cost, 4.0, 1e-12);
  EXPECT_EQ(cost_text(cost), "4");
}
TEST(ErrorCurve, IsExtrapolatedByTheLastPoint) {
  const CostToReach cost = cost_to_reach({{1.0, 1.0}, {2.0, 0.4}}, 0.1);
  EXPECT_EQ(cost.kind, Kind::extrapolated);
  EXPECT_NEAR(cost.cost, 8.0, 1e-12);
  EXPECT_EQ(cost_text(cost), "~8");
}
TEST(ErrorCurve, OnlyBoundsWhatTheFirstPointReaches) {
  const CostToReach cost = cost_to_reach({{3.0, 0.05}, {6.0, 0.01}}, 0.1);
  EXPECT_EQ(cost.kind, Kind::at_most);
  EXPECT_EQ(cost_text(cost), "<3");
}
TEST(ErrorCurve, CountsTheLastCrossing) {
  const CostToReach cost =
      cost_to_reach({{4.0, 0.8}, {1.0, 0.4}, {2.0, 0.1}, {16.0, 0.05}, {32.0, 0.01}}, 0.2);
  EXPECT_EQ(cost.kind, Kind::interpolated);
  EXPECT_NEAR(cost.cost, 8.0, 1e-12);
}
TEST(ErrorCurve, TakesAnErrorOfZero) {
  const CostToReach cost = cost_to_reach({{1.0, 1.0}, {2.0, 0.0}}, 0.5);
  EXPECT_GT(cost.cost, 1.0);
  EXPECT_LT(cost.cost, 2.0);
}
TEST(ErrorCurve, SaysThatItKnowsNothing) {
  EXPECT_EQ(cost_to_reach({}, 0.1).kind, Kind::unknown);
  EXPECT_EQ(cost_text({}), "-");
  EXPECT_TRUE(std::isnan(cost_ratio({}, {1.0, Kind::interpolated})));
  EXPECT_EQ(cost_ratio_text({1.0, Kind::interpolated}, {}), "-");
}
TEST(ErrorCurve, MarksRatios) {
  const CostToReach exact = {10.0, Kind::interpolated}, most = {2.0, Kind::at_most},
                    far = {40.0, Kind::extrapolated};
  EXPECT_EQ(cost_ratio_text(exact, exact), "1");
  EXPECT_EQ(cost_ratio_text(exact, most), ">5");
  EXPECT_EQ(cost_ratio_text(most, exact), "<0.2");
  EXPECT_EQ(cost_ratio_text(far, exact), "~4");
  EXPECT_EQ(cost_ratio_text(far, most), ">~20");
  EXPECT_EQ(cost_ratio_text(most, most), "-");
}
