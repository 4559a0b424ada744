// An array that grows while others read it: elements never move, and reading an element that has
// been published takes no lock.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>

namespace lumivec {

// Elements live in segments that double in size. One index may be handed out per grow(); the caller
// publishes it to other threads by a release store of its own (a link that leads to it).
template <typename T>
class StableArray {
 public:
  StableArray() = default;
  StableArray(const StableArray&) = delete;
  StableArray& operator=(const StableArray&) = delete;

  // Room for `count` more elements, value-initialised; the index of the first. Thread-safe. Throws
  // std::bad_alloc.
  std::uint32_t grow(std::uint32_t count = 1) {
    const std::lock_guard lock(mutex_);
    const std::uint32_t first = size_.load(std::memory_order_relaxed);
    if (count > max_size - first) throw std::bad_alloc();
    const std::size_t last_segment = segment_of(first + count - 1);
    for (std::size_t s = 0; s <= last_segment; ++s) {
      if (segments_[s]) continue;
      segments_[s] = std::make_unique<T[]>(segment_size(s));
      heads_[s].store(segments_[s].get(), std::memory_order_release);
    }
    size_.store(first + count, std::memory_order_release);
    return first;
  }

  // Elements handed out so far.
  std::uint32_t size() const { return size_.load(std::memory_order_acquire); }

  T& operator[](std::uint32_t i) { return head(i)[offset(i)]; }
  const T& operator[](std::uint32_t i) const { return head(i)[offset(i)]; }

  // Not while others use the array.
  void clear() { size_.store(0, std::memory_order_release); }

 private:
  static constexpr std::uint32_t first_bits = 10;  // the first segment holds 1,024
  static constexpr std::uint32_t max_size = 1u << 31;
  static constexpr std::size_t segment_count = 32 - first_bits;

  static std::size_t segment_of(std::uint32_t i) {
    return static_cast<std::size_t>(std::bit_width((i >> first_bits)));
  }
  static std::size_t segment_size(std::size_t s) {
    return s == 0 ? std::size_t{1} << first_bits : std::size_t{1} << (first_bits + s - 1);
  }
  static std::uint32_t offset(std::uint32_t i) {
    const std::size_t s = segment_of(i);
    return s == 0 ? i : i - (1u << (first_bits + static_cast<std::uint32_t>(s) - 1));
  }
  T* head(std::uint32_t i) const { return heads_[segment_of(i)].load(std::memory_order_acquire); }

  std::mutex mutex_;
  std::atomic<std::uint32_t> size_{0};
  std::array<std::unique_ptr<T[]>, segment_count> segments_;
  std::array<std::atomic<T*>, segment_count> heads_{};
};

}  // namespace lumivec
