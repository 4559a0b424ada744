#include "loader/pov/splines.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "loader/pov/expression.h"

namespace lumivec::pov {
namespace {

std::optional<SplineKind> kind_of(K keyword) {
  switch (keyword) {
    case K::linear_spline_:
      return SplineKind::linear;
    case K::quadratic_spline_:
      return SplineKind::quadratic;
    case K::cubic_spline_:
      return SplineKind::cubic;
    case K::natural_spline_:
      return SplineKind::natural;
    default:
      return std::nullopt;
  }
}

using Points = std::vector<std::pair<double, Number>>;

double linear(const Points& p, std::size_t i, std::size_t c, double t) {
  const double h = (t - p[i].first) / (p[i + 1].first - p[i].first);
  return p[i].second.n[c] * (1.0 - h) + p[i + 1].second.n[c] * h;
}

// The parabola through three points.
double quadratic(const Points& p, std::size_t i, std::size_t c, double t) {
  const std::size_t first = i == 0 ? 0 : i - 1;
  double sum = 0.0;
  for (std::size_t a = first; a < first + 3; ++a) {
    double weight = 1.0;
    for (std::size_t b = first; b < first + 3; ++b) {
      if (a != b) weight *= (t - p[b].first) / (p[a].first - p[b].first);
    }
    sum += weight * p[a].second.n[c];
  }
  return sum;
}

// Catmull-Rom over uneven times: at each point the slope from the one before to the one after.
double cubic(const Points& p, std::size_t i, std::size_t c, double t) {
  const double t0 = p[i].first, t1 = p[i + 1].first, h = t1 - t0;
  const double a = p[i].second.n[c], b = p[i + 1].second.n[c];
  const double slope0 = (b - p[i - 1].second.n[c]) / (t1 - p[i - 1].first);
  const double slope1 = (p[i + 2].second.n[c] - a) / (p[i + 2].first - t0);
  const double s = (t - t0) / h;
  return a * (1 + 2 * s) * (1 - s) * (1 - s) + b * s * s * (3 - 2 * s) +
         h * (slope0 * s * (1 - s) * (1 - s) - slope1 * s * s * (1 - s));
}

// Second derivatives of the natural spline at all points, by elimination.
std::vector<double> curvatures(const Points& p, std::size_t c) {
  const std::size_t n = p.size();
  std::vector<double> upper(n), result(n);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double before = p[i].first - p[i - 1].first, after = p[i + 1].first - p[i].first;
    const double slope = (p[i + 1].second.n[c] - p[i].second.n[c]) / after -
                         (p[i].second.n[c] - p[i - 1].second.n[c]) / before;
    const double pivot = 2.0 * (before + after) - before * upper[i - 1];
    upper[i] = after / pivot;
    result[i] = (6.0 * slope - before * result[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) result[i] -= upper[i] * result[i + 1];
  return result;
}

double natural(const Points& p, std::size_t i, std::size_t c, double t) {
  const std::vector<double> m = curvatures(p, c);
  const double h = p[i + 1].first - p[i].first;
  const double a = (p[i + 1].first - t) / h, b = (t - p[i].first) / h;
  return a * p[i].second.n[c] + b * p[i + 1].second.n[c] +
         ((a * a * a - a) * m[i] + (b * b * b - b) * m[i + 1]) * h * h / 6.0;
}

}  // namespace

std::shared_ptr<const Spline> parse_spline(Parser& parser) {
  auto spline = std::make_shared<Spline>();
  parser.expect('{', "a spline");
  if (const Slot* slot = parser.meaning(parser.peek());
      slot && (*slot)->kind == ValueKind::spline) {
    *spline = (*slot)->as<Spline>();
    parser.take();
  }
  if (const auto kind = kind_of(parser.peek().keyword())) {
    spline->kind = *kind;
    parser.take();
  }
  bool first = spline->points.empty();
  while (!parser.accept('}')) {
    const double time = parse_float(parser, "a spline's time");
    if (!std::isfinite(time)) parser.fail("a spline's time is not finite");
    skip_comma(parser);
    const Number point = parse_number(parser);
    skip_comma(parser);
    parser.claim(sizeof(spline->points[0]));
    spline->size = first ? point.size : std::max(spline->size, point.size);
    first = false;
    const auto at = std::lower_bound(spline->points.begin(), spline->points.end(), time,
                                     [](const auto& p, double t) { return p.first < t; });
    if (at != spline->points.end() && at->first == time) {
      at->second = point;
    } else {
      spline->points.insert(at, {time, point});
    }
  }
  if (spline->points.empty()) parser.fail("a spline has no points");
  return spline;
}

Number call_spline(Parser& parser, const Spline& held) {
  const Spline spline = held;
  parser.expect('(', "a spline's call");
  const double time = parse_float(parser, "a spline's time");
  SplineKind kind = spline.kind;
  if (parser.accept(',')) {
    const auto given = kind_of(parser.peek().keyword());
    if (!given) parser.fail_expected("the kind of a spline");
    kind = *given;
    parser.take();
  }
  parser.expect(')', "a spline's call");
  if (!std::isfinite(time)) parser.fail("a spline's time is not finite");
  return spline_value(spline, time, kind);
}

Number spline_value(const Spline& spline, double time, SplineKind kind) {
  const Points& p = spline.points;
  Number result;
  result.size = spline.size;
  // What is no number, of functions that call splines, is taken for the beginning.
  if (!(time > p.front().first)) {
    result.n = p.front().second.n;
    return result;
  }
  if (time >= p.back().first) {
    result.n = p.back().second.n;
    return result;
  }
  const auto after = std::upper_bound(p.begin(), p.end(), time,
                                      [](double t, const auto& point) { return t < point.first; });
  const auto i = static_cast<std::size_t>(after - p.begin()) - 1;
  for (std::size_t c = 0; c < spline.size; ++c) {
    switch (kind) {
      case SplineKind::linear:
        result.n[c] = linear(p, i, c, time);
        break;
      case SplineKind::quadratic:
        result.n[c] = p.size() < 3 ? linear(p, i, c, time) : quadratic(p, i, c, time);
        break;
      case SplineKind::cubic:
        // The first and the last stretch lack a neighbour.
        if (i == 0 || i + 2 >= p.size()) {
          result.n[c] = (i == 0 ? p[1] : p[p.size() - 2]).second.n[c];
        } else {
          result.n[c] = cubic(p, i, c, time);
        }
        break;
      case SplineKind::natural:
        result.n[c] = natural(p, i, c, time);
        break;
    }
  }
  return result;
}

}  // namespace lumivec::pov
