// Hands the latest of something from one thread to another: neither ever waits, and what comes too
// fast is passed over.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace lumivec {

template <class T>
class TripleBuffer {
 public:
  // Of the thread that makes: what to fill next; holds something older.
  T& back() { return values_[back_]; }
  // What back() holds is the latest from now on.
  void publish() {
    back_ = middle_.exchange(std::uint8_t(back_ | fresh), std::memory_order_acq_rel) & index;
  }

  // Of the thread that takes: whether there is something newer than front(), which is it then.
  bool take() {
    if ((middle_.load(std::memory_order_relaxed) & fresh) == 0) return false;
    front_ = middle_.exchange(front_, std::memory_order_acq_rel) & index;
    return true;
  }
  const T& front() const { return values_[front_]; }

 private:
  static constexpr std::uint8_t index = 3, fresh = 4;

  std::array<T, 3> values_{};
  std::uint8_t back_ = 0, front_ = 1;
  std::atomic<std::uint8_t> middle_{2};
};

}  // namespace lumivec
