#include "integrator/lanes.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace lumivec {
namespace {

template <std::size_t n>
void expect_signs() {
  for (std::uint32_t pattern = 0; pattern < 1'000; ++pattern) {
    const std::uint32_t bits = pattern * 0x9e3779b9u >> (32 - n);
    std::array<float, n> v;
    for (std::size_t i = 0; i < n; ++i) v[i] = (bits >> i & 1) != 0 ? float(i) : -float(i) - 1.0f;
    ASSERT_EQ(not_negative(v), bits) << n;
  }
}

TEST(Lanes, SignsOfAnyNumberOfThem) {
  expect_signs<3>();
  expect_signs<8>();
  expect_signs<24>();
}

TEST(Lanes, ChosenOnesArePackedForEveryMask) {
  const std::array<std::uint32_t, 8> numbers = {10, 11, 12, 13, 14, 15, 16, 17};
  const std::array<float, 8> floats = {0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f};
  for (std::uint32_t mask = 0; mask < 256; ++mask) {
    const Chosen chosen(mask);
    std::array<std::uint32_t, 8> packed;
    std::array<float, 8> packed_floats;
    chosen.store(numbers.data(), packed.data());
    chosen.store(floats.data(), packed_floats.data());
    std::size_t n = 0;
    for (std::uint32_t i = 0; i < 8; ++i) {
      if ((mask >> i & 1) == 0) continue;
      ASSERT_EQ(packed[n], 10 + i) << mask;
      ASSERT_EQ(packed_floats[n], static_cast<float>(i)) << mask;
      ++n;
    }
    ASSERT_EQ(chosen.count(), n);
  }
}

}  // namespace
}  // namespace lumivec
