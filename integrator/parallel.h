// Loops whose rounds are shared out between the threads of the current arena.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

#include "integrator/denormals.h"

#ifdef __SANITIZE_THREAD__
#include <tbb/task_arena.h>

#include <atomic>
#include <thread>
#include <vector>
#endif

namespace lumivec {

// body(i) for i in [0, count), each by itself: for rounds that take microseconds or more.
template <typename Body>
void for_each(std::size_t count, const Body& body) {
#ifdef __SANITIZE_THREAD__
  // The library is built without the thread sanitizer, which then sees races in how it hands out
  // rounds, and none where they are.
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < tbb::this_task_arena::max_concurrency(); ++t) {
    threads.emplace_back([&] {
      const FlushDenormals flush;
      for (std::size_t i = next++; i < count; i = next++) body(i);
    });
  }
  for (std::thread& thread : threads) thread.join();
#else
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        const FlushDenormals flush;
        for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
      },
      tbb::simple_partitioner());
#endif
}

// Likewise for rounds that take less: `group` of them are handed out at a time.
template <typename Body>
void for_each_in_groups(std::size_t count, std::size_t group, const Body& body) {
  for_each((count + group - 1) / group, [&](std::size_t g) {
    const std::size_t end = std::min(count, (g + 1) * group);
    for (std::size_t i = g * group; i < end; ++i) body(i);
  });
}

}  // namespace lumivec
