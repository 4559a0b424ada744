// Error against cost as a curve, and what it costs to reach an error.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lumivec {

struct CurvePoint {
  double cost = 0.0;   // > 0, for example core-seconds
  double error = 0.0;  // relMSE, ≥ 0
};

struct CostToReach {
  enum class Kind : std::uint8_t {
    interpolated,  // between two points, in logarithms
    at_most,       // the first point is good enough already
    extrapolated,  // from the last point, as 1 / cost: the error may stop falling before
    unknown        // no points
  };
  double cost = 0.0;
  Kind kind = Kind::unknown;
};

// points: in any order. Where a curve rises again, its last crossing of target counts.
CostToReach cost_to_reach(std::vector<CurvePoint> points, double target);

std::string cost_kind_name(CostToReach::Kind kind);  // "interpolated", "at most", …

// "12.3"; "<12.3": at most; "~12.3": extrapolated; "-": unknown.
std::string cost_text(const CostToReach& cost);

// How many times cheaper cost is than baseline, marked in the same way.
double cost_ratio(const CostToReach& baseline, const CostToReach& cost);  // NaN if one is unknown
std::string cost_ratio_text(const CostToReach& baseline, const CostToReach& cost);

}  // namespace lumivec
