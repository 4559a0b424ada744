// Sign changes along stretches of curves, so that neighbours agree: whether a stretch has an odd
// number of them follows from its ends alone, which it shares.
#pragma once

#include <cmath>

#include "integrator/polynomial_roots.h"

namespace lumivec {

// Sign changes of f in 0 ≤ s ≤ 1, whose values at the ends are also known as at_begin and at_end;
// zero counts as positive. Their number is odd if and only if the known signs differ.
inline Roots sign_changes(const Polynomial& f, double at_begin, double at_end) {
  Roots roots = roots_between(f, 0.0, 1.0);
  const bool odd = (at_begin < 0.0) != (at_end < 0.0);
  if ((roots.count % 2 == 1) == odd) return roots;
  // Rounding moved a root over an end.
  if (odd) {
    if (std::abs(at_end) <= std::abs(at_begin)) {
      roots.add(1.0);
    } else {
      for (int i = roots.count; i > 0; --i) roots.x[std::size_t(i)] = roots.x[std::size_t(i - 1)];
      roots.x[0] = 0.0;
      ++roots.count;
    }
    return roots;
  }
  if (roots.x[0] < 1.0 - roots.x[std::size_t(roots.count - 1)]) {
    for (int i = 1; i < roots.count; ++i) roots.x[std::size_t(i - 1)] = roots.x[std::size_t(i)];
  }
  --roots.count;
  return roots;
}

}  // namespace lumivec
