#include "loader/pov/curves.h"

namespace lumivec::pov {
namespace {

// Coefficients of 1, t, t², t³ for one coordinate.
using Cubic = std::array<double, 4>;

Cubic cubic_of(CurveKind kind, const Point2* p, std::size_t c) {
  switch (kind) {
    case CurveKind::linear:
      return {p[0][c], p[1][c] - p[0][c], 0.0, 0.0};
    case CurveKind::quadratic:  // through three points, from the second to the third
      return {p[1][c], 0.5 * (p[2][c] - p[0][c]), 0.5 * (p[0][c] - 2.0 * p[1][c] + p[2][c]), 0.0};
    case CurveKind::cubic:  // Catmull-Rom
      return {p[1][c], 0.5 * (p[2][c] - p[0][c]),
              p[0][c] - 2.5 * p[1][c] + 2.0 * p[2][c] - 0.5 * p[3][c],
              0.5 * (p[3][c] - p[0][c]) + 1.5 * (p[1][c] - p[2][c])};
    case CurveKind::bezier:
      break;
  }
  return {p[0][c], 3.0 * (p[1][c] - p[0][c]), 3.0 * (p[0][c] - 2.0 * p[1][c] + p[2][c]),
          p[3][c] - p[0][c] + 3.0 * (p[1][c] - p[2][c])};
}

struct Stretch {
  Cubic x;
  Cubic y;
  Point2 at(double t) const {
    const auto value = [&](const Cubic& k) { return k[0] + t * (k[1] + t * (k[2] + t * k[3])); };
    return {value(x), value(y)};
  }
  Point2 tangent(double t) const {
    const auto value = [&](const Cubic& k) { return k[1] + t * (2.0 * k[2] + 3.0 * t * k[3]); };
    return {value(x), value(y)};
  }
};

// Where the points of a stretch begin, and how many there are from one to the next.
struct Layout {
  std::size_t before;  // points that only steer, ahead of a curve
  std::size_t after;   // likewise, behind it
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

void add_stretch(Curve& curve, const Stretch& stretch, int steps) {
  for (int i = curve.points.empty() ? 0 : 1; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    curve.points.push_back(stretch.at(t));
    curve.tangents.push_back(stretch.tangent(t));
  }
}

std::vector<Curve> bezier_curves(const std::vector<Point2>& points, int steps) {
  std::vector<Curve> curves;
  for (std::size_t i = 0; i + 3 < points.size(); i += 4) {
    if (i == 0 || points[i] != points[i - 1]) curves.emplace_back();
    const Point2* p = points.data() + i;
    add_stretch(curves.back(),
                {cubic_of(CurveKind::bezier, p, 0), cubic_of(CurveKind::bezier, p, 1)}, steps);
  }
  return curves;
}

}  // namespace

std::vector<Curve> sample_curves(CurveKind kind, const std::vector<Point2>& points, bool split,
                                 int steps) {
  std::vector<Curve> curves;
  if (kind == CurveKind::bezier) {
    curves = bezier_curves(points, steps);
  } else {
    const Layout layout = layout_of(kind);
    if (kind == CurveKind::linear) steps = 1;
    std::size_t first = layout.before;
    while (first + 1 + layout.after < points.size()) {
      Curve curve;
      std::size_t i = first;
      while (i + 1 + layout.after < points.size()) {
        const Point2* p = points.data() + i - layout.before;
        add_stretch(curve, {cubic_of(kind, p, 0), cubic_of(kind, p, 1)}, steps);
        ++i;
        if (split && points[i] == points[first]) break;
      }
      curves.push_back(std::move(curve));
      if (!split) break;
      first = i + 1 + layout.after + layout.before;
    }
  }
  for (Curve& curve : curves) {
    curve.closed = curve.points.size() > 1 && curve.points.front() == curve.points.back();
    if (kind == CurveKind::linear) curve.tangents.clear();
  }
  return curves;
}

}  // namespace lumivec::pov
