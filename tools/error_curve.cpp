#include "tools/error_curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "viewer/text_format.h"

namespace lumivec {
namespace {

constexpr int digits = 3;
// An error of 0 is drawn down to here below the target: it has no logarithm.
constexpr double least_share = 1e-3;

}  // namespace

CostToReach cost_to_reach(std::vector<CurvePoint> points, double target) {
  using Kind = CostToReach::Kind;
  if (points.empty()) return {};
  std::sort(points.begin(), points.end(),
            [](const CurvePoint& a, const CurvePoint& b) { return a.cost < b.cost; });
  const auto last_above = std::find_if(points.rbegin(), points.rend(),
                                       [&](const CurvePoint& p) { return p.error > target; });
  if (last_above == points.rend()) return {points.front().cost, Kind::at_most};
  const CurvePoint& above = *last_above;
  if (last_above == points.rbegin()) return {above.cost * above.error / target, Kind::extrapolated};
  const CurvePoint& below = *(last_above - 1);
  const double below_error = std::max(below.error, least_share * target);
  const double share = std::log(above.error / target) / std::log(above.error / below_error);
  return {above.cost * std::pow(below.cost / above.cost, share), Kind::interpolated};
}

std::string cost_kind_name(CostToReach::Kind kind) {
  switch (kind) {
    case CostToReach::Kind::interpolated:
      return "interpolated";
    case CostToReach::Kind::at_most:
      return "at most";
    case CostToReach::Kind::extrapolated:
      return "extrapolated";
    case CostToReach::Kind::unknown:
      break;
  }
  return "unknown";
}

std::string cost_text(const CostToReach& cost) {
  using Kind = CostToReach::Kind;
  if (cost.kind == Kind::unknown) return "-";
  const std::string number = format_number(cost.cost, digits);
  if (cost.kind == Kind::at_most) return std::string("<").append(number);
  if (cost.kind == Kind::extrapolated) return std::string("~").append(number);
  return number;
}

double cost_ratio(const CostToReach& baseline, const CostToReach& cost) {
  if (baseline.kind == CostToReach::Kind::unknown || cost.kind == CostToReach::Kind::unknown) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return baseline.cost / cost.cost;
}

std::string cost_ratio_text(const CostToReach& baseline, const CostToReach& cost) {
  using Kind = CostToReach::Kind;
  const double ratio = cost_ratio(baseline, cost);
  if (!std::isfinite(ratio)) return "-";
  // Bounds on both sides say nothing of the ratio.
  if (baseline.kind == Kind::at_most && cost.kind == Kind::at_most) return "-";
  std::string text;
  if (cost.kind == Kind::at_most) text += '>';
  if (baseline.kind == Kind::at_most) text += '<';
  if (baseline.kind == Kind::extrapolated || cost.kind == Kind::extrapolated) text += '~';
  return text.append(format_number(ratio, digits));
}

}  // namespace lumivec
