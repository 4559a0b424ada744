#include "integrator/point_tree.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <map>
#include <random>
#include <thread>
#include <utility>
#include <vector>

namespace lumivec {
namespace {

struct Point {
  V3f position{0.0f};
  float reach = 0.0f;
};
using Found = std::map<std::uint32_t, float>;

class PointTreeTest : public testing::Test {
 protected:
  float uniform(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random_);
  }
  V3f place(float size = 1.0f) {
    const float x = uniform(-size, size), y = uniform(-size, size);
    return V3f(x, y, uniform(-size, size));
  }

  void add(const Point& p) {
    ASSERT_EQ(tree_.insert(p.position, p.reach), points_.size());
    points_.push_back(p);
  }

  Found reaching(const V3f& p, float scale) const {
    Found found;
    tree_.for_each_reaching(p, scale, [&](std::uint32_t i, float distance2) {
      EXPECT_TRUE(found.emplace(i, distance2).second) << "point " << i << " twice";
    });
    return found;
  }
  Found within(const V3f& p, float distance) const {
    Found found;
    tree_.for_each_within(p, distance, [&](std::uint32_t i, float distance2) {
      EXPECT_TRUE(found.emplace(i, distance2).second) << "point " << i << " twice";
    });
    return found;
  }

  // Several at once, in the same order as one by one.
  void expect_packets_like_single_ones(float size) {
    constexpr std::size_t most = 8;
    using Visits = std::vector<std::pair<std::uint32_t, float>>;
    for (std::size_t count = 0; count <= most; ++count) {
      std::array<PointTree::Reaching, most> queries;
      for (auto& q : queries) q = {place(size), uniform(0.1f, 2.0f)};
      std::array<Visits, most> found;
      tree_.for_each_reaching<most>(queries.data(), count,
                                    [&](std::size_t query, std::uint32_t i, float distance2) {
                                      ASSERT_LT(query, count);
                                      found[query].emplace_back(i, distance2);
                                    });
      for (std::size_t q = 0; q < count; ++q) {
        Visits alone;
        tree_.for_each_reaching(
            queries[q].p, queries[q].scale,
            [&](std::uint32_t i, float distance2) { alone.emplace_back(i, distance2); });
        ASSERT_EQ(found[q], alone) << "query " << q << " of " << count;
      }
    }
  }

  // Against a search through all points; those within a rounding error of the border may go either
  // way.
  template <typename Radius>
  void expect_all(const Found& found, const V3f& p, const Radius& radius) const {
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      const double distance = V3d(V3d(p) - V3d(points_[i].position)).length();
      const double r = radius(points_[i]);
      const double error = 1e-6 * (distance + r);
      if (distance <= r - error || (distance == 0.0 && r == 0.0)) {
        ASSERT_TRUE(found.count(i)) << "point " << i << " at " << distance << " of " << r;
        ASSERT_NEAR(found.at(i), distance * distance, 1e-5 * distance * distance + 1e-30);
      }
      if (distance > r + error) {
        ASSERT_FALSE(found.count(i)) << "point " << i << " at " << distance << " of " << r;
      }
    }
  }

  void expect_right(int queries, float size = 1.0f) {
    for (int q = 0; q < queries; ++q) {
      const V3f p = q % 3 == 0 && !points_.empty() ? points_[random_() % points_.size()].position
                                                   : place(size);
      const float scale = q % 2 == 0 ? 1.0f : uniform(0.1f, 2.0f);
      expect_all(reaching(p, scale), p, [&](const Point& b) { return b.reach * scale; });
      const float distance = q % 5 == 0 ? 0.0f : uniform(0.0f, 0.3f * size);
      expect_all(within(p, distance), p, [&](const Point&) { return distance; });
    }
    expect_packets_like_single_ones(size);
  }
  // As the insertions left the tree; packed; packed with as many again beside.
  void expect_right_in_all_states(float size = 1.0f) {
    expect_right(60, size);
    rebuild();
    expect_right(60, size);
    const std::vector<Point> more = points_;
    for (const Point& p : more) add({p.position + place(0.1f * size), p.reach});
    expect_right(60, size);
    rebuild();
    expect_right(60, size);
  }
  void rebuild() {
    tree_.rebuild([this](std::uint32_t i) { return points_[i].reach; });
  }

  std::mt19937 random_{1};
  PointTree tree_;
  std::vector<Point> points_;
};

TEST_F(PointTreeTest, FindsNothingInAnEmptyTree) {
  EXPECT_TRUE(reaching(V3f(0.0f), 1.0f).empty());
  rebuild();
  EXPECT_TRUE(within(V3f(0.0f), 1e9f).empty());
}

TEST_F(PointTreeTest, RandomPoints) {
  for (int i = 0; i < 1'000; ++i) add({place(), uniform(0.0f, 0.3f)});
  expect_right_in_all_states();
}

TEST_F(PointTreeTest, EveryCountOfPoints) {
  for (int i = 0; i < 150; ++i) {
    add({place(), 0.4f});
    rebuild();
    expect_right(3);
  }
}

TEST_F(PointTreeTest, ReachesOfAllSizes) {
  for (int i = 0; i < 1'000; ++i) add({place(), std::exp(uniform(-12.0f, 1.0f))});
  expect_right_in_all_states();
}

TEST_F(PointTreeTest, EqualPoints) {
  for (int i = 0; i < 500; ++i) add({V3f(0.25f, 0.5f, -0.125f), uniform(0.0f, 1.0f)});
  EXPECT_EQ(within(V3f(0.25f, 0.5f, -0.125f), 0.0f).size(), 500u);
  expect_right_in_all_states();
}

TEST_F(PointTreeTest, CollinearPointsInOrder) {
  for (int i = 0; i < 1'000; ++i)
    add({V3f(-1.0f + 0.002f * static_cast<float>(i), 0.0f, 0.0f), 0.01f});
  expect_right_in_all_states();
}

TEST_F(PointTreeTest, SortedAlongTheDiagonal) {
  for (int i = 1'000; i > 0; --i) add({V3f(0.001f * static_cast<float>(i)), 0.05f});
  expect_right_in_all_states();
}

TEST_F(PointTreeTest, LargeAndSmallScenes) {
  for (const float size : {1e-3f, 1e6f}) {
    tree_.clear();
    points_.clear();
    for (int i = 0; i < 500; ++i) add({place(size), uniform(0.0f, 0.3f * size)});
    expect_right_in_all_states(size);
  }
}

TEST_F(PointTreeTest, FarFromTheOrigin) {
  // A bit of the position is 2^-7 here: the distances of what is stored are exact all the same.
  for (int i = 0; i < 500; ++i) add({V3f(1e5f) + place(10.0f), uniform(0.0f, 3.0f)});
  rebuild();
  for (int q = 0; q < 100; ++q) {
    const V3f p = V3f(1e5f) + place(10.0f);
    expect_all(reaching(p, 1.0f), p, [](const Point& b) { return b.reach; });
  }
}

TEST_F(PointTreeTest, RebuildChangesReachesAndKeepsIndices) {
  for (int i = 0; i < 300; ++i) add({place(), uniform(0.0f, 0.3f)});
  for (Point& p : points_) p.reach *= 0.5f;
  rebuild();
  for (std::uint32_t i = 0; i < tree_.size(); ++i) {
    EXPECT_EQ(tree_.reach(i), points_[i].reach);
    EXPECT_EQ(tree_.position(i), points_[i].position);
  }
  expect_right(60);
}

TEST_F(PointTreeTest, RenumberedPointsAreTheSameUnderNewIndices) {
  for (int i = 0; i < 1'000; ++i) add({place(), uniform(0.0f, 0.1f)});
  rebuild();
  for (int i = 0; i < 100; ++i) add({place(), uniform(0.0f, 0.1f)});
  const std::vector<std::uint32_t> former =
      tree_.renumber([this](std::uint32_t i) { return points_[i].reach; });
  ASSERT_EQ(former.size(), points_.size());
  const std::vector<Point> before = points_;
  for (std::size_t i = 0; i < former.size(); ++i) points_[i] = before[former[i]];
  float distance = 0.0f, distance_before = 0.0f;
  for (std::uint32_t i = 0; i < tree_.size(); ++i) {
    EXPECT_EQ(tree_.reach(i), points_[i].reach);
    EXPECT_EQ(tree_.position(i), points_[i].position);
    if (i == 0) continue;
    distance += (points_[i].position - points_[i - 1].position).length();
    distance_before += (before[i].position - before[i - 1].position).length();
  }
  EXPECT_LT(distance, 0.4f * distance_before);
  expect_right(60);
  for (int i = 0; i < 100; ++i) add({place(), uniform(0.0f, 0.1f)});
  expect_right(60);
}

TEST_F(PointTreeTest, ClearForgetsEverything) {
  for (int i = 0; i < 300; ++i) add({place(), 1.0f});
  rebuild();
  add({place(), 1.0f});
  tree_.clear();
  EXPECT_EQ(tree_.size(), 0u);
  EXPECT_TRUE(reaching(V3f(0.0f), 10.0f).empty());
  EXPECT_EQ(tree_.insert(V3f(0.0f), 1.0f), 0u);
  EXPECT_EQ(reaching(V3f(0.0f), 1.0f).size(), 1u);
}

TEST_F(PointTreeTest, PointsAreFoundAsSoonAsTheyAreInserted) {
  for (int i = 0; i < 500; ++i) add({place(), 0.3f});
  rebuild();
  // What prepare stored must be there whenever a point is found, and a thread finds its own points.
  constexpr int threads = 3, each = 2'000;
  std::vector<std::atomic<int>> prepared(points_.size() + threads * each);
  for (std::size_t i = 0; i < points_.size(); ++i) prepared[i] = 1;
  std::atomic<bool> stop{false};
  std::atomic<int> wrong{0};
  std::thread reader([&] {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> u(-1.0f, 1.0f);
    while (!stop) {
      const V3f p(u(random), u(random), u(random));
      tree_.for_each_reaching(p, 1.0f, [&](std::uint32_t i, float distance2) {
        if (prepared[i].load(std::memory_order_relaxed) != 1) ++wrong;
        if (distance2 != (p - tree_.position(i)).length2()) {
          if (std::abs(distance2 - (p - tree_.position(i)).length2()) > 1e-5f) ++wrong;
        }
      });
    }
  });
  std::vector<std::thread> writers;
  for (unsigned t = 0; t < threads; ++t) {
    writers.emplace_back([&, t] {
      std::mt19937 random(t);
      std::uniform_real_distribution<float> u(-1.0f, 1.0f);
      for (int i = 0; i < each; ++i) {
        const V3f p(u(random), u(random), u(random));
        const std::uint32_t index = tree_.insert(p, 0.2f, [&](std::uint32_t added) {
          prepared[added].store(1, std::memory_order_relaxed);
        });
        bool found = false;
        tree_.for_each_within(p, 0.0f, [&](std::uint32_t j, float) { found |= j == index; });
        if (!found) ++wrong;
      }
    });
  }
  for (std::thread& t : writers) t.join();
  stop = true;
  reader.join();
  EXPECT_EQ(wrong, 0);
  ASSERT_EQ(tree_.size(), prepared.size());
  for (std::uint32_t i = static_cast<std::uint32_t>(points_.size()); i < tree_.size(); ++i)
    points_.push_back({tree_.position(i), tree_.reach(i)});
  expect_right(30);
  rebuild();
  expect_right(30);
}

}  // namespace
}  // namespace lumivec
