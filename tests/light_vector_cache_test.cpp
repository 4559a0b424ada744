#include "integrator/light_vector_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <map>
#include <random>
#include <thread>
#include <vector>

namespace lumivec {
namespace {

constexpr std::size_t plenty = std::size_t{1} << 30;

struct Entry {
  V3f position{0.0f};
  float reach = 0.0f;
  V3f direction{0.0f};
};

class LightVectorCacheTest : public testing::Test {
 protected:
  float uniform(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random_);
  }
  V3f place() {
    const float x = uniform(-1.0f, 1.0f), y = uniform(-1.0f, 1.0f);
    return V3f(x, y, uniform(-1.0f, 1.0f));
  }
  V3f direction() {
    V3f d(0.0f);
    do d = place();
    while (d.length2() > 1.0f || d.length2() < 0.01f);
    return d.normalized();
  }

  // The record is its own number.
  void add(const Entry& e, float tolerance = 0.0f) {
    ASSERT_TRUE(cache_.insert(e.position, e.reach, tolerance, e.direction,
                              static_cast<int>(entries_.size())));
    entries_.push_back(e);
  }

  void expect_right(int queries) {
    for (int q = 0; q < queries; ++q) {
      const V3f p = place(), d = direction();
      const float scale = uniform(0.3f, 1.5f), angle = uniform(0.05f, 1.5f);
      std::map<int, std::pair<float, float>> found;
      cache_.look_up(p, d, scale, std::cos(angle), [&](int record, float distance2, float cosine) {
        EXPECT_TRUE(found.emplace(record, std::make_pair(distance2, cosine)).second) << "twice";
      });
      for (int i = 0; i < static_cast<int>(entries_.size()); ++i) {
        const Entry& e = entries_[static_cast<std::size_t>(i)];
        const float distance = (p - e.position).length(), reach = e.reach * scale;
        const float between = std::acos(std::clamp(d.dot(e.direction), -1.0f, 1.0f));
        constexpr float border = 1e-3f;
        if (distance < reach - border && between < angle - border) {
          ASSERT_TRUE(found.count(i)) << distance << ", " << between;
          ASSERT_NEAR(found[i].first, distance * distance, 1e-4f);
          ASSERT_NEAR(found[i].second, std::cos(between), 2e-4f);
        }
        if (distance > reach + border || between > angle + border) {
          ASSERT_FALSE(found.count(i)) << distance << ", " << between;
        }
      }
    }
  }

  std::mt19937 random_{1};
  LightVectorCache<int> cache_{plenty};
  std::vector<Entry> entries_;
};

TEST_F(LightVectorCacheTest, FindsWhatASearchThroughAllFinds) {
  for (int i = 0; i < 200; ++i) {
    const V3f p = place();
    const float reach = uniform(0.1f, 0.8f);
    for (int d = 0; d < 1 + i % 40; ++d) add({p, reach, direction()});
  }
  EXPECT_EQ(cache_.position_count(), 200u);
  EXPECT_EQ(cache_.record_count(), entries_.size());
  expect_right(50);
  cache_.balance();
  expect_right(50);
  for (int i = 0; i < 100; ++i) add({place(), 0.3f, direction()});
  expect_right(50);
}

TEST_F(LightVectorCacheTest, SharesPositionsWithinTheTolerance) {
  const V3f p = place();
  add({p, 0.5f, direction()}, 0.01f);
  add({p + V3f(0.005f, 0.0f, 0.0f), 0.5f, direction()}, 0.01f);
  EXPECT_EQ(cache_.position_count(), 1u);
  add({p + V3f(0.02f, 0.0f, 0.0f), 0.5f, direction()}, 0.01f);
  EXPECT_EQ(cache_.position_count(), 2u);
}

TEST_F(LightVectorCacheTest, ALongerReachIsNotLost) {
  const V3f p(0.0f);
  add({p, 0.1f, direction()}, 0.01f);
  add({p, 0.5f, direction()}, 0.01f);
  int found = 0;
  cache_.look_up(V3f(0.4f, 0.0f, 0.0f), direction(), 1.0f, -1.0f,
                 [&](int record, float, float) { found += record == 1 ? 1 : 100; });
  EXPECT_EQ(found, 1);
  // The one that reaches farther is shared from now on.
  add({p, 0.3f, direction()}, 0.01f);
  EXPECT_EQ(cache_.position_count(), 2u);
}

TEST_F(LightVectorCacheTest, AFullCacheStoresNoMoreAndSaysSo) {
  constexpr std::size_t budget = 4 << 20;
  LightVectorCache<std::array<char, 64>> small(budget);
  std::uint64_t stored = 0, refused = 0;
  for (int i = 0; i < 100'000; ++i) {
    const bool there = small.insert(place(), 0.1f, 0.0f, direction(), {});
    ++(there ? stored : refused);
  }
  EXPECT_GT(stored, 1'000u);
  EXPECT_GT(refused, 1'000u);
  EXPECT_EQ(small.record_count(), stored);
  EXPECT_EQ(small.refused_count(), refused);
  EXPECT_TRUE(small.full());
  EXPECT_LE(small.bytes(), budget);
  EXPECT_GE(small.bytes(), budget / 2);
}

TEST_F(LightVectorCacheTest, ClearGivesEverythingBack) {
  for (int i = 0; i < 1'000; ++i) add({place(), 0.3f, direction()});
  cache_.clear();
  entries_.clear();
  EXPECT_EQ(cache_.record_count(), 0u);
  EXPECT_EQ(cache_.bytes(), 0u);
  expect_right(5);
  for (int i = 0; i < 1'000; ++i) add({place(), 0.3f, direction()});
  expect_right(20);
}

TEST_F(LightVectorCacheTest, LookUpsGoOnWhileOthersInsert) {
  constexpr int threads = 3, each = 3'000;
  std::atomic<bool> stop{false};
  std::atomic<int> wrong{0};
  std::thread reader([&] {
    while (!stop) {
      const V3f p = place();
      cache_.look_up(p, direction(), 1.0f, 0.5f, [&](int record, float distance2, float cosine) {
        if (record < 1 || record > threads * each) ++wrong;
        if (distance2 > 0.3f * 0.3f || cosine < 0.5f) ++wrong;
      });
    }
  });
  std::vector<std::thread> writers;
  for (unsigned t = 0; t < threads; ++t) {
    writers.emplace_back([&, t] {
      std::mt19937 random(t);
      std::uniform_real_distribution<float> u(-1.0f, 1.0f);
      std::uniform_int_distribution<int> corner(0, 7);
      for (int i = 0; i < each; ++i) {
        // Eight positions for all threads: they grow one sphere together.
        const int c = corner(random);
        const V3f p(c & 1 ? 0.5f : -0.5f, c & 2 ? 0.5f : -0.5f, c & 4 ? 0.5f : -0.5f);
        const float x = u(random), y = u(random);
        const V3f d = V3f(x, y, u(random) + 1.1f).normalized();
        const int record = static_cast<int>(t) * each + i + 1;
        if (!cache_.insert(p, 0.3f, 0.001f, d, record)) ++wrong;
        bool found = false;
        cache_.look_up(p, d, 1.0f, 0.999f,
                       [&](int other, float, float) { found |= other == record; });
        if (!found) ++wrong;
      }
    });
  }
  for (std::thread& t : writers) t.join();
  stop = true;
  reader.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(cache_.record_count(), static_cast<std::uint32_t>(threads * each));
}

}  // namespace
}  // namespace lumivec
