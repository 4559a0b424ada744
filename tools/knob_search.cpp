#include "tools/knob_search.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lumivec {
namespace {

constexpr int most_tries = 14;
// Records cover areas that grow as the root of what their error may be.
constexpr double power = 2.0;
// Of one step before there is a bracket: small knobs can cost much time.
constexpr double most_step = 4.0;
// The line through a bracket's ends never leads nearer to one of them than this share.
constexpr double least_share = 0.15;

double log_count(double count) {
  return std::log(std::max(count, 0.5));
}

}  // namespace

KnobFound find_knob(const std::function<double(double)>& count, const KnobRange& range,
                    double wanted, double tolerance) {
  struct Tried {
    double knob = 0.0, count = 0.0;
  };
  std::optional<Tried> many, few;  // the ends of the bracket
  KnobFound best;
  const auto distance = [&](double c) { return std::abs(log_count(c) - log_count(wanted)); };
  double knob = range.start;
  while (best.tries < most_tries) {
    const double found = count(knob);
    if (best.tries == 0 || distance(found) < distance(best.count)) {
      best.knob = knob;
      best.count = found;
    }
    ++best.tries;
    if (std::abs(found - wanted) <= tolerance * wanted) break;
    (found > wanted ? many : few) = Tried{knob, found};
    double next = 0.0;
    if (many && few) {
      const double share = (log_count(many->count) - log_count(wanted)) /
                           (log_count(many->count) - log_count(few->count));
      next = many->knob *
             std::pow(few->knob / many->knob, std::clamp(share, least_share, 1.0 - least_share));
    } else {
      const double step = std::pow(std::max(found, 0.5) / wanted, power);
      next =
          std::clamp(knob * std::clamp(step, 1.0 / most_step, most_step), range.least, range.most);
    }
    if (next == knob) break;  // the end of the range
    knob = next;
  }
  return best;
}

}  // namespace lumivec
