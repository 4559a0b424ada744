// What waits until its memory has been fetched: a line of fixed length, in which each that comes
// pushes the oldest on to what is next.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace lumivec {

template <typename T, std::uint32_t length>
class WaitingLine {
 public:
  static_assert(std::has_single_bit(length));

  // Calls next(oldest) if the line is full.
  template <typename Next>
  void add(const T& item, const Next& next) {
    if (end_ - begin_ == length) next(items_[begin_++ % length]);
    items_[end_++ % length] = item;
  }
  // Calls next(item) for all.
  template <typename Next>
  void finish(const Next& next) {
    while (begin_ != end_) next(items_[begin_++ % length]);
  }

 private:
  std::uint32_t begin_ = 0, end_ = 0;
  std::array<T, length> items_;
};

}  // namespace lumivec
