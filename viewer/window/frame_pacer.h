// Keeps frames to a rate where swapping buffers does not wait for the display.
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace lumivec {

class FramePacer {
 public:
  // Sleeps until a frame of that many a second is over, since the last call returned. Costs nothing
  // where the display has made it wait already.
  void wait(double rate) {
    using Clock = std::chrono::steady_clock;
    const auto frame = std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(1.0 / std::max(rate, 1.0)));
    const auto end = last_ + frame;
    if (Clock::now() < end) std::this_thread::sleep_until(end);
    last_ = Clock::now();
  }

 private:
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace lumivec
