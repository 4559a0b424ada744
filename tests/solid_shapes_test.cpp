// Curved primitives of solids: crossings against what closed forms say of points and lines.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "integrator/solid_boundaries.h"

namespace {

using lumivec::BlobComponent;
using lumivec::CurvePiece;
using lumivec::Line;
using lumivec::M44d;
using lumivec::Solid;
using lumivec::SolidLeaf;
using lumivec::SolidNode;
using lumivec::SolidShape;
using lumivec::SweepPiece;
using lumivec::TracedSolid;
using lumivec::V3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

Solid of_leaf(const SolidLeaf& leaf, double reach = 3.0) {
  Solid solid;
  solid.leaves = {leaf};
  SolidNode node;
  node.leaf = 0;
  node.end = 1;
  node.bounds = {V3d(-infinity), V3d(infinity)};
  solid.nodes = {node};
  solid.bounds = {V3d(-reach), V3d(reach)};
  return solid;
}

CurvePiece line_piece(double u0, double v0, double u1, double v1) {
  CurvePiece piece;
  piece.u = {u0, u1 - u0, 0.0, 0.0};
  piece.v = {v0, v1 - v0, 0.0, 0.0};
  piece.end = {u1, v1};
  return piece;
}

// A Bézier curve by its control points.
CurvePiece bezier(const std::array<std::array<double, 2>, 4>& p) {
  CurvePiece piece;
  const auto cubic = [&](std::size_t c) -> lumivec::Cubic {
    return {p[0][c], 3 * (p[1][c] - p[0][c]), 3 * (p[0][c] - 2 * p[1][c] + p[2][c]),
            p[3][c] - p[0][c] + 3 * (p[1][c] - p[2][c])};
  };
  piece.u = cubic(0);
  piece.v = cubic(1);
  piece.end = p[3];
  return piece;
}

// A drop between u = ±1: the line u = ±(1 - v²) between v = -1 and 1 as two parabolas.
std::vector<CurvePiece> parabolas() {
  std::vector<CurvePiece> curve(2);
  for (int side = 0; side < 2; ++side) {
    const double sign = side ? -1.0 : 1.0;
    // v = sign (2 s - 1), u = sign (1 - v²) = sign 4 (s - s²)
    curve[std::size_t(side)].u = {0.0, 4.0 * sign, -4.0 * sign, 0.0};
    curve[std::size_t(side)].v = {-sign, 2.0 * sign, 0.0, 0.0};
    curve[std::size_t(side)].end = {0.0, sign};
  }
  return curve;
}

using Inside = std::function<bool(const V3d&)>;

// Random lines cross where membership changes, and the outward directions agree with it.
void agrees(const SolidLeaf& leaf, const Inside& inside, double reach = 3.0) {
  const Solid solid = of_leaf(leaf, reach);
  const TracedSolid traced(solid, 0, M44d());
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  int crossings = 0;
  for (int k = 0; k < 1500; ++k) {
    const V3d a(place(engine), place(engine), place(engine));
    V3d d = V3d(place(engine), place(engine), place(engine)).normalized();
    if (k % 5 == 0) d = V3d(k % 2, k % 3 == 0, 1.0 - k % 2);  // along the axes, and level
    if (k % 5 == 1) d = V3d(d.x, d.y * 1e-4, d.z);
    if (k % 5 == 2) d = V3d(d.x, d.y * 1e-9, d.z);
    d.normalize();
    const Line ray{a - d * 2.5, d};
    double from = 0.0;
    for (int passes = 0; passes < 100 && from < 5.0; ++passes) {
      const auto next = traced.first_boundary(ray, from, 5.0);
      const double to = next ? next->t : 5.0;
      constexpr double step = 1e-6;
      const bool start = inside(ray.origin + d * (from + step));
      for (int i = 0; i <= 12 && to - from > 8 * step; ++i) {
        const double t = from + step + (to - from - 2 * step) * i / 12.0;
        ASSERT_EQ(inside(ray.origin + d * t), start) << k << " " << from << " " << t << " " << to;
      }
      if (next) {
        ++crossings;
        const auto at = traced.place(next->leaf, ray, next->t);
        EXPECT_LT((at.point - (ray.origin + d * to)).length(), 1e-7);
        ASSERT_NEAR(at.outward.length(), 1.0, 1e-9);
        // Where the line does not graze, one of its sides is outside, and outward looks there.
        if (std::abs(at.outward.dot(d)) > 0.05) {
          const bool before = inside(at.point - d * step), after = inside(at.point + d * step);
          if (before != after) {
            EXPECT_EQ(at.outward.dot(d) > 0.0, before) << k;
          }
        }
      }
      from = to;
    }
  }
  EXPECT_GT(crossings, 300);
}

// Outward directions against the slopes of a function that is 0 on the surface.
void outward_is_gradient(const SolidLeaf& leaf, const std::function<double(const V3d&)>& f) {
  const Solid solid = of_leaf(leaf);
  const TracedSolid traced(solid, 0, M44d());
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  int hits = 0;
  for (int k = 0; k < 300; ++k) {
    const V3d a(place(engine), place(engine), place(engine));
    const V3d d = V3d(place(engine), place(engine), place(engine)).normalized();
    const Line ray{a - d * 2.5, d};
    const auto hit = traced.first_boundary(ray, 0.0, 5.0);
    if (!hit) continue;
    const auto at = traced.place(hit->leaf, ray, hit->t);
    EXPECT_NEAR(f(at.point), 0.0, 1e-9);
    V3d gradient;
    constexpr double h = 1e-5;
    for (int i = 0; i < 3; ++i) {
      V3d e(0.0);
      e[i] = h;
      gradient[i] = (f(at.point + e) - f(at.point - e)) / (2 * h);
    }
    if (gradient.length() < 1e-2) continue;
    ++hits;
    EXPECT_LT((gradient.normalized() - at.outward).length(), 1e-4);
  }
  EXPECT_GT(hits, 40);
}

TEST(SolidShapes, PrismsOfParabolas) {
  SolidLeaf prism;
  prism.shape = SolidShape::prism;
  prism.curve = parabolas();
  prism.low = -0.5;
  prism.high = 0.8;
  const Inside inside = [](const V3d& p) {
    return p.y > -0.5 && p.y < 0.8 && std::abs(p.x) < 1.0 - p.z * p.z;
  };
  agrees(prism, inside);
  prism.conic = true;
  agrees(prism, [](const V3d& p) {
    return p.y > -0.5 && p.y < 0.8 && std::abs(p.x / p.y) < 1.0 - (p.z / p.y) * (p.z / p.y);
  });
}

TEST(SolidShapes, ASquareAsPrismIsTheBoxFromAllSides) {
  SolidLeaf prism;
  prism.shape = SolidShape::prism;
  prism.curve = {line_piece(-1, -1, 1, -1), line_piece(1, -1, 1, 1), line_piece(1, 1, -1, 1),
                 line_piece(-1, 1, -1, -1)};
  prism.low = -1.0;
  prism.high = 1.0;
  agrees(prism, [](const V3d& p) {
    return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) < 1.0;
  });
  // Exactly through an edge, and exactly along the sweep through a corner's neighbourhood.
  const Solid solid = of_leaf(prism);
  const TracedSolid traced(solid, 0, M44d());
  int boundaries = 0;
  double from = 0.0;
  const Line diagonal{V3d(-2.0, 0.25, -2.0), V3d(1.0, 0.0, 1.0)};
  while (const auto hit = traced.first_boundary(diagonal, from, 10.0)) {
    from = hit->t;
    ++boundaries;
  }
  EXPECT_EQ(boundaries, 2);
}

TEST(SolidShapes, OpenPrismsShowTheirInside) {
  SolidLeaf prism;
  prism.shape = SolidShape::prism;
  prism.curve = parabolas();
  prism.low = -1.0;
  prism.high = 1.0;
  prism.open = true;
  const Solid solid = of_leaf(prism);
  const TracedSolid traced(solid, 0, M44d());
  EXPECT_FALSE(traced.first_boundary({V3d(0.1, 3.0, 0.1), V3d(0.0, -1.0, 0.0)}, 0.0, 10.0));
  // Down through the open end to the side x = 1 - z² from within.
  const Line slanted{V3d(0.0, 2.0, 0.0), V3d(0.5, -1.0, 0.0)};
  const auto hit = traced.first_boundary(slanted, 0.0, 10.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 2.0, 1e-12);
  EXPECT_NEAR(traced.place(0, slanted, hit->t).outward.x, 1.0, 1e-9);
}

TEST(SolidShapes, LathesOfCubics) {
  SolidLeaf lathe;
  lathe.shape = SolidShape::lathe;
  // r = 1 - y² between y = -1 and 1, from axis to axis.
  lathe.curve = {parabolas()[0]};
  const auto f = [](const V3d& p) { return std::hypot(p.x, p.z) - 1.0 + p.y * p.y; };
  agrees(lathe, [&](const V3d& p) { return f(p) < 0.0 && std::abs(p.y) < 1.0; });
  outward_is_gradient(lathe, f);
}

// A turned square is a cylinder with a hole.
TEST(SolidShapes, LathesOfLinesAreRings) {
  SolidLeaf lathe;
  lathe.shape = SolidShape::lathe;
  lathe.curve = {line_piece(0.4, -0.5, 1, -0.5), line_piece(1, -0.5, 1, 0.5),
                 line_piece(1, 0.5, 0.4, 0.5), line_piece(0.4, 0.5, 0.4, -0.5)};
  agrees(lathe, [](const V3d& p) {
    const double r = std::hypot(p.x, p.z);
    return r > 0.4 && r < 1.0 && std::abs(p.y) < 0.5;
  });
}

TEST(SolidShapes, LathesOfLoopsAgreeWithTheirOutline) {
  SolidLeaf lathe;
  lathe.shape = SolidShape::lathe;
  lathe.curve = {bezier({{{0.3, -0.8}, {1.6, -0.9}, {1.3, 0.2}, {0.6, 0.3}}}),
                 bezier({{{0.6, 0.3}, {0.2, 0.4}, {0.9, 0.9}, {0.3, -0.8}}})};
  agrees(lathe, [&](const V3d& p) {
    // Even-odd on a fine polygon.
    const double x = std::hypot(p.x, p.z);
    bool inside = false;
    for (const CurvePiece& piece : lathe.curve) {
      constexpr int steps = 4000;
      const auto at = [&](const lumivec::Cubic& c, double s) {
        return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
      };
      for (int i = 0; i < steps; ++i) {
        const double s = i / double(steps), e = (i + 1) / double(steps);
        const double u0 = at(piece.u, s), v0 = at(piece.v, s), u1 = at(piece.u, e),
                     v1 = at(piece.v, e);
        if ((v0 > p.y) != (v1 > p.y) && x < u0 + (u1 - u0) * (p.y - v0) / (v1 - v0))
          inside = !inside;
      }
    }
    return inside;
  });
}

// The square of the radius is 1 - y² where this is linear in s = (y + 1) / 2 ... a ball.
TEST(SolidShapes, ASorOfAQuadraticIsTheBall) {
  SolidLeaf sor;
  sor.shape = SolidShape::sor;
  CurvePiece piece;
  piece.u = {0.0, 4.0, -4.0, 0.0};
  piece.v = {-1.0, 2.0, 0.0, 0.0};
  piece.end = {0.0, 1.0};
  sor.curve = {piece};
  agrees(sor, [](const V3d& p) { return p.length() < 1.0; });
  outward_is_gradient(sor, [](const V3d& p) { return p.length() - 1.0; });
}

double superellipsoid(const SolidLeaf& s, const V3d& p) {
  return std::pow(
             std::pow(std::abs(p.x), 2 / s.east_west) + std::pow(std::abs(p.y), 2 / s.east_west),
             s.east_west / s.north_south) +
         std::pow(std::abs(p.z), 2 / s.north_south) - 1.0;
}

TEST(SolidShapes, Superellipsoids) {
  for (const auto& [e, n] : {std::pair{1.0, 1.0}, {0.25, 0.25}, {2.0, 0.5}, {0.02, 0.3}}) {
    SolidLeaf leaf;
    leaf.shape = SolidShape::superellipsoid;
    leaf.east_west = e;
    leaf.north_south = n;
    agrees(leaf, [&](const V3d& p) { return superellipsoid(leaf, p) < 0.0; });
    if (e > 0.1) outward_is_gradient(leaf, [&](const V3d& p) { return superellipsoid(leaf, p); });
  }
}

// Spiked ones, whose stretches may be several.
TEST(SolidShapes, SpikedSuperellipsoids) {
  for (const auto& [e, n] : {std::pair{3.0, 3.0}, {0.4, 2.5}, {2.5, 0.4}}) {
    SolidLeaf leaf;
    leaf.shape = SolidShape::superellipsoid;
    leaf.east_west = e;
    leaf.north_south = n;
    agrees(leaf, [&](const V3d& p) { return superellipsoid(leaf, p) < 0.0; });
  }
}

BlobComponent component(const V3d& center, double radius, double strength, double length = 0.0) {
  M44d place, scale, turn;
  scale.setScale(V3d(radius, radius, 0.8 * radius));
  turn.setAxisAngle(V3d(1.0, 0.0, 0.0), 0.7);
  place.setTranslation(center);
  return {(scale * turn * place).inverse(), length, strength};
}

double blob_left(const SolidLeaf& blob, const V3d& point) {
  double sum = 0.0;
  for (const BlobComponent& c : blob.components) {
    V3d p = point * c.to_component;
    p.y -= std::clamp(p.y, 0.0, c.length);
    const double share = 1.0 - p.length2();
    if (share > 0.0) sum += c.strength * share * share;
  }
  return blob.threshold - sum;
}

TEST(SolidShapes, BlobsOfPointsAndLines) {
  SolidLeaf blob;
  blob.shape = SolidShape::blob;
  blob.threshold = 0.4;
  blob.components = {component(V3d(0, 0, 0), 1.0, 1.0), component(V3d(0.6, 0.2, 0.1), 0.8, 0.9),
                     component(V3d(0.2, 0.5, -0.4), 0.5, -0.8),
                     component(V3d(-0.7, -0.6, 0.3), 0.5, 1.2, 2.0)};
  agrees(blob, [&](const V3d& p) { return blob_left(blob, p) < 0.0; });
  outward_is_gradient(blob, [&](const V3d& p) { return blob_left(blob, p); });
}

// One point alone: a ball whose radius is where (1 - d²)² is the threshold.
TEST(SolidShapes, BlobsInClosedForm) {
  SolidLeaf blob;
  blob.shape = SolidShape::blob;
  blob.threshold = 0.25;
  blob.components = {{M44d(), 0.0, 1.0}};
  const Solid solid = of_leaf(blob);
  const TracedSolid traced(solid, 0, M44d());
  for (const double away : {2.0, 1e3, 1e6}) {
    const Line ray{V3d(-away, 0.0, 0.0), V3d(1.0, 0.0, 0.0)};
    const auto hit = traced.first_boundary(ray, 0.0, 2 * away);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->t, away - std::sqrt(0.5), 1e-9 * std::max(away / 1e3, 1.0));
  }
}

TEST(SolidShapes, ManyComponentsAreFoundAsOneAlone) {
  SolidLeaf blob;
  blob.shape = SolidShape::blob;
  blob.threshold = 0.25;
  constexpr int side = 40;
  for (int i = 0; i < side * side * side; ++i) {
    M44d place, scale;
    scale.setScale(V3d(0.02));
    place.setTranslation((V3d(i % side, i / side % side, i / (side * side)) / side - V3d(0.5)) *
                         2.0);
    blob.components.push_back({(scale * place).inverse(), 0.0, 1.0});
  }
  const Solid solid = of_leaf(blob);
  const TracedSolid traced(solid, 0, M44d());
  const auto hit = traced.first_boundary({V3d(-2.0, 0.0, 0.0), V3d(1.0, 0.0, 0.0)}, 0.0, 4.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 1.0 - 0.02 * std::sqrt(0.5), 1e-12);
  EXPECT_FALSE(traced.first_boundary({V3d(-2.0, 0.025, 0.0), V3d(1.0, 0.0, 0.0)}, 0.0, 4.0));
}

// The least distance from the spheres along a sweep, by fine steps.
double sweep_left(const SolidLeaf& sweep, const V3d& p) {
  double least = infinity;
  for (const SweepPiece& piece : sweep.sweep) {
    constexpr int steps = 2000;
    for (int i = 0; i <= steps; ++i) {
      const double s = i / double(steps);
      const auto at = [&](const lumivec::Cubic& c) {
        return c[0] + s * (c[1] + s * (c[2] + s * c[3]));
      };
      const V3d center(at(piece.center[0]), at(piece.center[1]), at(piece.center[2]));
      least = std::min(least, (p - center).length() - at(piece.radius));
    }
  }
  return least;
}

TEST(SolidShapes, SweepsAlongCubics) {
  SolidLeaf leaf;
  leaf.shape = SolidShape::sweep;
  SweepPiece piece;
  piece.center = {{{-1.0, 3.0, -2.0, 0.9}, {0.3, -2.0, 3.0, -1.0}, {0.0, 1.0, -2.0, 1.5}}};
  piece.radius = {0.3, -0.5, 0.9, -0.3};
  SweepPiece straight;
  straight.center = {{{0.9, -0.9, 0.0, 0.0}, {0.3, 0.7, 0.0, 0.0}, {0.5, -1.0, 0.0, 0.0}}};
  straight.radius = {0.4, -0.35, 0.0, 0.0};
  leaf.sweep = {piece, straight};
  const Solid solid = of_leaf(leaf);
  const TracedSolid traced(solid, 0, M44d());
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  int hits = 0;
  for (int k = 0; k < 200; ++k) {
    const V3d a(place(engine), place(engine), place(engine));
    const V3d d = V3d(place(engine), place(engine), place(engine)).normalized();
    const Line ray{a - d * 3.0, d};
    const auto hit = traced.first_boundary(ray, 0.0, 6.0);
    const double end = hit ? hit->t : 6.0;
    for (int i = 0; i < 40; ++i)
      EXPECT_GT(sweep_left(leaf, ray.origin + d * (end * i / 40.0)), -1e-6) << k;
    if (!hit) continue;
    ++hits;
    const auto at = traced.place(hit->leaf, ray, hit->t);
    EXPECT_NEAR(sweep_left(leaf, at.point), 0.0, 1e-5);
    EXPECT_LT(at.outward.dot(d), 1e-6);
    EXPECT_NEAR(sweep_left(leaf, at.point + at.outward * 0.01), 0.01, 2e-3);
  }
  EXPECT_GT(hits, 30);
}

// Balls at rest, and one of no radius.
TEST(SolidShapes, SweepsOfOnePlaceAreBalls) {
  SolidLeaf leaf;
  leaf.shape = SolidShape::sweep;
  SweepPiece piece;
  piece.radius = {0.7, 0.0, 0.0, 0.0};
  leaf.sweep = {piece, SweepPiece()};
  agrees(leaf, [](const V3d& p) { return p.length() < 0.7; });
}

}  // namespace
