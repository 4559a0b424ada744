// Eight numbers that a plain loop handles at once. Comparisons keep compilers from
// vectorising such loops, as they might raise floating-point exceptions; signs do not.
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
  if constexpr (n == 8)
    return ~static_cast<unsigned>(_mm256_movemask_ps(_mm256_loadu_ps(v.data()))) & 0xff;
#endif
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < n; ++i) mask |= (~std::bit_cast<std::uint32_t>(v[i]) >> 31) << i;
  return mask;
}

// 2 max(x, 0).
inline float twice_positive_part(float x) {
  return x + std::abs(x);
}

}  // namespace lumivec
