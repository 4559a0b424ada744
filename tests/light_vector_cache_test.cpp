#include "integrator/light_vector_cache.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <map>
#include <random>
#include <set>
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

  struct Visit {
    int record;
    float distance2, cosine;
    bool operator==(const Visit&) const = default;
  };

  void expect_packets_like_single_ones(std::size_t count) {
    std::vector<LightVectorCache<int>::Query> queries(count);
    for (auto& q : queries) {
      q = {place(), direction(), uniform(0.3f, 1.5f), std::cos(uniform(0.05f, 1.5f))};
      // Some at once at one place, and some that find nothing.
      if (random_() % 4 == 0) q.position = queries[0].position;
      if (random_() % 8 == 0) q.position = V3f(100.0f);
    }
    std::vector<std::vector<Visit>> found(count);
    cache_.look_up(queries.data(), count,
                   [&](std::size_t query, int record, float distance2, float cosine) {
                     ASSERT_LT(query, count);
                     found[query].push_back({record, distance2, cosine});
                   });
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<Visit> alone;
      const auto& q = queries[i];
      cache_.look_up(q.position, q.direction, q.scale, q.min_cosine,
                     [&](int record, float distance2, float cosine) {
                       alone.push_back({record, distance2, cosine});
                     });
      ASSERT_TRUE(found[i] == alone) << "query " << i << " of " << count;
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

TEST_F(LightVectorCacheTest, ManyDirectionsAPosition) {
  for (int i = 0; i < 8; ++i) {
    const V3f p = place();
    for (int d = 0; d < 500; ++d) add({p, 1.0f, direction()});
  }
  for (int round = 0; round < 3; ++round) {
    expect_right(30);
    expect_packets_like_single_ones(100);
    cache_.balance();
    expect_right(30);
    expect_packets_like_single_ones(100);
    // Few new records stay as they are when the cache is balanced again, many do not.
    const int more = round == 0 ? 50 : 3'000;
    for (int i = 0; i < more; ++i) {
      const Entry e = entries_[random_() % entries_.size()];
      add({e.position, e.reach, direction()}, 1e-6f);
    }
  }
}

TEST_F(LightVectorCacheTest, PacketsFindTheSameInTheSameOrder) {
  expect_packets_like_single_ones(3);
  for (int i = 0; i < 300; ++i) {
    const V3f p = place();
    const float reach = uniform(0.1f, 0.8f);
    for (int d = 0; d < 1 + i % 40; ++d) add({p, reach, direction()});
  }
  for (const std::size_t count : {1u, 2u, 15u, 16u, 17u, 100u})
    expect_packets_like_single_ones(count);
  cache_.balance();
  for (const std::size_t count : {1u, 2u, 15u, 16u, 17u, 100u})
    expect_packets_like_single_ones(count);
  for (int i = 0; i < 200; ++i) add({place(), 0.5f, direction()});
  for (const std::size_t count : {1u, 2u, 15u, 16u, 17u, 100u})
    expect_packets_like_single_ones(count);
}

TEST_F(LightVectorCacheTest, BalancingTakesLessMemory) {
  for (int i = 0; i < 100; ++i) {
    const V3f p = place();
    for (int d = 0; d < 100; ++d) add({p, 0.3f, direction()}, 1e-6f);
  }
  const std::size_t before = cache_.bytes();
  cache_.balance();
  EXPECT_LT(cache_.bytes(), before);
  EXPECT_EQ(cache_.position_count(), 100u);
  EXPECT_EQ(cache_.record_count(), 10'000u);
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

class LightVectorCacheInsertionTest : public LightVectorCacheTest,
                                      public testing::WithParamInterface<bool> {};

// With and without records that were packed before.
INSTANTIATE_TEST_SUITE_P(Balanced, LightVectorCacheInsertionTest, testing::Bool());

TEST_P(LightVectorCacheInsertionTest, LookUpsGoOnWhileOthersInsert) {
  constexpr int threads = 3, each = 3'000, corners = 8;
  const auto corner_place = [](int c) {
    return V3f(c & 1 ? 0.5f : -0.5f, c & 2 ? 0.5f : -0.5f, c & 4 ? 0.5f : -0.5f);
  };
  int before = 0;
  if (GetParam()) {
    // Numbered on from what the threads insert.
    for (int i = 0; i < 4'000; ++i) {
      cache_.insert(corner_place(i % corners), 0.3f, 0.001f, direction(),
                    threads * each + ++before);
    }
    cache_.balance();
  }
  std::atomic<bool> stop{false};
  std::atomic<int> wrong{0};
  std::thread reader([&] {
    constexpr std::size_t packet = 20;
    std::vector<LightVectorCache<int>::Query> queries(packet);
    while (!stop) {
      for (auto& q : queries) q = {place(), direction(), 1.0f, 0.5f};
      std::vector<std::vector<int>> seen(packet);
      const auto check = [&](int record, float distance2, float cosine) {
        if (record < 1 || record > threads * each + before) ++wrong;
        if (distance2 > 0.3f * 0.3f || cosine < 0.5f) ++wrong;
      };
      cache_.look_up(queries.data(), packet,
                     [&](std::size_t query, int record, float distance2, float cosine) {
                       check(record, distance2, cosine);
                       seen[query].push_back(record);
                     });
      // A later look-up finds all of that.
      for (std::size_t i = 0; i < packet; ++i) {
        const auto& q = queries[i];
        std::set<int> alone;
        cache_.look_up(q.position, q.direction, q.scale, q.min_cosine,
                       [&](int record, float distance2, float cosine) {
                         check(record, distance2, cosine);
                         if (!alone.insert(record).second) ++wrong;
                       });
        for (const int record : seen[i]) {
          if (alone.count(record) != 1) ++wrong;
        }
      }
    }
  });
  std::vector<std::thread> writers;
  for (unsigned t = 0; t < threads; ++t) {
    writers.emplace_back([&, t] {
      std::mt19937 random(t);
      std::uniform_real_distribution<float> u(-1.0f, 1.0f);
      std::uniform_int_distribution<int> corner(0, corners - 1);
      for (int i = 0; i < each; ++i) {
        // Eight positions for all threads: they grow one sphere together.
        const V3f p = corner_place(corner(random));
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
  EXPECT_EQ(cache_.record_count(), static_cast<std::uint32_t>(threads * each + before));
  expect_packets_like_single_ones(100);
}

}  // namespace
}  // namespace lumivec
