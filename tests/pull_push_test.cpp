#include "viewer/walk/pull_push.h"

#include <gtest/gtest.h>

namespace lumivec::test {
namespace {

VisibleSurfaces one_surface(std::size_t pixels) {
  VisibleSurfaces seen;
  seen.resize(pixels);
  std::fill(seen.object.begin(), seen.object.end(), 0);
  std::fill(seen.normal.begin(), seen.normal.end(), pack_normal(V3f(0, 0, 1)));
  return seen;
}

// The picture falls into two surfaces, of each of which one pixel in some twenty is known.
TEST(pull_push, surfaces_do_not_bleed) {
  constexpr int width = 40, height = 30;
  VisibleSurfaces seen = one_surface(width * height);
  std::vector<Color> pixels(width * height, Color(0.0f));
  std::vector<std::uint8_t> known(pixels.size(), 0);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const std::size_t x = i % width, y = i / width;
    const bool left = 2 * x + y < 50;
    seen.object[i] = left ? 0 : 1;
    if ((7 * x + 5 * y) % 19 != 0) continue;
    known[i] = 1;
    pixels[i] = left ? Color(1.0f) : Color(0.0f);
  }
  pull_push(width, height, known, seen, pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    EXPECT_NEAR(pixels[i].x, seen.object[i] == 0 ? 1.0f : 0.0f, 0.01f)
        << i % width << ", " << i / width;
}

// A bright disc of which much is known on a wall of which little is: its rim stays sharp.
TEST(pull_push, lamps_do_not_bleed_on_walls) {
  constexpr int size = 64;
  VisibleSurfaces seen = one_surface(size * size);
  std::vector<Color> pixels(size * size, Color(0.0f));
  std::vector<std::uint8_t> known(pixels.size(), 0);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const auto i = static_cast<std::size_t>(y * size + x);
      const bool lamp = (x - 30) * (x - 30) + (y - 29) * (y - 29) < 200;
      seen.object[i] = lamp ? 1 : 0;
      if (!lamp && (x % 23 != 5 || y % 19 != 3)) continue;
      known[i] = 1;
      pixels[i] = Color(lamp ? 17.0f : 0.1f);
    }
  }
  pull_push(size, size, known, seen, pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    EXPECT_NEAR(pixels[i].x, seen.object[i] == 1 ? 17.0f : 0.1f, 1e-4f)
        << i % size << ", " << i / size;
  }
}

TEST(pull_push, keeps_what_is_known_and_fills_the_rest_between) {
  constexpr int width = 37, height = 23;
  std::vector<Color> pixels(width * height, Color(9.0f));
  std::vector<std::uint8_t> known(pixels.size(), 0);
  float low = 1e9f, high = 0.0f;
  for (std::size_t i = 0; i < pixels.size(); i += 11) {
    known[i] = 1;
    const auto value = static_cast<float>(i % 7) + 1.0f;
    pixels[i] = Color(value, 2.0f, 0.0f);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const std::vector<Color> before = pixels;
  pull_push(width, height, known, one_surface(pixels.size()), pixels);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (known[i] != 0) {
      EXPECT_EQ(pixels[i], before[i]);
    }
    EXPECT_GE(pixels[i].x, low - 1e-5f);
    EXPECT_LE(pixels[i].x, high + 1e-5f);
    EXPECT_NEAR(pixels[i].y, 2.0f, 1e-5f) << "a constant stays one";
    EXPECT_EQ(pixels[i].z, 0.0f);
  }
}

TEST(pull_push, nothing_known_is_black) {
  std::vector<Color> pixels(6, Color(3.0f));
  pull_push(3, 2, std::vector<std::uint8_t>(6, 0), one_surface(6), pixels);
  for (const Color& c : pixels) EXPECT_EQ(c, Color(0.0f));
}

TEST(pull_push, one_pixel_fills_all) {
  std::vector<Color> pixels(64 * 3, Color(0.0f));
  std::vector<std::uint8_t> known(pixels.size(), 0);
  known[100] = 1;
  pixels[100] = Color(1.0f, 2.0f, 3.0f);
  pull_push(64, 3, known, one_surface(pixels.size()), pixels);
  for (const Color& c : pixels) EXPECT_EQ(c, Color(1.0f, 2.0f, 3.0f));
}

}  // namespace
}  // namespace lumivec::test
