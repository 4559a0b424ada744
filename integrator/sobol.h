// Low-discrepancy sample points: Owen-scrambled Sobol points in blocks of four dimensions.
//
// Each pixel has its own scrambling; blocks of the same pixel are decorrelated by shuffling the
// order of the points (padding). Any power of two of consecutive samples is a (0, m, 2)-net in each
// pair of the first two dimensions of a block. Source: Burley 2020, "Practical Hash-based Owen
// Scrambling", with the hash constants of Vegdahl 2021. Cost: about 15 ns a block of four.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace lumivec {

// 32-bit numbers side by side: one point's four dimensions, two points', or eight seeds.
using Lanes4 = std::uint32_t __attribute__((vector_size(16)));
using Lanes8 = std::uint32_t __attribute__((vector_size(32)));

// A well-mixed 32-bit hash (Wellons' lowbias32), for seeds; of one number or of several.
template <typename T>
constexpr T mix_bits(T x) {
  x ^= x >> 16;
  x *= 0x21f0aaadu;
  x ^= x >> 15;
  x *= 0xd35a2d97u;
  x ^= x >> 15;
  return x;
}

constexpr std::uint32_t hash_combine(std::uint32_t seed, std::uint32_t value) {
  return mix_bits(seed ^ (value + 0x9e3779b9u + (seed << 6) + (seed >> 2)));
}
inline Lanes8 hash_combine(Lanes8 seed, Lanes8 value) {
  return mix_bits(seed ^ (value + 0x9e3779b9u + (seed << 6) + (seed >> 2)));
}

namespace detail {

// The order of the bits in each byte.
template <typename T>
constexpr T reverse_bits_of_bytes(T x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  return ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
}

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  return __builtin_bswap32(reverse_bits_of_bytes(x));
}

// Without byte shuffles of the whole width, shifts are faster than what compilers make of one.
inline Lanes4 reverse_bits(Lanes4 x) {
  x = reverse_bits_of_bytes(x);
#ifdef __SSSE3__
  using Bytes = std::uint8_t __attribute__((vector_size(16)));
  constexpr Bytes reversed = {3, 2, 1, 0, 7, 6, 5, 4, 11, 10, 9, 8, 15, 14, 13, 12};
  return reinterpret_cast<Lanes4>(__builtin_shuffle(reinterpret_cast<Bytes>(x), reversed));
#else
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
#endif
}

inline Lanes8 reverse_bits(Lanes8 x) {
  x = reverse_bits_of_bytes(x);
#ifdef __AVX2__
  using Bytes = std::uint8_t __attribute__((vector_size(32)));
  constexpr Bytes reversed = {3,  2,  1,  0,  7,  6,  5,  4,  11, 10, 9,  8,  15, 14, 13, 12,
                              19, 18, 17, 16, 23, 22, 21, 20, 27, 26, 25, 24, 31, 30, 29, 28};
  return reinterpret_cast<Lanes8>(__builtin_shuffle(reinterpret_cast<Bytes>(x), reversed));
#else
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
#endif
}

// A random permutation in which every bit depends on itself and lower bits only; on reversed bits:
// an Owen scrambling.
template <typename T>
constexpr T laine_karras(T x, T seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// Direction numbers of the first four Sobol dimensions (Joe and Kuo 2008), bits reversed, [bit of
// the index][dimension].
constexpr std::array<std::array<std::uint32_t, 4>, 32> sobol_directions() {
  constexpr int degree[4] = {0, 1, 2, 3};
  constexpr std::uint32_t polynomial[4] = {0, 0, 1, 1};
  constexpr std::uint32_t initial[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 3, 0}, {1, 3, 1}};
  std::array<std::array<std::uint32_t, 4>, 32> directions{};
  for (int dimension = 0; dimension < 4; ++dimension) {
    std::uint32_t v[32] = {};
    const int s = degree[dimension];
    for (int i = 0; i < 32; ++i) {
      if (s == 0) {
        v[i] = 1u << (31 - i);
      } else if (i < s) {
        v[i] = initial[dimension][i] << (31 - i);
      } else {
        v[i] = v[i - s] ^ (v[i - s] >> s);
        for (int k = 1; k < s; ++k) {
          if ((polynomial[dimension] >> (s - 1 - k)) & 1u) v[i] ^= v[i - k];
        }
      }
    }
    for (int i = 0; i < 32; ++i) {
      directions[std::size_t(i)][std::size_t(dimension)] = reverse_bits(v[i]);
    }
  }
  return directions;
}

// A Sobol point is the sum (exclusive or) of the direction numbers of the index's bits. Summed up
// beforehand for every value of each group of four bits: eight look-ups a point, and no branch that
// depends on the index. 2 KiB.
struct SobolTable {
  alignas(16) std::array<std::array<std::array<std::uint32_t, 4>, 16>, 8> groups{};
};

constexpr SobolTable sobol_group_sums() {
  const auto directions = sobol_directions();
  SobolTable table;
  for (std::size_t group = 0; group < 8; ++group) {
    for (std::size_t value = 0; value < 16; ++value) {
      for (std::size_t bit = 0; bit < 4; ++bit) {
        if (((value >> bit) & 1u) == 0) continue;
        for (std::size_t d = 0; d < 4; ++d) {
          table.groups[group][value][d] ^= directions[4 * group + bit][d];
        }
      }
    }
  }
  return table;
}

inline constexpr SobolTable sobol_table = sobol_group_sums();

// The place of a point in the shuffled order of a seed's sequence.
template <typename T>
inline T shuffled(T index, T seed) {
  return reverse_bits(laine_karras(reverse_bits(index), seed));
}

inline Lanes4 sobol_bits(std::uint32_t order) {
  const auto part = [order](std::size_t group) {
    const std::size_t value = (order >> (4 * group)) & 15u;
    return *reinterpret_cast<const Lanes4*>(sobol_table.groups[group][value].data());
  };
  return ((part(0) ^ part(1)) ^ (part(2) ^ part(3))) ^ ((part(4) ^ part(5)) ^ (part(6) ^ part(7)));
}

// Each dimension is scrambled by a seed of its own. The upper 24 bits fill a float's mantissa
// exactly, so that the result stays below 1.
inline std::array<float, 4> scrambled(Lanes4 x, std::uint32_t seed) {
  using Floats = float __attribute__((vector_size(16)));
  using Signed = std::int32_t __attribute__((vector_size(16)));
  const Lanes4 seeds = mix_bits(Lanes4{seed, seed, seed, seed} ^
                                Lanes4{0x68bc21ebu, 0x02e5be93u, 0x967a889bu, 0x368cc8b7u});
  x = reverse_bits(laine_karras(x, seeds)) >> 8;
  return std::bit_cast<std::array<float, 4>>(
      __builtin_convertvector(reinterpret_cast<Signed>(x), Floats) * 0x1p-24f);
}

// The same of two points.
inline std::array<std::array<float, 4>, 2> scrambled(Lanes4 a, Lanes4 b, std::uint32_t seed_a,
                                                     std::uint32_t seed_b) {
  using Floats = float __attribute__((vector_size(32)));
  using Signed = std::int32_t __attribute__((vector_size(32)));
  Lanes8 x = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
  const Lanes8 seeds =
      mix_bits(Lanes8{seed_a, seed_a, seed_a, seed_a, seed_b, seed_b, seed_b, seed_b} ^
               Lanes8{0x68bc21ebu, 0x02e5be93u, 0x967a889bu, 0x368cc8b7u,  //
                      0x68bc21ebu, 0x02e5be93u, 0x967a889bu, 0x368cc8b7u});
  x = reverse_bits(laine_karras(x, seeds)) >> 8;
  return std::bit_cast<std::array<std::array<float, 4>, 2>>(
      __builtin_convertvector(reinterpret_cast<Signed>(x), Floats) * 0x1p-24f);
}

}  // namespace detail

// Point index of the sequence that seed scrambles: four numbers in [0, 1).
inline std::array<float, 4> sobol_point(std::uint32_t index, std::uint32_t seed) {
  return detail::scrambled(detail::sobol_bits(detail::shuffled(index, seed)), seed);
}

// The same for eight points of eight sequences at once, in about a third of the time.
inline void sobol_points(const Lanes8& index, const Lanes8& seed,
                         std::array<std::array<float, 4>, 8>& points) {
  const Lanes8 order = detail::shuffled(index, seed);
  for (std::size_t i = 0; i < 8; i += 2) {
    const auto pair = detail::scrambled(detail::sobol_bits(order[i]),
                                        detail::sobol_bits(order[i + 1]), seed[i], seed[i + 1]);
    points[i] = pair[0];
    points[i + 1] = pair[1];
  }
}

}  // namespace lumivec
