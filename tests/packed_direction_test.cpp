#include "integrator/packed_direction.h"

#include <gtest/gtest.h>

#include <random>

namespace lumivec {
namespace {

void expect_kept(const V3f& d) {
  const V3f kept = unpack_direction(pack_direction(d));
  EXPECT_NEAR(kept.length2(), 1.0f, 1e-6f) << d;
  EXPECT_LE((kept - d).length(), packed_direction_error) << d << " became " << kept;
}

TEST(PackedDirection, KeepsDirections) {
  std::mt19937 random(1);
  std::normal_distribution<float> normal;
  for (int i = 0; i < 100'000; ++i) {
    const float x = normal(random), y = normal(random);
    expect_kept(V3f(x, y, normal(random)).normalized());
  }
}

TEST(PackedDirection, KeepsAxesAndFolds) {
  for (const float x : {-1.0f, -1e-6f, 0.0f, 1e-6f, 1.0f}) {
    for (const float y : {-1.0f, -1e-6f, 0.0f, 1e-6f, 1.0f}) {
      for (const float z : {-1.0f, -1e-6f, -0.0f, 0.0f, 1e-6f, 1.0f}) {
        const V3f d(x, y, z);
        if (d.length2() > 0.0f) expect_kept(d.normalized());
      }
    }
  }
}

TEST(PackedDirection, EveryValueIsADirection) {
  std::mt19937 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const auto packed = static_cast<std::uint32_t>(random());
    EXPECT_NEAR(unpack_direction(packed).length2(), 1.0f, 1e-6f) << packed;
  }
  for (const std::uint32_t packed : {0u, ~0u, 0xffffu, 0xffff0000u, 0x7fff7fffu, 0x80008000u})
    EXPECT_NEAR(unpack_direction(packed).length2(), 1.0f, 1e-6f) << packed;
}

}  // namespace
}  // namespace lumivec
