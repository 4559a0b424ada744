// Processor time of the calling thread: what it computes costs, however busy the machine is.
#pragma once

#include <ctime>

namespace lumivec {

inline double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

}  // namespace lumivec
