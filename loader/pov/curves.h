// Plane curves of prisms and lathes as points.
#pragma once

#include <vector>

#include "loader/pov/areas.h"
#include "loader/pov/shapes.h"

namespace lumivec::pov {

struct Curve {
  std::vector<Point2> points;
  std::vector<Point2> tangents;  // of each, if smooth; not normalized
  bool closed = false;
};

// The curves that the points describe: a new one begins where one meets its beginning again. split:
// whether it does; lathes have one.
std::vector<Curve> sample_curves(CurveKind kind, const std::vector<Point2>& points, bool split,
                                 int steps);

}  // namespace lumivec::pov
