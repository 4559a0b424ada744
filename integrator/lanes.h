// Eight numbers, or a few times as many, that a plain loop handles at once. Comparisons keep
// compilers from vectorising such loops, as they might raise floating-point exceptions; signs do
// not.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#ifdef __AVX__
#include <immintrin.h>
#endif

namespace lumivec {

// Bit i: the sign of v[i] is positive, zeros included.
template <std::size_t n>
std::uint32_t not_negative(const std::array<float, n>& v) {
  static_assert(n < 32);
#ifdef __AVX__
  if constexpr (n % 8 == 0) {
    std::uint32_t negative = 0;
    for (std::size_t i = 0; i < n; i += 8) {
      negative |= static_cast<unsigned>(_mm256_movemask_ps(_mm256_loadu_ps(v.data() + i))) << i;
    }
    return ~negative & ((1u << n) - 1);
  }
#endif
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < n; ++i) mask |= (~std::bit_cast<std::uint32_t>(v[i]) >> 31) << i;
  return mask;
}

// Which of eight numbers are chosen: packs those of arrays without a branch.
class Chosen {
 public:
  static constexpr std::size_t width = 8;

  // Bit i: number i, i < 8.
  explicit Chosen(std::uint32_t mask) : mask_(mask) {
#ifdef __AVX2__
    lanes_ = _mm256_cvtepu8_epi32(_mm_loadu_si64(&first_lanes[mask]));
#endif
  }

  std::size_t count() const {
    return static_cast<std::size_t>(std::popcount(mask_));
  }
  // Writes the chosen ones, and whatever it is behind them: eight numbers in all.
  template <typename T>
  void store(const T* from, T* to) const {
    static_assert(sizeof(T) == sizeof(std::uint32_t));
#ifdef __AVX2__
    const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_permutevar8x32_epi32(all, lanes_));
#else
    std::size_t n = 0;
    for (std::size_t i = 0; i < width; ++i) {
      to[n] = from[i];
      n += (mask_ >> i) & 1;
    }
#endif
  }

 private:
  std::uint32_t mask_;
#ifdef __AVX2__
  // Of each mask: a byte for each chosen lane.
  static constexpr std::array<std::uint64_t, 256> first_lanes = [] {
    std::array<std::uint64_t, 256> table{};
    for (std::uint32_t mask = 0; mask < table.size(); ++mask) {
      std::uint64_t lanes = 0;
      int n = 0;
      for (std::uint64_t i = 0; i < width; ++i) {
        if ((mask >> i & 1) != 0) lanes |= i << (8 * n++);
      }
      table[mask] = lanes;
    }
    return table;
  }();
  __m256i lanes_;
#endif
};

// 2 max(x, 0).
inline float twice_positive_part(float x) {
  return x + std::abs(x);
}

}  // namespace lumivec
