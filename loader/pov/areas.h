// Areas between outlines, by the even-odd rule, as triangles.
#pragma once

#include <array>
#include <vector>

namespace lumivec::pov {

using Point2 = std::array<double, 2>;
using Outline = std::vector<Point2>;         // closed: the last point is joined to the first
using AreaTriangle = std::array<Point2, 3>;  // counter-clockwise

// Holes are outlines within outlines; outlines may cross. Costs the square of the number of points.
std::vector<AreaTriangle> fill_area(const std::vector<Outline>& outlines);

}  // namespace lumivec::pov
