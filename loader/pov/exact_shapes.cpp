#include "loader/pov/exact_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "loader/pov/curves.h"
#include "loader/transforms.h"

namespace lumivec::pov {
namespace {

using Imath::Box3d;

void add_line(std::vector<CurvePiece>& pieces, const Point2& to, bool hidden) {
  const Point2 from = pieces.back().end;
  if (from == to) return;
  CurvePiece line;
  line.u = {from[0], to[0] - from[0], 0.0, 0.0};
  line.v = {from[1], to[1] - from[1], 0.0, 0.0};
  line.end = to;
  line.hidden = hidden;
  pieces.push_back(line);
}

// The least distance from the axis.
double least_radius(const std::vector<CurvePiece>& pieces) {
  double least = std::numeric_limits<double>::infinity();
  for (const CurvePiece& piece : pieces) {
    const Cubic& u = piece.u;
    const auto see = [&](double s) {
      if (s >= 0.0 && s <= 1.0)
        least = std::min(least, std::abs(u[0] + s * (u[1] + s * (u[2] + s * u[3]))));
    };
    see(0.0);
    see(1.0);
    // Where its slope is 0.
    const double root = std::sqrt(std::max(u[2] * u[2] - 3.0 * u[1] * u[3], 0.0));
    const double sum = -(u[2] + std::copysign(root, u[2]));
    see(sum / (3.0 * u[3]));
    see(u[1] / sum);
  }
  return least;
}

// Between two heights the square of the radius is a cubic in the height; at the points its slope is
// 2 r r', with r' from the neighbours.
std::vector<CurvePiece> pieces_of(const SorShape& sor) {
  const auto& p = sor.points;
  const auto slope = [&](std::size_t i) {
    const double rise = p[i + 1][1] - p[i - 1][1];
    return rise == 0.0 ? 0.0 : 2.0 * p[i][0] * (p[i + 1][0] - p[i - 1][0]) / rise;
  };
  std::vector<CurvePiece> pieces(1);
  pieces[0].end = {0.0, p[1][1]};  // a point of the axis
  pieces[0].v[0] = p[1][1];
  add_line(pieces, {p[1][0] * p[1][0], p[1][1]}, sor.open);
  for (std::size_t i = 1; i + 2 < p.size(); ++i) {
    const double height = p[i + 1][1] - p[i][1];
    const double a = p[i][0] * p[i][0], b = p[i + 1][0] * p[i + 1][0];
    if (height == 0.0) {
      add_line(pieces, {b, p[i][1]}, false);
      continue;
    }
    const double a_slope = slope(i) * height, b_slope = slope(i + 1) * height;
    CurvePiece piece;
    piece.u = {a, a_slope, 3.0 * (b - a) - 2.0 * a_slope - b_slope,
               2.0 * (a - b) + a_slope + b_slope};
    piece.v = {p[i][1], height, 0.0, 0.0};
    piece.end = {b, p[i + 1][1]};
    pieces.push_back(piece);
  }
  add_line(pieces, {0.0, pieces.back().end[1]}, sor.open);
  return pieces;
}

std::vector<SweepPiece> pieces_of(const SphereSweepShape& sweep) {
  const bool steered = sweep.b_spline || sweep.curve == CurveKind::cubic;
  const std::size_t taken = steered ? 4 : 2;
  std::vector<SweepPiece> pieces;
  for (std::size_t first = 0; first + taken <= sweep.spheres.size(); ++first) {
    const auto cubic = [&](const auto& value) -> Cubic {
      std::array<double, 4> p{};
      for (std::size_t i = 0; i < taken; ++i) p[i] = value(sweep.spheres[first + i]);
      if (!sweep.b_spline) return cubic_of(steered ? CurveKind::cubic : CurveKind::linear, p);
      return {(p[0] + 4.0 * p[1] + p[2]) / 6.0, (p[2] - p[0]) / 2.0,
              (p[0] - 2.0 * p[1] + p[2]) / 2.0, (p[3] - p[0] + 3.0 * (p[1] - p[2])) / 6.0};
    };
    SweepPiece piece;
    for (int axis = 0; axis < 3; ++axis) {
      piece.center[static_cast<std::size_t>(axis)] =
          cubic([&](const auto& sphere) { return sphere.first[axis]; });
    }
    piece.radius = cubic([](const auto& sphere) { return sphere.second; });
    pieces.push_back(piece);
  }
  return pieces;
}

// Of a profile turned around y; u is the radius, or its square.
Box3d turned_bounds(const std::vector<CurvePiece>& pieces, bool squared) {
  Box3d box;
  for (const CurvePiece& piece : pieces) {
    double radius = 0.0;
    for (const double u : control_values(piece.u)) radius = std::max(radius, std::abs(u));
    if (squared) radius = std::sqrt(radius);
    for (const double v : control_values(piece.v)) {
      box.extendBy(V3d(-radius, v, -radius));
      box.extendBy(V3d(radius, v, radius));
    }
  }
  return box;
}

std::vector<CurvePiece> pieces_of(const PrismShape& prism) {
  std::vector<CurvePiece> pieces;
  for (auto& curve : curve_pieces(prism.curve, prism.points, true)) {
    add_line(curve, {curve.front().u[0], curve.front().v[0]}, false);
    pieces.insert(pieces.end(), curve.begin(), curve.end());
  }
  return pieces;
}

// As POV-Ray has it, the inside of a profile that is not closed reaches toward the axis up to the
// least distance that the profile has from it anywhere.
std::vector<CurvePiece> pieces_of(const LatheShape& lathe) {
  auto curves = curve_pieces(lathe.curve, lathe.points, false);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& curve : curves) least = std::min(least, least_radius(curve));
  std::vector<CurvePiece> pieces;
  for (auto& curve : curves) {
    const Point2 first = {curve.front().u[0], curve.front().v[0]};
    if (curve.back().end != first) {
      add_line(curve, {least, curve.back().end[1]}, true);
      add_line(curve, {least, first[1]}, true);
      add_line(curve, first, true);
    }
    pieces.insert(pieces.end(), curve.begin(), curve.end());
  }
  return pieces;
}

}  // namespace

M44d upright_to(const V3d& base, const V3d& along, double wide) {
  int least = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(along[i]) < std::abs(along[least])) least = i;
  }
  V3d other(0.0);
  other[least] = 1.0;
  const V3d x = along.cross(other).normalized(), z = x.cross(along).normalized();
  M44d m;
  for (int i = 0; i < 3; ++i) {
    m[0][i] = x[i] * wide;
    m[1][i] = along[i];
    m[2][i] = z[i] * wide;
    m[3][i] = base[i];
  }
  return m;
}

std::optional<SolidLeaf> exact_prism(const PrismShape& prism) {
  SolidLeaf leaf;
  leaf.shape = SolidShape::prism;
  leaf.curve = pieces_of(prism);
  leaf.low = std::min(prism.low, prism.high);
  leaf.high = std::max(prism.low, prism.high);
  leaf.conic = prism.conic;
  leaf.open = prism.open;
  if (leaf.curve.empty() || !(leaf.low < leaf.high)) return std::nullopt;
  return leaf;
}

std::optional<SolidLeaf> exact_lathe(const LatheShape& lathe) {
  SolidLeaf leaf;
  leaf.shape = SolidShape::lathe;
  leaf.curve = pieces_of(lathe);
  if (leaf.curve.empty()) return std::nullopt;
  return leaf;
}

std::optional<SolidLeaf> exact_sor(const SorShape& sor) {
  SolidLeaf leaf;
  leaf.shape = SolidShape::sor;
  leaf.curve = pieces_of(sor);
  if (leaf.curve.empty()) return std::nullopt;
  return leaf;
}

std::optional<SolidLeaf> exact_superellipsoid(const SuperellipsoidShape& shape) {
  SolidLeaf leaf;
  leaf.shape = SolidShape::superellipsoid;
  leaf.east_west = shape.east_west;
  leaf.north_south = shape.north_south;
  if (!(leaf.east_west > 0.0) || !(leaf.north_south > 0.0)) return std::nullopt;
  return leaf;
}

std::optional<SolidLeaf> exact_blob(const BlobShape& blob) {
  SolidLeaf leaf;
  leaf.shape = SolidShape::blob;
  leaf.threshold = blob.threshold;
  if (!(blob.threshold > 0.0)) return std::nullopt;
  for (const BlobShape::Component& part : blob.components) {
    const double radius = std::abs(part.radius);
    const V3d along = part.cylinder ? part.cap - part.center : V3d(0.0);
    const double length = along.length();
    const V3d up = length > 0.0 ? along * (radius / length) : V3d(0.0, radius, 0.0);
    // What has no extent adds nothing.
    if (radius == 0.0 || part.strength == 0.0) continue;
    const M44d to_blob = upright_to(part.center, up, radius) * part.transform;
    if (!is_invertible(to_blob)) continue;
    leaf.components.push_back({to_blob.inverse(), length / radius, part.strength});
  }
  if (leaf.components.empty()) return std::nullopt;
  return leaf;
}

std::optional<SolidLeaf> exact_sweep(const SphereSweepShape& sweep) {
  SolidLeaf leaf;
  leaf.shape = SolidShape::sweep;
  leaf.sweep = pieces_of(sweep);
  if (leaf.sweep.empty()) return std::nullopt;
  return leaf;
}

Box3d bounds_of(const PrismShape& prism) {
  Box3d box;
  for (const CurvePiece& piece : pieces_of(prism)) {
    const auto u = control_values(piece.u), v = control_values(piece.v);
    for (const double height : {prism.low, prism.high}) {
      const double scale = prism.conic ? height : 1.0;
      for (std::size_t i = 0; i < 4; ++i) box.extendBy(V3d(u[i] * scale, height, v[i] * scale));
    }
  }
  return box;
}

Box3d bounds_of(const LatheShape& lathe) {
  return turned_bounds(pieces_of(lathe), false);
}

Box3d bounds_of(const SorShape& sor) {
  return turned_bounds(pieces_of(sor), true);
}

Box3d bounds_of(const SphereSweepShape& sweep) {
  Box3d box;
  for (const SweepPiece& piece : pieces_of(sweep)) {
    double radius = 0.0;
    for (const double r : control_values(piece.radius)) radius = std::max(radius, std::abs(r));
    std::array<std::array<double, 4>, 3> centers{};
    for (std::size_t axis = 0; axis < 3; ++axis) centers[axis] = control_values(piece.center[axis]);
    for (std::size_t i = 0; i < 4; ++i) {
      const V3d center(centers[0][i], centers[1][i], centers[2][i]);
      box.extendBy(center - V3d(radius));
      box.extendBy(center + V3d(radius));
    }
  }
  return box;
}

}  // namespace lumivec::pov
