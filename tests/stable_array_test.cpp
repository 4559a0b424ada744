#include "integrator/stable_array.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

namespace lumivec {
namespace {

TEST(StableArray, HoldsWhatWasStoredAcrossSegments) {
  StableArray<std::uint64_t> array;
  constexpr std::uint32_t count = 200'000;
  for (std::uint32_t i = 0; i < count; ++i) {
    ASSERT_EQ(array.grow(), i);
    ASSERT_EQ(array[i], 0u);
    array[i] = std::uint64_t{i} * i;
  }
  EXPECT_EQ(array.size(), count);
  for (std::uint32_t i = 0; i < count; ++i) ASSERT_EQ(array[i], std::uint64_t{i} * i);
}

TEST(StableArray, ElementsDoNotMove) {
  StableArray<int> array;
  array.grow();
  int* first = &array[0];
  array.grow(1'000'000);
  EXPECT_EQ(first, &array[0]);
}

TEST(StableArray, GrowsByManyOverSegmentBorders) {
  StableArray<std::uint32_t> array;
  EXPECT_EQ(array.grow(0), 0u);
  EXPECT_EQ(array.grow(1'000), 0u);
  EXPECT_EQ(array.grow(100'000), 1'000u);
  EXPECT_EQ(array.grow(3), 101'000u);
  for (std::uint32_t i = 0; i < array.size(); ++i) array[i] = i;
  for (std::uint32_t i = 0; i < array.size(); ++i) ASSERT_EQ(array[i], i);
}

TEST(StableArray, LittleOfTheMemoryIsSpare) {
  StableArray<std::uint32_t> array;
  EXPECT_EQ(array.bytes(), 0u);
  for (std::uint32_t i = 0; i < 300'000; ++i) {
    array.grow();
    const std::size_t used = array.size() * sizeof(std::uint32_t);
    ASSERT_GE(array.bytes(), used);
    if (array.size() > 1024) {
      ASSERT_LE(static_cast<double>(array.bytes()), 1.25 * static_cast<double>(used) + 4.0);
    }
  }
}

TEST(StableArray, IsAsNewAfterClear) {
  StableArray<int> array;
  array.grow(5'000);
  for (std::uint32_t i = 0; i < 5'000; ++i) array[i] = 7;
  array.clear();
  EXPECT_EQ(array.size(), 0u);
  EXPECT_EQ(array.bytes(), 0u);
  EXPECT_EQ(array.grow(5'000), 0u);
  for (std::uint32_t i = 0; i < 5'000; ++i) ASSERT_EQ(array[i], 0);
}

TEST(StableArray, ThreadsGetIndicesOfTheirOwn) {
  StableArray<std::uint32_t> array;
  constexpr std::uint32_t threads = 4, each = 20'000;
  std::vector<std::thread> pool;
  for (std::uint32_t t = 0; t < threads; ++t) {
    pool.emplace_back([&array] {
      for (std::uint32_t i = 0; i < each; ++i) ++array[array.grow()];
    });
  }
  for (std::thread& t : pool) t.join();
  ASSERT_EQ(array.size(), threads * each);
  for (std::uint32_t i = 0; i < array.size(); ++i) ASSERT_EQ(array[i], 1u);
}

TEST(StableArray, IsReadWhileItGrows) {
  StableArray<std::uint32_t> array;
  std::atomic<std::uint32_t> published{0};
  constexpr std::uint32_t count = 100'000;
  std::thread writer([&] {
    for (std::uint32_t i = 0; i < count; ++i) {
      array[array.grow()] = i + 1;
      published.store(i + 1, std::memory_order_release);
    }
  });
  std::uint32_t seen = 0;
  bool right = true;
  while (seen < count) {
    seen = published.load(std::memory_order_acquire);
    if (seen > 0) right = right && array[seen - 1] == seen && array[seen / 2] == seen / 2 + 1;
  }
  writer.join();
  EXPECT_TRUE(right);
}

}  // namespace
}  // namespace lumivec
