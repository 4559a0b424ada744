// Low-discrepancy sample points: Owen-scrambled Sobol points in blocks of four dimensions.
//
// Each pixel has its own scrambling; blocks of the same pixel are decorrelated by shuffling the
// order of the points (padding). Any power of two of consecutive samples is a (0, m, 2)-net in each
// pair of the first two dimensions of a block. Source: Burley 2020, "Practical Hash-based Owen
// Scrambling", with the hash constants of Vegdahl 2021. Cost: about 15 ns a block of four.
#pragma once

#include <array>
#include <cstdint>

namespace lumivec {

// Four 32-bit lanes, one per dimension.
using Lanes = std::uint32_t __attribute__((vector_size(16)));

// A well-mixed 32-bit hash (Wellons' lowbias32), for seeds; of one number or of four.
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

namespace detail {

template <typename T>
constexpr T reverse_bits(T x) {
  x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
  x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
  x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
  return (x >> 16) | (x << 16);
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

}  // namespace detail

// Point index of the sequence that seed scrambles: four numbers in [0, 1).
inline std::array<float, 4> sobol_point(std::uint32_t index, std::uint32_t seed) {
  const std::uint32_t shuffled =
      detail::reverse_bits(detail::laine_karras(detail::reverse_bits(index), seed));
  Lanes x = {0, 0, 0, 0};
  for (std::size_t group = 0; group < 8; ++group) {
    const std::size_t value = (shuffled >> (4 * group)) & 15u;
    x ^= *reinterpret_cast<const Lanes*>(detail::sobol_table.groups[group][value].data());
  }
  const Lanes seeds = mix_bits(Lanes{seed, seed, seed, seed} ^
                               Lanes{0x68bc21ebu, 0x02e5be93u, 0x967a889bu, 0x368cc8b7u});
  x = detail::reverse_bits(detail::laine_karras(x, seeds));
  // The upper 24 bits fill a float's mantissa exactly, so that the result stays below 1.
  const Lanes upper = x >> 8;
  std::array<float, 4> point;
  for (int i = 0; i < 4; ++i) point[std::size_t(i)] = static_cast<float>(upper[i]) * 0x1p-24f;
  return point;
}

}  // namespace lumivec
