#include "integrator/sobol.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

namespace lumivec {
namespace {

TEST(sobol, values_are_in_the_half_open_unit_interval) {
  for (std::uint32_t seed = 0; seed < 64; ++seed) {
    for (std::uint32_t i = 0; i < 4096; ++i) {
      for (const float x : sobol_point(i * 1023u, mix_bits(seed))) {
        ASSERT_GE(x, 0.0f);
        ASSERT_LT(x, 1.0f);
      }
    }
  }
}

TEST(sobol, is_a_function_of_index_and_seed) {
  EXPECT_EQ(sobol_point(12345, 678), sobol_point(12345, 678));
  EXPECT_NE(sobol_point(12345, 678), sobol_point(12345, 679));
  EXPECT_NE(sobol_point(12345, 678), sobol_point(12346, 678));
}

TEST(sobol, eight_points_at_once_are_those_one_by_one) {
  for (std::uint32_t k = 0; k < 256; ++k) {
    Lanes8 index = {}, seed = {};
    for (std::uint32_t i = 0; i < 8; ++i) {
      index[i] = k % 3 == 0 && i % 2 == 0 ? mix_bits(8 * k + i) : 8 * k + i;
      seed[i] = mix_bits(k + i);
    }
    std::array<std::array<float, 4>, 8> points;
    sobol_points(index, seed, points);
    const Lanes8 hashed = hash_combine(seed, index);
    for (std::size_t i = 0; i < 8; ++i) {
      EXPECT_EQ(points[i], sobol_point(index[i], seed[i]));
      EXPECT_EQ(hashed[i], hash_combine(seed[i], index[i]));
    }
  }
}

TEST(sobol, many_points_are_stratified) {
  constexpr std::uint32_t n = 0x20000;
  for (std::size_t d = 0; d < 4; ++d) {
    std::vector<bool> used(n);
    for (std::uint32_t i = 0; i < n; ++i)
      used[static_cast<std::size_t>(sobol_point(i, 99)[d] * static_cast<float>(n))] = true;
    for (const bool u : used) ASSERT_TRUE(u) << "dimension " << d;
  }
}

// Every power of two of the first samples puts one into each of its equal intervals, in each
// dimension.
TEST(sobol, every_dimension_is_stratified) {
  for (const std::uint32_t seed : {0u, 1u, 0xdeadbeefu, 77u}) {
    for (std::uint32_t n = 1; n <= 4096; n *= 2) {
      for (std::size_t d = 0; d < 4; ++d) {
        std::vector<bool> used(n);
        for (std::uint32_t i = 0; i < n; ++i) {
          used[static_cast<std::size_t>(sobol_point(i, seed)[d] * static_cast<float>(n))] = true;
        }
        for (const bool u : used) ASSERT_TRUE(u) << n << " points, dimension " << d;
      }
    }
  }
}

// Any power of two of consecutive samples, aligned: each elementary rectangle of the first two
// dimensions holds one.
TEST(sobol, the_first_two_dimensions_are_a_net) {
  for (const std::uint32_t seed : {0u, 5u, 0xcafef00du}) {
    for (int m = 0; m <= 10; ++m) {
      const std::uint32_t n = 1u << m;
      for (const std::uint32_t first : {0u, n, 5 * n}) {
        for (int across = 0; across <= m; ++across) {
          const std::uint32_t columns = 1u << across, rows = 1u << (m - across);
          std::set<std::uint32_t> cells;
          for (std::uint32_t i = 0; i < n; ++i) {
            const std::array<float, 4> p = sobol_point(first + i, seed);
            cells.insert(static_cast<std::uint32_t>(p[0] * static_cast<float>(columns)) * rows +
                         static_cast<std::uint32_t>(p[1] * static_cast<float>(rows)));
          }
          ASSERT_EQ(cells.size(), n) << columns << " by " << rows << " from " << first;
        }
      }
    }
  }
}

double correlation(std::uint32_t seed_a, std::size_t a, std::uint32_t seed_b, std::size_t b) {
  constexpr std::uint32_t n = 1024;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < n; ++i) {
    sum += (double(sobol_point(i, seed_a)[a]) - 0.5) * (double(sobol_point(i, seed_b)[b]) - 0.5);
  }
  return 12.0 * sum / n;
}

// Blocks and pixels are as good as independent of each other: the correlation of n pairs is about
// 1/√n.
TEST(sobol, blocks_are_uncorrelated) {
  double largest = 0.0, squares = 0.0;
  int pairs = 0;
  for (std::uint32_t block = 0; block < 40; ++block) {
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < 4; ++b) {
        const double c = correlation(hash_combine(99, block), a, hash_combine(99, block + 1), b);
        largest = std::max(largest, std::abs(c));
        squares += c * c;
        ++pairs;
      }
    }
  }
  EXPECT_LT(largest, 4.5 / std::sqrt(1024.0));
  EXPECT_LT(std::sqrt(squares / pairs), 1.3 / std::sqrt(1024.0));
}

TEST(sobol, dimensions_of_a_block_are_uncorrelated) {
  for (std::uint32_t seed = 0; seed < 32; ++seed) {
    for (std::size_t a = 0; a < 4; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_LT(std::abs(correlation(mix_bits(seed), a, mix_bits(seed), b)), 0.05);
      }
    }
  }
}

// One sample in each of many pixels is as uniform as random numbers are.
TEST(sobol, pixels_are_independent) {
  constexpr int bins = 16, pixels = 1 << 16;
  for (std::size_t d = 0; d < 4; ++d) {
    std::vector<int> counts(bins);
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
      const std::uint32_t seed = hash_combine(hash_combine(7, pixel % 256), pixel / 256);
      ++counts[static_cast<std::size_t>(sobol_point(3, hash_combine(seed, 0))[d] * bins)];
    }
    double chi2 = 0.0;
    for (const int c : counts) {
      const double expected = double(pixels) / bins;
      chi2 += (c - expected) * (c - expected) / expected;
    }
    EXPECT_LT(chi2, 37.7) << "dimension " << d;  // one in a thousand at 15 degrees of freedom
  }
}

}  // namespace
}  // namespace lumivec
