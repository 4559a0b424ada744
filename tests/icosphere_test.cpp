#include "integrator/icosphere.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <random>
#include <thread>
#include <vector>

namespace lumivec {
namespace {

using Found = std::map<std::uint32_t, float>;

class IcosphereTest : public testing::Test {
 protected:
  V3f direction() { return direction(random_); }
  static V3f direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    const float x = normal(random), y = normal(random);
    return V3f(x, y, normal(random)).normalized();
  }
  V3f near(const V3f& d, float spread) { return (d + direction() * spread).normalized(); }

  void add(const V3f& d) {
    store_.insert(sphere_, d, static_cast<std::uint32_t>(directions_.size()));
    directions_.push_back(d);
  }

  Found within(const V3f& d, float min_cosine) const {
    Found found;
    store_.for_each_within(sphere_, icosahedron().cone(d, min_cosine),
                           [&](std::uint32_t record, float cosine) {
                             EXPECT_TRUE(found.emplace(record, cosine).second) << "twice";
                           });
    return found;
  }

  // Against all records; directions are kept with an error, so that the border is not sharp.
  void expect_right(const V3f& d, float min_cosine) const {
    const Found found = within(d, min_cosine);
    const double error = 2.0 * packed_direction_error;
    const double angle = std::acos(static_cast<double>(min_cosine));
    for (std::uint32_t i = 0; i < directions_.size(); ++i) {
      const V3d a(d), b(directions_[i]);
      const double between = std::atan2(a.cross(b).length(), a.dot(b));
      // Near 1 a cosine in single precision tells angles apart only so well.
      const double border = error + 1e-3 / (1.0 + 1e3 * std::sin(angle));
      if (between < angle - border) {
        ASSERT_TRUE(found.count(i)) << i << " at " << between << " of " << angle;
        ASSERT_NEAR(found.at(i), std::cos(between), 1.5e-4);
      }
      if (between > angle + border) {
        ASSERT_FALSE(found.count(i)) << i << " at " << between << " of " << angle;
      }
    }
  }
  void expect_right(int queries) {
    for (int q = 0; q < queries; ++q) {
      const float angle = std::uniform_real_distribution<float>(0.0f, q % 2 ? 3.1f : 0.3f)(random_);
      expect_right(direction(), std::cos(angle));
      if (!directions_.empty())
        expect_right(directions_[random_() % directions_.size()], std::cos(angle));
    }
    EXPECT_EQ(within(direction(), -1.0f).size(), directions_.size());
  }

  std::mt19937 random_{1};
  IcosphereStore store_;
  Icosphere sphere_;
  std::vector<V3f> directions_;
};

TEST_F(IcosphereTest, FindsNothingWhenEmpty) {
  EXPECT_TRUE(within(V3f(0.0f, 0.0f, 1.0f), -1.0f).empty());
}

TEST_F(IcosphereTest, EveryCountOfRecords) {
  for (int i = 0; i < 100; ++i) {
    add(direction());
    expect_right(3);
  }
}

TEST_F(IcosphereTest, RandomDirections) {
  for (int i = 0; i < 3'000; ++i) add(direction());
  expect_right(60);
}

TEST_F(IcosphereTest, CrowdedDirections) {
  const V3f middle = direction();
  for (int i = 0; i < 2'000; ++i) add(near(middle, i % 2 == 0 ? 0.3f : 0.01f));
  for (int q = 0; q < 60; ++q) expect_right(near(middle, 0.1f), std::cos(0.002f * (q + 1)));
  expect_right(20);
}

TEST_F(IcosphereTest, FaceCornersAndEdges) {
  for (std::uint32_t f = 0; f < 200; ++f) {
    const std::array<V3f, 3> t = icosahedron().triangle(f);
    for (std::size_t i = 0; i < 3; ++i) {
      add(t[i]);
      add((t[i] + t[(i + 1) % 3]).normalized());
    }
  }
  for (std::uint32_t f = 0; f < 200; f += 3) {
    for (const V3f& corner : icosahedron().triangle(f)) {
      expect_right(corner, 0.9999f);
      expect_right(corner, std::cos(0.1f));
    }
  }
}

// More equal directions than the deepest face has room for.
TEST_F(IcosphereTest, EqualDirections) {
  const V3f d = direction();
  for (int i = 0; i < 1'000; ++i) add(d);
  EXPECT_EQ(within(d, 0.9999f).size(), 1'000u);
  EXPECT_TRUE(within(-d, 0.9999f).empty());
  expect_right(10);
}

TEST_F(IcosphereTest, DividesAFaceOnlyWhenItIsFull) {
  add(direction());
  const std::size_t small = store_.bytes();
  for (std::uint32_t i = 1; i < IcosphereStore::face_capacity; ++i) add(direction());
  EXPECT_EQ(store_.bytes(), small);
  add(direction());
  EXPECT_GT(store_.bytes(), small);
}

TEST_F(IcosphereTest, SpheresOfAStoreAreApart) {
  Icosphere other;
  for (std::uint32_t i = 0; i < 300; ++i) {
    add(direction());
    store_.insert(other, direction(), 1'000 + i);
  }
  expect_right(20);
  const DirectionCone cone = icosahedron().cone(direction(), -1.0f);
  const IcosphereStore::Start starts[] = {{&sphere_, &cone, {0, 0.25f}},
                                          {&other, &cone, {1, 0.5f}}};
  std::array<int, 2> found{};
  store_.for_each_new_within(
      starts, 2, [&](std::uint32_t record, float, const IcosphereStore::Origin& origin) {
        EXPECT_EQ(origin.query, record < 1'000 ? 0u : 1u);
        EXPECT_EQ(origin.distance2, record < 1'000 ? 0.25f : 0.5f);
        ++found[origin.query];
      });
  EXPECT_EQ(found[0], 300);
  EXPECT_EQ(found[1], 300);
}

// More faces and lists than wait at once.
TEST_F(IcosphereTest, ManySpheresAtOnce) {
  std::vector<Icosphere> spheres(30);
  std::uint32_t record = 0;
  for (Icosphere& s : spheres) {
    for (int i = 0; i < 300; ++i) store_.insert(s, direction(), record++);
  }
  const DirectionCone cone = icosahedron().cone(direction(), -1.0f);
  std::vector<IcosphereStore::Start> starts;
  for (std::uint32_t i = 0; i < spheres.size(); ++i) starts.push_back({&spheres[i], &cone, {i}});
  std::vector<int> seen(record);
  store_.for_each_new_within(starts.data(), starts.size(),
                             [&](std::uint32_t r, float, const IcosphereStore::Origin& origin) {
                               ++seen[r];
                               EXPECT_EQ(r / 300, origin.query);
                             });
  for (const int s : seen) ASSERT_EQ(s, 1);
}

// Spheres of a store that are packed, with what was inserted by record numbers.
class PackedIcosphereTest : public IcosphereTest {
 protected:
  void add_to(std::uint32_t sphere, const V3f& d) {
    while (spheres_.size() <= sphere) spheres_.grow();
    store_.insert(spheres_[sphere], d, static_cast<std::uint32_t>(records_.size()));
    records_.push_back({sphere, d});
  }
  // The spheres change their order as well.
  void pack() {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = spheres_.size(); i > 0; --i) order.push_back(i - 1);
    const auto count = static_cast<std::uint32_t>(records_.size());
    const std::vector<std::uint32_t> former = store_.pack(spheres_, order, count);
    ASSERT_EQ(former.size(), count);
    const std::vector<Record> before = records_;
    for (std::uint32_t i = 0; i < count; ++i) {
      records_[i] = before[former[i]];
      records_[i].sphere = spheres_.size() - 1 - records_[i].sphere;
    }
  }
  void expect_sphere(std::uint32_t sphere, const V3f& d, float angle) const {
    Found found;
    store_.for_each_within(spheres_[sphere], icosahedron().cone(d, std::cos(angle)),
                           [&](std::uint32_t record, float cosine) {
                             EXPECT_TRUE(found.emplace(record, cosine).second) << "twice";
                           });
    constexpr float border = 1e-3f;
    for (std::uint32_t i = 0; i < records_.size(); ++i) {
      const V3f& stored = records_[i].direction;
      const float between = std::atan2(d.cross(stored).length(), d.dot(stored));
      const bool own = records_[i].sphere == sphere;
      if (own && between < angle - border) {
        ASSERT_TRUE(found.count(i)) << i << " at " << between << " of " << angle;
        ASSERT_NEAR(found.at(i), std::cos(between), 1.5e-4f);
      }
      if (!own || between > angle + border) {
        ASSERT_FALSE(found.count(i)) << i << " at " << between << " of " << angle;
      }
    }
  }
  void expect_all(int queries) {
    for (std::uint32_t sphere = 0; sphere < spheres_.size(); ++sphere) {
      for (int q = 0; q < queries; ++q) {
        const float angle =
            std::uniform_real_distribution<float>(0.0f, q % 2 ? 3.1f : 0.3f)(random_);
        expect_sphere(sphere, direction(), angle);
        expect_sphere(sphere, records_[random_() % records_.size()].direction, angle);
      }
    }
  }

  struct Record {
    std::uint32_t sphere;
    V3f direction;
  };
  StableArray<Icosphere> spheres_;
  std::vector<Record> records_;
};

TEST_F(PackedIcosphereTest, FindsTheSameAsBefore) {
  for (std::uint32_t sphere = 0; sphere < 12; ++sphere) {
    for (std::uint32_t i = 0; i < 1u << sphere; ++i) add_to(sphere, direction());
  }
  expect_all(3);
  pack();
  expect_all(3);
}

TEST_F(PackedIcosphereTest, NewRecordsAreFoundBesideThePackedOnes) {
  for (int round = 0; round < 3; ++round) {
    for (std::uint32_t i = 0; i < 600; ++i) add_to(i % 5 % 3, direction());
    expect_all(10);
    pack();
    EXPECT_EQ(store_.packed_count(), records_.size());
    expect_all(10);
  }
}

TEST_F(PackedIcosphereTest, CrowdedDirections) {
  const V3f middle = direction();
  for (int i = 0; i < 3'000; ++i) add_to(0, near(middle, i % 2 == 0 ? 0.3f : 0.01f));
  pack();
  for (int q = 0; q < 60; ++q) expect_sphere(0, near(middle, 0.1f), 0.002f * (q + 1));
  expect_all(20);
}

TEST_F(PackedIcosphereTest, TakesLessThanTenBytesARecord) {
  for (std::uint32_t i = 0; i < 20'000; ++i) add_to(i / 100, direction());
  const std::size_t before = store_.bytes();
  pack();
  EXPECT_LT(store_.bytes(), records_.size() * 10);
  EXPECT_LT(store_.bytes(), before / 2);
}

// More than a table can count.
TEST_F(PackedIcosphereTest, ASphereOfVeryManyRecords) {
  constexpr std::uint32_t count = 70'000;
  for (std::uint32_t i = 0; i < count; ++i) add_to(i % 1'000 == 0 ? 1 : 0, direction());
  pack();
  std::vector<int> seen(count);
  for (std::uint32_t sphere = 0; sphere < 2; ++sphere) {
    store_.for_each_within(spheres_[sphere], icosahedron().cone(direction(), -1.0f),
                           [&](std::uint32_t record, float) {
                             ++seen[record];
                             EXPECT_EQ(records_[record].sphere, sphere);
                           });
  }
  for (const int s : seen) ASSERT_EQ(s, 1);
  expect_sphere(1, direction(), 0.1f);
  expect_sphere(0, direction(), 0.1f);
}

TEST_F(IcosphereTest, RecordsAreFoundWhileOthersInsert) {
  constexpr std::uint32_t threads = 3, each = 3'000;
  std::atomic<bool> stop{false};
  std::atomic<int> wrong{0};
  std::vector<std::vector<V3f>> inserted(threads);
  std::thread reader([&] {
    std::mt19937 random(99);
    while (!stop) {
      std::vector<int> seen(threads * each);
      store_.for_each_within(sphere_, icosahedron().cone(direction(random), 0.0f),
                             [&](std::uint32_t record, float) {
                               if (record >= seen.size() || ++seen[record] != 1) ++wrong;
                             });
    }
  });
  std::vector<std::thread> writers;
  for (std::uint32_t t = 0; t < threads; ++t) {
    writers.emplace_back([&, t] {
      std::mt19937 random(t);
      for (std::uint32_t i = 0; i < each; ++i) {
        const V3f d = direction(random);
        inserted[t].push_back(d);
        store_.insert(sphere_, d, t * each + i);
        bool found = false;
        store_.for_each_within(sphere_, icosahedron().cone(d, 0.999f),
                               [&](std::uint32_t r, float) { found |= r == t * each + i; });
        if (!found) ++wrong;
      }
    });
  }
  for (std::thread& t : writers) t.join();
  stop = true;
  reader.join();
  EXPECT_EQ(wrong, 0);
  for (const auto& part : inserted) directions_.insert(directions_.end(), part.begin(), part.end());
  expect_right(10);
}

}  // namespace
}  // namespace lumivec
