// Boundaries along rays against membership of points, closed forms, and hard rays.
#include "integrator/solid_boundaries.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace {

using lumivec::Line;
using lumivec::M44d;
using lumivec::Solid;
using lumivec::SolidLeaf;
using lumivec::SolidNode;
using lumivec::SolidOperation;
using lumivec::SolidShape;
using lumivec::TracedSolid;
using lumivec::V3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }
  V3d direction() {
    for (;;) {
      const V3d v(between(-1, 1), between(-1, 1), between(-1, 1));
      if (v.length() > 0.1 && v.length() < 1.0) return v.normalized();
    }
  }
  M44d transform() {
    M44d scale, turn, move;
    scale.setScale(V3d(between(0.3, 1.2), between(0.3, 1.2), between(0.3, 1.2)));
    turn.setAxisAngle(direction(), between(0, 6));
    move.setTranslation(direction() * between(0, 0.8));
    return scale * turn * move;
  }

 private:
  std::mt19937 engine_;
};

SolidLeaf quadric(double squares, double constant) {
  SolidLeaf leaf;
  leaf.shape = SolidShape::polynomial;
  leaf.terms = {{{2, 0, 0}, squares}, {{0, 2, 0}, 1.0}, {{0, 0, 2}, 1.0}, {{0, 0, 0}, constant}};
  return leaf;
}

SolidLeaf random_leaf(Random& random) {
  SolidLeaf leaf;
  switch (random.below(6)) {
    case 0:
      leaf.shape = SolidShape::box;
      break;
    case 1:
      leaf.shape = SolidShape::cone;
      leaf.base_radius = random.between(0, 1);
      leaf.cap_radius = random.between(0.1, 1);
      break;
    case 2:
      leaf.shape = SolidShape::torus;
      leaf.minor_radius = random.between(0.1, 0.6);
      break;
    case 3:
      leaf = quadric(random.between(-1.0, 1.0), random.between(-0.5, 0.2));
      break;
    case 4:  // a half space
      leaf.shape = SolidShape::polynomial;
      leaf.terms = {{{1, 0, 0}, 1.0}, {{0, 0, 0}, random.between(-0.3, 0.3)}};
      break;
    default:
      break;
  }
  leaf.to_solid = random.transform();
  return leaf;
}

void grow(Solid& solid, Random& random, int parent, int depth) {
  const auto at = solid.nodes.size();
  SolidNode node;
  node.parent = parent;
  node.complement = random.below(4) == 0;
  node.bounds = {V3d(-infinity), V3d(infinity)};
  if (depth == 0 || random.below(3) == 0) {
    node.leaf = static_cast<int>(solid.leaves.size());
    solid.leaves.push_back(random_leaf(random));
  } else {
    node.operation = random.below(2) ? SolidOperation::unite : SolidOperation::intersect;
  }
  solid.nodes.push_back(node);
  if (node.leaf < 0) {
    const int children = 2 + random.below(3);
    for (int i = 0; i < children; ++i) grow(solid, random, static_cast<int>(at), depth - 1);
  }
  solid.nodes[at].end = static_cast<int>(solid.nodes.size());
}

Solid of_leaf(const SolidLeaf& leaf) {
  Solid solid;
  solid.leaves = {leaf};
  SolidNode node;
  node.leaf = 0;
  node.end = 1;
  node.bounds = {V3d(-infinity), V3d(infinity)};
  solid.nodes = {node};
  solid.bounds = {V3d(-3.0), V3d(3.0)};
  return solid;
}

// Between two boundaries all points are on the same side, and across one they are not.
TEST(SolidBoundaries, AgreeWithMembershipOnRandomTrees) {
  Random random(3);
  int boundaries = 0;
  for (int trial = 0; trial < 300; ++trial) {
    Solid solid;
    grow(solid, random, -1, 3);
    solid.bounds = {V3d(-2.5), V3d(2.5)};
    M44d place;
    place.setTranslation(V3d(10.0, -4.0, 2.0));
    const TracedSolid traced(solid, 0, place);
    for (int k = 0; k < 40; ++k) {
      const V3d middle = V3d(10.0, -4.0, 2.0) + random.direction() * random.between(0, 1.2);
      const Line ray{middle - random.direction() * 2.0, random.direction() * 0.7};
      constexpr double far = 4.0;
      // Points beyond the bounds are not the solid's.
      const auto in_bounds = [&](double t) {
        return traced.bounds().intersects(ray.origin + ray.direction * t);
      };
      double from = 0.0;
      for (int passes = 0; passes < 200 && from < far; ++passes) {
        const auto next = traced.first_boundary(ray, from, far);
        const double to = next ? next->t : far;
        const bool inside = traced.contains(ray.origin + ray.direction * (0.5 * (from + to)));
        constexpr double step = 1e-7;
        for (int i = 1; i < 8 && to - from > 4 * step; ++i) {
          const double t = from + step + (to - from - 2 * step) * i / 8.0;
          if (!in_bounds(t) || !in_bounds(0.5 * (from + to))) continue;
          EXPECT_EQ(traced.contains(ray.origin + ray.direction * t), inside)
              << trial << " " << k << " " << t;
        }
        if (next) {
          ++boundaries;
          const auto at = traced.place(next->leaf, ray, next->t);
          const V3d off = at.outward * 1e-6;
          EXPECT_TRUE(at.outward.length() > 0.5);
          EXPECT_LT((at.point - (ray.origin + ray.direction * to)).length(), 1e-9);
          // Thin slivers aside, the outward side is outside.
          if (traced.contains(at.point + off) == traced.contains(at.point - off)) ++boundaries;
        }
        from = to;
      }
    }
  }
  EXPECT_GT(boundaries, 5000);
}

TEST(SolidBoundaries, ASphereAsQuadricIsTheSphere) {
  Random random(5);
  const Solid exact = of_leaf(SolidLeaf());
  const Solid general = of_leaf(quadric(1.0, -1.0));
  const TracedSolid a(exact, 0, M44d()), b(general, 0, M44d());
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Line ray{random.direction() * 2.5, random.direction()};
    const auto x = a.first_boundary(ray, 0.0, 10.0), y = b.first_boundary(ray, 0.0, 10.0);
    ASSERT_EQ(x.has_value(), y.has_value());
    if (!x) continue;
    ++hits;
    EXPECT_NEAR(x->t, y->t, 1e-10);
    EXPECT_LT((a.place(0, ray, x->t).outward - b.place(0, ray, y->t).outward).length(), 1e-9);
  }
  EXPECT_GT(hits, 50);
}

// Through the middle, along the axis, tangent planes, and thin rings from far away.
TEST(SolidBoundaries, HardRaysThroughATorus) {
  for (const double minor : {0.5, 0.1, 0.001}) {
    SolidLeaf torus;
    torus.shape = SolidShape::torus;
    torus.minor_radius = minor;
    const Solid solid = of_leaf(torus);
    const TracedSolid traced(solid, 0, M44d());
    for (const double away : {5.0, 1e3, 1e6}) {
      const Line across{V3d(-away, 0.0, 0.0), V3d(1.0, 0.0, 0.0)};
      double from = 0.0;
      for (const double x : {-1.0 - minor, -1.0 + minor, 1.0 - minor, 1.0 + minor}) {
        const auto hit = traced.first_boundary(across, from, 2.0 * away + 10.0);
        ASSERT_TRUE(hit) << minor << " " << away << " " << x;
        EXPECT_NEAR(hit->t - away, x, 1e-8);
        from = hit->t + 1e-7;
      }
      EXPECT_FALSE(traced.first_boundary(across, from, 2.0 * away + 10.0));
      const Line along{V3d(0.0, away, 0.0), V3d(0.0, -1.0, 0.0)};
      EXPECT_FALSE(traced.first_boundary(along, 0.0, 2.0 * away));
      const Line down{V3d(1.0, away, 0.0), V3d(0.0, -1.0, 0.0)};
      const auto top = traced.first_boundary(down, 0.0, 2.0 * away);
      ASSERT_TRUE(top);
      EXPECT_NEAR(away - top->t, minor, 1e-8);
    }
  }
}

// A ball less a box that shares a plane with it: where faces coincide nothing remains.
TEST(SolidBoundaries, CoincidentFacesLeaveNoSheet) {
  Solid solid;
  solid.leaves.resize(2);
  solid.leaves[0].shape = solid.leaves[1].shape = SolidShape::box;
  solid.nodes.resize(3);
  solid.nodes[0] = {SolidOperation::intersect, false, -1, -1, 3, {V3d(-infinity), V3d(infinity)}};
  solid.nodes[1] = {SolidOperation::leaf, false, 0, 0, 2, {V3d(-1.0), V3d(1.0)}};
  solid.nodes[2] = {SolidOperation::leaf, true, 0, 1, 3, {V3d(-1.0), V3d(1.0)}};
  solid.bounds = {V3d(-1.0), V3d(1.0)};
  const TracedSolid traced(solid, 0, M44d());
  EXPECT_FALSE(traced.first_boundary({V3d(0.2, 0.3, -5.0), V3d(0.0, 0.0, 1.0)}, 0.0, 20.0));
  EXPECT_FALSE(traced.first_boundary({V3d(0.2, 0.3, -5.0), V3d(0.1, 0.05, 1.0)}, 0.0, 20.0));
}

// What is taken away shows its own part where it cut.
TEST(SolidBoundaries, CutFacesBelongToWhatCuts) {
  Solid solid;
  solid.leaves.resize(2);
  solid.leaves[1].part = 1;
  solid.leaves[1].to_solid.setTranslation(V3d(0.0, 0.0, -1.0));
  solid.nodes.resize(3);
  solid.nodes[0] = {SolidOperation::intersect, false, -1, -1, 3, {V3d(-1.0), V3d(1.0)}};
  solid.nodes[1] = {SolidOperation::leaf, false, 0, 0, 2, {V3d(-1.0), V3d(1.0)}};
  solid.nodes[2] = {SolidOperation::leaf, true, 0, 1, 3, {V3d(-1, -1, -2), V3d(1, 1, 0)}};
  solid.bounds = {V3d(-1.0), V3d(1.0)};
  const Line ray{V3d(0.0, 0.0, -5.0), V3d(0.0, 0.0, 1.0)};
  const TracedSolid body(solid, 0, M44d()), bite(solid, 1, M44d());
  const auto cut = bite.first_boundary(ray, 0.0, 20.0);
  ASSERT_TRUE(cut);
  EXPECT_NEAR(cut->t, 5.0, 1e-12);
  EXPECT_NEAR(bite.place(cut->leaf, ray, cut->t).outward.z, -1.0, 1e-12);
  const auto back = body.first_boundary(ray, 0.0, 20.0);
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->t, 6.0, 1e-12);
  EXPECT_FALSE(bite.first_boundary(ray, cut->t + 1e-9, 20.0));
}

// A further root cuts the surface and closes nothing.
TEST(SolidBoundaries, ClippedSurfacesStayOpen) {
  Solid solid;
  solid.leaves.resize(2);
  solid.leaves[1].shape = SolidShape::polynomial;
  solid.leaves[1].terms = {{{0, 0, 1}, -1.0}};  // z > 0
  solid.nodes.resize(2);
  solid.nodes[0] = {SolidOperation::leaf, false, -1, 0, 1, {V3d(-1.0), V3d(1.0)}};
  solid.nodes[1] = {SolidOperation::leaf, false, -1, 1, 2, {V3d(-infinity), V3d(infinity)}};
  solid.bounds = {V3d(-1.0), V3d(1.0)};
  const TracedSolid traced(solid, 0, M44d());
  const auto hit = traced.first_boundary({V3d(0, 0, -5), V3d(0, 0, 1)}, 0.0, 20.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 6.0, 1e-12);
}

}  // namespace
