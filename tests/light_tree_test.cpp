#include "integrator/light_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace lumivec {
namespace {

std::mt19937 random_numbers(1);

float uniform(float low, float high) {
  return std::uniform_real_distribution<float>(low, high)(random_numbers);
}

V3f direction() {
  V3f v;
  do {
    v = V3f(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
  } while (v.length2() > 1.0f || v.length2() < 0.01f);
  return v.normalized();
}

// A small flat light at a place.
LightBounds flat_light(const V3f& center, const V3f& normal, float size, bool two_sided) {
  LightBounds b;
  const V3f extent(size * std::sqrt(std::max(0.0f, 1.0f - normal.x * normal.x)),
                   size * std::sqrt(std::max(0.0f, 1.0f - normal.y * normal.y)),
                   size * std::sqrt(std::max(0.0f, 1.0f - normal.z * normal.z)));
  b.min = center - extent;
  b.max = center + extent;
  b.axis = normal;
  b.intensity = uniform(0.1f, 10.0f);
  b.two_sided = two_sided;
  return b;
}

std::vector<LightBounds> random_lights(int count, float size) {
  std::vector<LightBounds> lights;
  for (int i = 0; i < count; ++i) {
    const V3f center(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    if (i % 5 == 0) {  // a point light
      LightBounds b;
      b.min = b.max = center;
      b.cos_spread = -1.0f;
      b.intensity = uniform(0.1f, 10.0f);
      lights.push_back(b);
    } else {
      lights.push_back(flat_light(center, direction(), size, i % 3 == 0));
    }
  }
  return lights;
}

struct Place {
  V3f p, normal;
};
Place random_place() {
  return {V3f(uniform(-2, 2), uniform(-2, 2), uniform(-2, 2)),
          uniform(0, 1) < 0.3f ? V3f(0.0f) : direction()};
}

TEST(light_tree, empty) {
  const LightTree tree{std::vector<LightBounds>{}};
  float u = 0.5f, probability = 0.0f;
  EXPECT_TRUE(tree.empty());
  EXPECT_EQ(tree.sample(V3f(0.0f), V3f(0.0f), u, probability), -1);
  EXPECT_EQ(tree.importance(V3f(0.0f), V3f(0.0f)), 0.0f);
}

TEST(light_tree, probabilities_sum_to_one) {
  for (const int count : {1, 2, 3, 17, 500}) {
    const LightTree tree(random_lights(count, 0.1f));
    for (int i = 0; i < 200; ++i) {
      const Place at = random_place();
      double sum = 0.0;
      for (int light = 0; light < count; ++light) sum += tree.probability(at.p, at.normal, light);
      // Less only where a branch holds nothing that reaches p, and more never.
      EXPECT_LE(sum, 1.0 + 1e-4);
      if (tree.importance(at.p, V3f(0.0f)) > 0.0f && at.normal == V3f(0.0f) && count > 100) {
        EXPECT_GT(sum, 0.9);
      }
    }
  }
}

TEST(light_tree, samples_as_often_as_it_says) {
  constexpr int count = 12, samples = 100000;
  const LightTree tree(random_lights(count, 0.2f));
  for (int i = 0; i < 20; ++i) {
    const Place at = random_place();
    std::vector<int> counts(count);
    int none = 0;
    for (int s = 0; s < samples; ++s) {
      float u = (static_cast<float>(s) + 0.5f) / samples, probability;
      const int light = tree.sample(at.p, at.normal, u, probability);
      if (light < 0) {
        ++none;
        continue;
      }
      ASSERT_GE(u, 0.0f);
      ASSERT_LT(u, 1.0f);
      ASSERT_NEAR(probability, tree.probability(at.p, at.normal, light), 1e-5f);
      ++counts[std::size_t(light)];
    }
    double sum = none;
    for (int light = 0; light < count; ++light) {
      const double expected = double(tree.probability(at.p, at.normal, light)) * samples;
      EXPECT_NEAR(counts[std::size_t(light)], expected, 3.0 + 1e-3 * expected);
      sum += expected;
    }
    EXPECT_NEAR(sum, samples, 5.0);
  }
}

// The number left over by the choice of a light is as good as a fresh one.
TEST(light_tree, leaves_a_uniform_number) {
  const LightTree tree(random_lights(8, 0.2f));
  std::vector<int> bins(10);
  for (int s = 0; s < 100000; ++s) {
    float u = (static_cast<float>(s) + 0.5f) / 100000.0f, probability;
    if (tree.sample(V3f(0.1f, 0.2f, 0.3f), V3f(0.0f), u, probability) >= 0) {
      ++bins[static_cast<std::size_t>(u * 10)];
    }
  }
  for (const int b : bins) EXPECT_NEAR(b, bins[0], 300);
}

// Whether some part of a flat light can send light to the upper side of p.
bool contributes(const V3f& on_light, const LightBounds& light, const Place& at) {
  const V3f to = on_light - at.p;
  if (at.normal != V3f(0.0f) && to.dot(at.normal) <= 1e-4f * to.length()) return false;
  if (light.cos_spread == -1.0f) return true;
  const float leaving = -to.dot(light.axis);
  return light.two_sided ? std::abs(leaving) > 1e-4f * to.length() : leaving > 1e-4f * to.length();
}

TEST(light_tree, whatever_contributes_may_be_chosen) {
  for (const float size : {1e-4f, 0.05f, 1.0f}) {
    const std::vector<LightBounds> lights = random_lights(300, size);
    const LightTree tree(lights);
    for (int i = 0; i < 300; ++i) {
      const Place at = random_place();
      for (std::size_t light = 0; light < lights.size(); ++light) {
        const LightBounds& b = lights[light];
        V3f tangent = b.axis.cross(direction()).normalized();
        const V3f on_light =
            (b.min + b.max) * 0.5f + tangent * (b.cos_spread == -1.0f ? 0.0f : 0.99f * size);
        if (!contributes(on_light, b, at)) continue;
        ASSERT_GT(tree.probability(at.p, at.normal, static_cast<int>(light)), 0.0f)
            << "light " << light << " of size " << size;
      }
    }
  }
}

TEST(light_tree, spots_reach_what_is_in_their_cone) {
  std::vector<LightBounds> lights;
  std::vector<float> outer;
  for (int i = 0; i < 200; ++i) {
    outer.push_back(uniform(0.01f, std::numbers::pi_v<float> / 2));
    LightBounds b;
    b.min = b.max = V3f(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    b.axis = direction();
    b.cos_spread = std::cos(outer.back());
    b.cos_emission = std::cos(1e-3f);
    b.intensity = 1.0f;
    lights.push_back(b);
  }
  const LightTree tree(lights);
  int inside = 0;
  for (int i = 0; i < 1000; ++i) {
    const V3f p = random_place().p;
    for (std::size_t light = 0; light < lights.size(); ++light) {
      const float cosine = (p - lights[light].min).normalized().dot(lights[light].axis);
      if (cosine < lights[light].cos_spread + 1e-4f) continue;
      ++inside;
      ASSERT_GT(tree.probability(p, V3f(0.0f), static_cast<int>(light)), 0.0f);
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST(light_tree, near_lights_are_preferred) {
  std::vector<LightBounds> lights;
  for (int i = 0; i < 1000; ++i) {
    LightBounds b;
    b.min = b.max = V3f(static_cast<float>(i), 0.0f, 0.0f);
    b.cos_spread = -1.0f;
    b.intensity = 1.0f;
    lights.push_back(b);
  }
  const LightTree tree(lights);
  EXPECT_GT(tree.probability(V3f(500.0f, 0.1f, 0.0f), V3f(0.0f), 500), 0.01f);
}

TEST(light_tree, equal_places) {
  std::vector<LightBounds> lights(100);
  for (LightBounds& b : lights) {
    b.min = b.max = V3f(1.0f, 2.0f, 3.0f);
    b.cos_spread = -1.0f;
    b.intensity = 1.0f;
  }
  const LightTree tree(lights);
  for (int light = 0; light < 100; ++light) {
    EXPECT_NEAR(tree.probability(V3f(0.0f), V3f(0.0f), light), 0.01f, 0.006f);
  }
}

TEST(light_tree, a_hundred_thousand_lights) {
  const std::vector<LightBounds> lights = random_lights(100000, 0.001f);
  const LightTree tree(lights);
  for (int i = 0; i < 3; ++i) {
    const Place at = random_place();
    double sum = 0.0;
    bool lit = false;
    for (std::size_t light = 0; light < lights.size(); ++light) {
      const float probability = tree.probability(at.p, at.normal, static_cast<int>(light));
      sum += probability;
      if (contributes((lights[light].min + lights[light].max) * 0.5f, lights[light], at)) {
        lit = true;
        ASSERT_GT(probability, 0.0f);
      }
    }
    EXPECT_LT(sum, 1.001);
    EXPECT_EQ(sum > 0.1, lit);
  }
}

TEST(light_tree, extreme_scales) {
  for (const float scale : {1e-6f, 1e-3f, 1e6f}) {
    std::vector<LightBounds> lights;
    for (LightBounds b : random_lights(100, 0.1f)) {
      b.min *= scale;
      b.max *= scale;
      b.intensity *= scale * scale * 1e6f;
      lights.push_back(b);
    }
    const LightTree tree(lights);
    for (int i = 0; i < 50; ++i) {
      const Place at = random_place();
      double sum = 0.0;
      for (int light = 0; light < 100; ++light) {
        const float probability = tree.probability(at.p * scale, at.normal, light);
        ASSERT_TRUE(std::isfinite(probability));
        sum += probability;
      }
      EXPECT_LT(sum, 1.0001);
      EXPECT_TRUE(std::isfinite(tree.importance(at.p * scale, at.normal)));
    }
  }
}

}  // namespace
}  // namespace lumivec
