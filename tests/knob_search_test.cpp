#include "tools/knob_search.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace lumivec;

TEST(KnobSearch, FindsACount) {
  for (const double power : {0.2, 0.5, 1.0, 2.0}) {
    const auto count = [&](double knob) { return std::round(500.0 * std::pow(knob, -power)); };
    for (const double wanted : {100.0, 400.0, 4000.0}) {
      const KnobFound found = find_knob(count, {0.1, 1e-6, 1e6}, wanted, 0.03);
      EXPECT_NEAR(found.count, wanted, 0.03 * wanted) << power;
      EXPECT_EQ(found.count, count(found.knob));
      EXPECT_LE(found.tries, 14);
    }
  }
}
TEST(KnobSearch, FindsACountBesideAStep) {
  const auto count = [](double knob) { return knob < 1.0 ? 5000.0 - 100.0 * knob : 10.0; };
  EXPECT_NEAR(find_knob(count, {8.0, 0.01, 100.0}, 4950.0, 0.01).count, 4950.0, 50.0);
}
TEST(KnobSearch, GivesTheNearestOfWhatThereIs) {
  const auto count = [](double knob) { return 1000.0 / knob; };
  const KnobFound found = find_knob(count, {1.0, 0.5, 2.0}, 10'000.0, 0.03);
  EXPECT_EQ(found.knob, 0.5);
  EXPECT_EQ(found.count, 2000.0);
}
TEST(KnobSearch, IsNotHeldUpByNoRecordsAtAll) {
  const KnobFound found = find_knob([](double) { return 0.0; }, {1.0, 0.1, 10.0}, 100.0, 0.03);
  EXPECT_EQ(found.count, 0.0);
  EXPECT_LE(found.tries, 14);
}
