#include "loader/pov/curves.h"

namespace lumivec::pov {
namespace {

// Points that only steer, ahead of a curve and behind it.
struct Layout {
  std::size_t before;
  std::size_t after;
};

Layout layout_of(CurveKind kind) {
  switch (kind) {
    case CurveKind::quadratic:
      return {1, 0};
    case CurveKind::cubic:
      return {1, 1};
    default:
      return {0, 0};
  }
}

// points: the first that the stretch takes.
CurvePiece piece_of(CurveKind kind, const Point2* points, std::size_t count, std::size_t last) {
  CurvePiece piece;
  std::array<double, 4> u{}, v{};
  for (std::size_t i = 0; i < count; ++i) {
    u[i] = points[i][0];
    v[i] = points[i][1];
  }
  piece.u = cubic_of(kind, u);
  piece.v = cubic_of(kind, v);
  piece.end = points[last];
  return piece;
}

bool joins(const CurvePiece& piece, const CurvePiece& next) {
  return piece.end == std::array{next.u[0], next.v[0]};
}

}  // namespace

Cubic cubic_of(CurveKind kind, const std::array<double, 4>& p) {
  switch (kind) {
    case CurveKind::linear:
      return {p[0], p[1] - p[0], 0.0, 0.0};
    case CurveKind::quadratic:  // through three points, from the second to the third
      return {p[1], 0.5 * (p[2] - p[0]), 0.5 * (p[0] - 2.0 * p[1] + p[2]), 0.0};
    case CurveKind::cubic:  // Catmull-Rom
      return {p[1], 0.5 * (p[2] - p[0]), p[0] - 2.5 * p[1] + 2.0 * p[2] - 0.5 * p[3],
              0.5 * (p[3] - p[0]) + 1.5 * (p[1] - p[2])};
    case CurveKind::bezier:
      break;
  }
  return {p[0], 3.0 * (p[1] - p[0]), 3.0 * (p[0] - 2.0 * p[1] + p[2]),
          p[3] - p[0] + 3.0 * (p[1] - p[2])};
}

std::array<double, 4> control_values(const Cubic& c) {
  return {c[0], c[0] + c[1] / 3.0, c[0] + (2.0 * c[1] + c[2]) / 3.0, c[0] + c[1] + c[2] + c[3]};
}

std::vector<std::vector<CurvePiece>> curve_pieces(CurveKind kind, const std::vector<Point2>& points,
                                                  bool split) {
  std::vector<std::vector<CurvePiece>> curves;
  if (kind == CurveKind::bezier) {
    for (std::size_t i = 0; i + 3 < points.size(); i += 4) {
      const CurvePiece piece = piece_of(kind, points.data() + i, 4, 3);
      if (curves.empty() || !joins(curves.back().back(), piece)) curves.emplace_back();
      curves.back().push_back(piece);
    }
    return curves;
  }
  const Layout layout = layout_of(kind);
  std::size_t first = layout.before;
  while (first + 1 + layout.after < points.size()) {
    std::vector<CurvePiece> curve;
    std::size_t i = first;
    while (i + 1 + layout.after < points.size()) {
      curve.push_back(piece_of(kind, points.data() + i - layout.before,
                               layout.before + 2 + layout.after, layout.before + 1));
      ++i;
      if (split && points[i] == points[first]) break;
    }
    curves.push_back(std::move(curve));
    if (!split) break;
    first = i + 1 + layout.after + layout.before;
  }
  return curves;
}

std::vector<Curve> sample_curves(CurveKind kind, const std::vector<Point2>& points, bool split,
                                 int steps) {
  if (kind == CurveKind::linear) steps = 1;
  std::vector<Curve> curves;
  for (const auto& pieces : curve_pieces(kind, points, split)) {
    Curve curve;
    for (const CurvePiece& piece : pieces) {
      const auto value = [](const Cubic& k, double t) {
        return k[0] + t * (k[1] + t * (k[2] + t * k[3]));
      };
      const auto slope = [](const Cubic& k, double t) {
        return k[1] + t * (2.0 * k[2] + 3.0 * t * k[3]);
      };
      for (int i = curve.points.empty() ? 0 : 1; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        curve.points.push_back(i == steps ? piece.end
                                          : Point2{value(piece.u, t), value(piece.v, t)});
        curve.tangents.push_back({slope(piece.u, t), slope(piece.v, t)});
      }
    }
    curve.closed = curve.points.size() > 1 && curve.points.front() == curve.points.back();
    if (kind == CurveKind::linear) curve.tangents.clear();
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace lumivec::pov
