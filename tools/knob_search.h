// Finds the value of a setting that gives a wanted count, where larger values give fewer.
#pragma once

#include <functional>

namespace lumivec {

struct KnobRange {
  double start = 0.0, least = 0.0, most = 0.0;  // > 0
};

struct KnobFound {
  double knob = 0.0;
  double count = 0.0;  // at knob, the nearest to what is wanted of all that were tried
  int tries = 0;
};

// Counts at one knob after another until one is within tolerance, a share of wanted, or the range
// or the tries are used up. Between two that enclose wanted it goes by the line through them, in
// logarithms; before that by a power law.
KnobFound find_knob(const std::function<double(double)>& count, const KnobRange& range,
                    double wanted, double tolerance);

}  // namespace lumivec
