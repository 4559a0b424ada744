// Where records of the cache of irradiance hold, and what they say there.
#include "integrator/irradiance_cache.h"

#include "test_scenes.h"

namespace lumivec::test {
namespace {

const V3f up(0.0f, 1.0f, 0.0f);

IrradianceRecord record(const V3f& position, float radius, const Color& irradiance) {
  IrradianceRecord r;
  r.position = position;
  r.normal = up;
  r.light.add(irradiance, up);
  r.radius_small = r.radius_large = radius;
  r.mean_distance = 10.0f * radius;
  r.clearance.fill(100.0f);
  r.passes = 1;
  return r;
}

CachePoint point(const V3f& position, const V3f& normal = up) {
  CachePoint p;
  p.position = position;
  p.geometric_normal = p.normal = normal;
  p.error = 1e-5f;
  return p;
}

struct Fixture {
  explicit Fixture(bool wall = false, std::uint64_t bytes = 1u << 20, ValidityParts parts = {})
      : scene(make_scene(wall)), traced(scene, 1), cache(traced, parts, bytes) {}

  static Scene make_scene(bool wall) {
    Scene scene;
    add_mesh(scene, quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), diffuse(Color(0.5f)));
    if (wall) add_mesh(scene, quad({0, 0, -5}, {0, 0, 10}, {0, 5, 0}), diffuse(Color(0.5f)));
    return scene;
  }

  bool look_up(const CachePoint& at, CachedLight& light, float budget = 1.0f,
               float needed = 0.0f) const {
    std::uint64_t rays = 0;
    return cache.look_up(at, budget, needed, light, rays);
  }

  Scene scene;
  TracedScene traced;
  IrradianceCache cache;
};

TEST(irradiance_cache, exact_at_the_record_and_nothing_beyond_its_reach) {
  Fixture f;
  ASSERT_TRUE(f.cache.insert(record({1, 0, 1}, 0.5f, {1, 2, 3})));
  CachedLight light;
  ASSERT_TRUE(f.look_up(point({1, 0, 1}), light));
  EXPECT_EQ(light.light.irradiance(up), Color(1, 2, 3));
  EXPECT_FLOAT_EQ(light.weight, 1.0f);
  EXPECT_TRUE(f.look_up(point({1.49f, 0, 1}), light));
  EXPECT_LT(light.weight, 0.01f);
  EXPECT_FALSE(f.look_up(point({1.51f, 0, 1}), light));
  // Sixteen times the budget, twice the reach.
  EXPECT_TRUE(f.look_up(point({1.99f, 0, 1}), light, 16.0f));
  EXPECT_FALSE(f.look_up(point({2.01f, 0, 1}), light, 16.0f));
  EXPECT_FALSE(f.look_up(point({1.2f, 0, 1}), light, 1.0f, 0.99f)) << "too little weight";
}

TEST(irradiance_cache, other_normals_and_other_heights_are_refused) {
  Fixture f;
  f.cache.insert(record({0, 0, 0}, 1.0f, Color(1)));
  CachedLight light;
  EXPECT_TRUE(f.look_up(point({0, 0, 0}, V3f(0.5f, 0.866f, 0).normalized()), light));
  EXPECT_FALSE(f.look_up(point({0, 0, 0}, V3f(0.7f, 0.7f, 0).normalized()), light));
  EXPECT_FALSE(f.look_up(point({0, 0, 0}, -up), light));
  EXPECT_FALSE(f.look_up(point({0, 0.3f, 0}), light)) << "a step";
}

TEST(irradiance_cache, gradients_extrapolate_within_bounds) {
  Fixture f;
  IrradianceRecord r = record({0, 0, 0}, 1.0f, Color(1));
  for (V2f& g : r.gradient) g = V2f(0.5f, 0.0f);
  f.cache.insert(r);
  // The frame's first axis is not the world's: the largest change over all directions is the slope.
  float most = 0.0f, least = 2.0f;
  for (float a = 0.0f; a < 6.28f; a += 0.01f) {
    CachedLight light;
    ASSERT_TRUE(f.look_up(point({0.4f * std::cos(a), 0, 0.4f * std::sin(a)}), light));
    most = std::max(most, light.light.irradiance(up).x);
    least = std::min(least, light.light.irradiance(up).x);
  }
  EXPECT_NEAR(most, 1.2f, 1e-3f);
  EXPECT_NEAR(least, 0.8f, 1e-3f);
}

// Nothing jumps along a line over records that differ.
TEST(irradiance_cache, continuous) {
  Fixture f;
  for (int i = -4; i <= 4; ++i) {
    f.cache.insert(record({0.4f * float(i), 0, 0.1f * float(i % 3)}, 0.7f + 0.05f * float(i % 2),
                          Color(1.0f + float((i * i) % 5))));
  }
  f.cache.rebuild();
  constexpr float step = 1e-4f;
  float before = -1.0f;
  for (float x = -1.2f; x < 1.2f; x += step) {
    CachedLight light;
    ASSERT_TRUE(f.look_up(point({x, 0, 0}), light));
    const float here = light.light.irradiance(up).x;
    // The weights' slopes, a few per unit of length, times the spread of the values.
    if (before >= 0.0f) {
      EXPECT_NEAR(here, before, 100.0f * step) << x;
    }
    before = here;
  }
}

TEST(irradiance_cache, a_wall_is_not_seen_through) {
  Fixture f(true);
  IrradianceRecord bright = record({-0.1f, 0, 0}, 1.0f, Color(100));
  bright.clearance.fill(0.05f);
  f.cache.insert(bright);
  CachedLight light;
  EXPECT_TRUE(f.look_up(point({-0.3f, 0, 0.1f}), light)) << "its own side";
  EXPECT_FALSE(f.look_up(point({0.1f, 0, 0}), light)) << "beyond the wall";
  ValidityParts parts;
  parts.leak_guard = false;
  Fixture leaky(true, 1u << 20, parts);
  leaky.cache.insert(bright);
  EXPECT_TRUE(leaky.look_up(point({0.1f, 0, 0}), light)) << "what the guard is for";
}

TEST(irradiance_cache, neighbours_bound_each_other) {
  Fixture f;
  f.cache.insert(record({0, 0, 0}, 0.1f, Color(1)));
  f.cache.insert(record({0.5f, 0, 0}, 2.0f, Color(1)));
  f.cache.commit(1.0f);
  EXPECT_NEAR(f.cache.record(1).radius_large, 0.6f, 1e-6f);
  EXPECT_FLOAT_EQ(f.cache.record(0).radius_large, 0.1f);
}

TEST(irradiance_cache, full_stores_no_more) {
  Fixture f(false, 10 * 200);
  int stored = 0;
  for (int i = 0; i < 100; ++i) stored += f.cache.insert(record({float(i), 0, 0}, 1.0f, Color(1)));
  EXPECT_GT(stored, 3);
  EXPECT_LT(stored, 11);
  EXPECT_TRUE(f.cache.full());
  EXPECT_EQ(f.cache.size(), std::uint32_t(stored));
}

}  // namespace
}  // namespace lumivec::test
