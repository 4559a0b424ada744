#include "integrator/cone_faces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace lumivec {
namespace {

class ConeFacesTest : public testing::Test {
 protected:
  V3f direction() {
    std::normal_distribution<float> normal;
    const float x = normal(random_), y = normal(random_);
    return V3f(x, y, normal(random_)).normalized();
  }
  static ConeFaces faces(const V3f& d, float angle) {
    return ConeFaces(icosahedron().cone(d, std::cos(angle)));
  }
  // How many faces of a level there are in ranges that ascend.
  static std::uint32_t count(ConeFaces& cone, int level) {
    cone.find(level);
    std::uint32_t sum = 0, last = 0;
    for (const ConeFaces::Range* r = cone.begin(level); r != cone.end(level); ++r) {
      EXPECT_LT(r->begin, r->end);
      EXPECT_TRUE(r == cone.begin(level) || last < r->begin);
      last = r->end;
      sum += r->end - r->begin;
    }
    EXPECT_LE(last, Icosahedron::face_count(level));
    return sum;
  }

  std::mt19937 random_{1};
};

TEST_F(ConeFacesTest, HoldTheFacesOfAllDirectionsInTheCone) {
  for (int i = 0; i < 20'000; ++i) {
    const V3f center = direction();
    const float spread = std::exp(std::uniform_real_distribution<float>(-5.0f, 2.0f)(random_));
    const V3f inside = (center + direction() * spread).normalized();
    ConeFaces cone(icosahedron().cone(center, center.dot(inside)));
    for (int level = 0; level <= deepest_face_level; ++level) {
      cone.find(level);
      const std::uint32_t face =
          icosahedron().face_of(inside, level) - Icosahedron::first_face(level);
      bool found = false;
      for (const ConeFaces::Range* r = cone.begin(level); r != cone.end(level); ++r)
        found |= face >= r->begin && face < r->end;
      ASSERT_TRUE(found) << center << ", " << inside << ", level " << level;
    }
  }
}

TEST_F(ConeFacesTest, AreInAscendingRangesAtEveryWidth) {
  for (int i = 0; i < 1'000; ++i) {
    ConeFaces cone = faces(direction(), 0.003f * static_cast<float>(i));
    for (int level = 0; level <= deepest_face_level; ++level) count(cone, level);
  }
}

TEST_F(ConeFacesTest, OfANarrowConeAreFew) {
  for (int level = 0; level <= deepest_face_level; ++level) {
    double sum = 0.0;
    constexpr int cones = 1'000;
    for (int i = 0; i < cones; ++i) {
      ConeFaces cone = faces(direction(), 0.001f);
      sum += count(cone, level);
    }
    EXPECT_LT(sum, 1.3 * cones) << "level " << level;
  }
}

TEST_F(ConeFacesTest, OfTheWidestConeAreAll) {
  ConeFaces cone(icosahedron().cone(direction(), -1.0f));
  for (int level = 0; level <= deepest_face_level; ++level)
    EXPECT_EQ(count(cone, level), Icosahedron::face_count(level));
}

}  // namespace
}  // namespace lumivec
