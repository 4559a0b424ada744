// Loops whose rounds are shared out between the threads of the current arena.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

#include "integrator/denormals.h"

namespace lumivec {

// body(i) for i in [0, count), each by itself: for rounds that take microseconds or more.
template <typename Body>
void for_each(std::size_t count, const Body& body) {
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        const FlushDenormals flush;
        for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
      },
      tbb::simple_partitioner());
}

}  // namespace lumivec
