#include "integrator/icosahedron.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace lumivec {
namespace {

std::vector<V3f> random_directions(int count) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  std::vector<V3f> directions;
  for (int i = 0; i < count; ++i) {
    const float x = normal(random), y = normal(random);
    directions.push_back(V3f(x, y, normal(random)).normalized());
  }
  return directions;
}

// How far a direction is outside a spherical triangle's worst edge plane; ≤ 0 is inside.
float outside(const std::array<V3f, 3>& t, const V3f& d) {
  float worst = -1.0f;
  for (std::size_t i = 0; i < 3; ++i) {
    V3f plane = t[(i + 1) % 3].cross(t[(i + 2) % 3]).normalized();
    if (plane.dot(t[i]) < 0.0f) plane = -plane;
    worst = std::max(worst, -plane.dot(d));
  }
  return worst;
}

double solid_angle(const std::array<V3f, 3>& t) {
  const V3d a(t[0]), b(t[1]), c(t[2]);
  return 2.0 * std::atan2(std::abs(a.dot(b.cross(c))), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

TEST(Icosahedron, FacesOfALevelCoverTheSphereOnce) {
  std::uint32_t first = 0, count = icosahedron_faces;
  for (int level = 0; level <= 3; ++level) {
    double sum = 0.0;
    for (std::uint32_t f = first; f < first + count; ++f)
      sum += solid_angle(icosahedron().triangle(f));
    EXPECT_NEAR(sum, 4.0 * std::numbers::pi, 1e-4) << "level " << level;
    first += count;
    count *= 4;
  }
}

TEST(Icosahedron, ADirectionIsInsideItsFace) {
  for (const V3f& d : random_directions(20'000)) {
    for (int level = 0; level <= deepest_face_level; ++level) {
      const std::uint32_t face = icosahedron().face_of(d, level);
      ASSERT_LE(outside(icosahedron().triangle(face), d), 1e-6f) << "level " << level << ", " << d;
    }
  }
}

TEST(Icosahedron, CornersAndEdgesBelongToAFaceThatTouchesThem) {
  for (std::uint32_t f = 0; f < divided_faces; f += 7) {
    const std::array<V3f, 3> t = icosahedron().triangle(f);
    for (std::size_t i = 0; i < 3; ++i) {
      for (const V3f& d : {t[i], (t[i] + t[(i + 1) % 3]).normalized()}) {
        for (int level = 0; level <= deepest_face_level; ++level) {
          const std::uint32_t face = icosahedron().face_of(d, level);
          ASSERT_LE(outside(icosahedron().triangle(face), d), 1e-6f) << f << ", " << d;
        }
      }
    }
  }
}

TEST(Icosahedron, DeepestFacesAreAFewDegreesWide) {
  const std::uint32_t face = icosahedron().face_of(V3f(0.0f, 0.0f, 1.0f), deepest_face_level);
  const std::array<V3f, 3> t = icosahedron().triangle(face);
  const float degrees = std::acos(t[0].dot(t[1])) * 180.0f / std::numbers::pi_v<float>;
  EXPECT_GT(degrees, 1.5f);
  EXPECT_LT(degrees, 3.0f);
}

// Of every pair of directions, a cone around one that holds the other touches its face.
TEST(Icosahedron, ConesTouchTheFacesOfAllTheirDirections) {
  const std::vector<V3f> directions = random_directions(300);
  for (const V3f& center : directions) {
    for (const V3f& d : directions) {
      const DirectionCone cone = icosahedron().cone(center, center.dot(d));
      std::uint32_t face = icosahedron().root_of(d);
      const auto* const end = cone.roots.begin() + cone.root_count;
      ASSERT_NE(std::find(cone.roots.begin(), end, face), end) << center << ", " << d;
      for (int level = 0; level < deepest_face_level; ++level) {
        const std::uint32_t which = icosahedron().child_of(face, d);
        ASSERT_TRUE(icosahedron().children_touched(face, cone) & (1u << which))
            << center << ", " << d << ", level " << level;
        face = Icosahedron::child(face, which);
      }
    }
  }
}

TEST(Icosahedron, NarrowConesTouchFewFaces) {
  double roots = 0.0;
  const std::vector<V3f> directions = random_directions(2'000);
  for (const V3f& d : directions) roots += icosahedron().cone(d, 0.9999f).root_count;
  EXPECT_LT(roots / static_cast<double>(directions.size()), 1.2);
}

TEST(Icosahedron, TheWidestConeTouchesEverything) {
  const DirectionCone cone = icosahedron().cone(V3f(0.0f, 0.0f, 1.0f), -1.0f);
  EXPECT_EQ(cone.root_count, icosahedron_faces);
  for (std::uint32_t f = 0; f < divided_faces; ++f)
    ASSERT_EQ(icosahedron().children_touched(f, cone), 15u);
}

}  // namespace
}  // namespace lumivec
