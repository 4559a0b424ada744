// Splines: points over time, as scenes declare them.
#pragma once

#include <vector>

#include "loader/pov/parser.h"

namespace lumivec::pov {

enum class SplineKind : std::uint8_t { linear, quadratic, cubic, natural };

struct Spline {
  SplineKind kind = SplineKind::linear;
  std::uint8_t size = 3;                          // components
  std::vector<std::pair<double, Number>> points;  // by time
};

// After the word "spline".
std::shared_ptr<const Spline> parse_spline(Parser& parser);

// After a spline's name: (TIME) or (TIME, KIND).
Number call_spline(Parser& parser, const Spline& spline);

// Before the first and after the last point, and where a kind lacks neighbours, it stands still.
Number spline_value(const Spline& spline, double time, SplineKind kind);

}  // namespace lumivec::pov
