// Plane curves of prisms and lathes: as cubics, and as points.
#pragma once

#include <vector>

#include "loader/pov/areas.h"
#include "loader/pov/shapes.h"
#include "loader/scene.h"

namespace lumivec::pov {

// One coordinate of a stretch, by the points that it takes: 2, 3 or 4.
Cubic cubic_of(CurveKind kind, const std::array<double, 4>& points);

// The least and the greatest of these bound the cubic: a Bézier curve's control values.
std::array<double, 4> control_values(const Cubic& cubic);

// The curves that the points describe: a new one begins where one meets its beginning again. split:
// whether it does; lathes have one, unless their splines are bezier ones that do not meet.
std::vector<std::vector<CurvePiece>> curve_pieces(CurveKind kind, const std::vector<Point2>& points,
                                                  bool split);

struct Curve {
  std::vector<Point2> points;
  std::vector<Point2> tangents;  // of each, if smooth; not normalized
  bool closed = false;
};

// The same as points on them.
std::vector<Curve> sample_curves(CurveKind kind, const std::vector<Point2>& points, bool split,
                                 int steps);

}  // namespace lumivec::pov
