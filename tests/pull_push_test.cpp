#include "viewer/walk/pull_push.h"

#include <gtest/gtest.h>

namespace lumivec::test {
namespace {

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
  pull_push(width, height, known, pixels);
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
  pull_push(3, 2, std::vector<std::uint8_t>(6, 0), pixels);
  for (const Color& c : pixels) EXPECT_EQ(c, Color(0.0f));
}

TEST(pull_push, one_pixel_fills_all) {
  std::vector<Color> pixels(64 * 3, Color(0.0f));
  std::vector<std::uint8_t> known(pixels.size(), 0);
  known[100] = 1;
  pixels[100] = Color(1.0f, 2.0f, 3.0f);
  pull_push(64, 3, known, pixels);
  for (const Color& c : pixels) EXPECT_EQ(c, Color(1.0f, 2.0f, 3.0f));
}

}  // namespace
}  // namespace lumivec::test
