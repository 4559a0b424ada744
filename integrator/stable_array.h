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
#include <type_traits>

#include "integrator/large_pages.h"

namespace lumivec {

// Elements live in segments. Past the first, four of them double the array, so that at most a fifth
// of the memory is spare. Indices are handed out by grow(); the caller publishes them to other
// threads by a release store of its own (a link that leads to them).
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
    if (count == 0) return first;
    const std::size_t last_segment = segment_of(first + count - 1);
    for (std::size_t s = segment_of(first); s <= last_segment; ++s) {
      if (segments_[s]) continue;
      segments_[s] = allocate(segment_size(s));
      heads_[s].store(segments_[s].get(), std::memory_order_release);
    }
    size_.store(first + count, std::memory_order_release);
    return first;
  }

  // Elements handed out so far.
  std::uint32_t size() const { return size_.load(std::memory_order_acquire); }

  T& operator[](std::uint32_t i) { return head(i)[offset(i)]; }
  const T& operator[](std::uint32_t i) const { return head(i)[offset(i)]; }

  // Of the segments, in use or spare. Not exact while others add elements.
  std::size_t bytes() const {
    const std::uint32_t n = size();
    return n == 0 ? 0 : segment_end(segment_of(n - 1)) * sizeof(T);
  }

  // Gives the memory back. Not while others use the array.
  void clear() {
    size_.store(0, std::memory_order_release);
    for (std::size_t s = 0; s < segment_count; ++s) {
      heads_[s].store(nullptr, std::memory_order_relaxed);
      segments_[s].reset();
    }
  }

 private:
  static constexpr std::uint32_t first_bits = 10;  // the first segment holds 1,024
  static constexpr std::uint32_t max_size = 1u << 31;
  static constexpr std::size_t segment_count = 1 + 4 * (31 - first_bits);

  // Indices from 2^(first_bits + octave − 1) up to twice that are four segments of 2^quarter_bits.
  static std::uint32_t octave_of(std::uint32_t i) {
    return static_cast<std::uint32_t>(std::bit_width(i >> first_bits));
  }
  static std::uint32_t quarter_bits(std::uint32_t octave) { return first_bits + octave - 3; }

  static std::size_t segment_of(std::uint32_t i) {
    const std::uint32_t octave = octave_of(i);
    return octave == 0 ? 0 : 4 * (octave - 1) + 1 + ((i >> quarter_bits(octave)) & 3);
  }
  static std::uint32_t offset(std::uint32_t i) {
    const std::uint32_t octave = octave_of(i);
    return octave == 0 ? i : i & ((1u << quarter_bits(octave)) - 1);
  }
  static std::size_t segment_size(std::size_t s) {
    return std::size_t{1} << (s == 0 ? first_bits : quarter_bits(octave_of_segment(s)));
  }
  static std::size_t segment_end(std::size_t s) {
    if (s == 0) return segment_size(s);
    return (4 + (s - 1) % 4 + 1) << quarter_bits(octave_of_segment(s));
  }
  static std::uint32_t octave_of_segment(std::size_t s) {
    return static_cast<std::uint32_t>((s - 1) / 4 + 1);
  }
  T* head(std::uint32_t i) const { return heads_[segment_of(i)].load(std::memory_order_acquire); }

  static_assert(std::is_trivially_destructible_v<T>);  // segments are only given back
  struct Free {
    std::size_t bytes = 0;
    void operator()(T* segment) const { free_large_pages(segment, bytes, alignof(T)); }
  };
  using Segment = std::unique_ptr<T, Free>;

  static Segment allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    T* elements = static_cast<T*>(allocate_large_pages(bytes, alignof(T)));
    std::uninitialized_value_construct_n(elements, count);
    return Segment(elements, Free{bytes});
  }

  std::mutex mutex_;
  std::atomic<std::uint32_t> size_{0};
  std::array<Segment, segment_count> segments_;
  std::array<std::atomic<T*>, segment_count> heads_{};
};

}  // namespace lumivec
