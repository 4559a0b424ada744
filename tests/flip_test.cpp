#include "viewer/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "viewer/heat_colors.h"

using namespace lumivec;

namespace {

constexpr int width = 64;
constexpr int height = 48;

template <typename Pixel>
Picture made(const Pixel& pixel) {
  Picture picture(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) picture.pixels[std::size_t(y * width + x)] = pixel(x, y);
  }
  return picture;
}

// Noise, a ramp and a checkerboard, and a second version of each.
Picture pattern() {
  return made([](int x, int y) {
    return Color(float((x * 7 + y * 13) % 32) / 31.0f, float(x) / 63.0f,
                 float((x / 8 + y / 8) % 2));
  });
}
Picture changed_pattern() {
  return made([](int x, int y) {
    const bool inside = x > 20 && x < 40 && y > 10 && y < 30;
    return Color(float((x * 7 + y * 11) % 32) / 31.0f, float(x) / 63.0f * 0.9f,
                 inside ? 0.5f : float((x / 8 + y / 8) % 2));
  });
}

double flip_of(const Color& a, const Color& b) {
  return mean(flip_map(Picture(32, 32, a), Picture(32, 32, b)));
}

}  // namespace

TEST(Flip, IsZeroForEqualPictures) {
  for (const float value : flip_map(pattern(), pattern())) EXPECT_EQ(value, 0.0f);
}
TEST(Flip, IsSymmetric) {
  const std::vector<float> forth = flip_map(pattern(), changed_pattern());
  const std::vector<float> back = flip_map(changed_pattern(), pattern());
  for (std::size_t i = 0; i < forth.size(); ++i) EXPECT_FLOAT_EQ(forth[i], back[i]);
}
TEST(Flip, StaysBetweenZeroAndOne) {
  const Picture noise = made([](int x, int y) { return Color(float((x + y) % 2)); });
  for (const float value : flip_map(noise, Picture(width, height))) {
    EXPECT_GE(value, 0.0f);
    EXPECT_LE(value, 1.0f);
  }
}

// Solid colours have no features and pass the filters unchanged, so the paper's formulas give these
// by hand: black and white are 100 apart in lightness; 100^0.7 = 25.12 of at most 41.28, beyond the
// knee at 16.51.
TEST(Flip, OfBlackAndWhiteFollowsFromThePaper) {
  EXPECT_NEAR(flip_of(Color(0.0f), Color(1.0f)), 0.96739, 2e-5);
}
TEST(Flip, OfGreenAndBlueIsTheLargest) {
  EXPECT_NEAR(flip_of(Color(0.0f, 1.0f, 0.0f), Color(0.0f, 0.0f, 1.0f)), 1.0, 1e-6);
}
TEST(Flip, ClampsWhatTheDisplayDoes) {
  EXPECT_EQ(flip_of(Color(-0.5f), Color(1.5f)), flip_of(Color(0.0f), Color(1.0f)));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(flip_of(Color(nan), Color(0.0f)), 0.0);
}

// Means that the authors' published program gives for the same pictures, at 67 pixels per degree.
TEST(Flip, AgreesWithTheAuthorsProgram) {
  EXPECT_NEAR(mean(flip_map(pattern(), changed_pattern())), 0.3336688, 2e-5);
  EXPECT_NEAR(flip_map(pattern(), changed_pattern())[20 * width + 30], 0.728047, 1e-4);
  EXPECT_NEAR(flip_of(Color(1.0f, 0.0f, 0.0f), Color(0.0f, 1.0f, 1.0f)), 0.9799185, 2e-5);
  EXPECT_NEAR(flip_of(Color(0.5f), Color(0.52f)), 0.0932745, 2e-5);
  EXPECT_NEAR(flip_of(Color(0.2f, 0.3f, 0.4f), Color(0.25f, 0.3f, 0.4f)), 0.0971398, 2e-5);
}
TEST(Flip, AgreesWithTheAuthorsProgramOnFeatures) {
  const Picture black(width, height);
  const Picture line = made([](int x, int) { return Color(x == 32 ? 1.0f : 0.0f); });
  EXPECT_NEAR(mean(flip_map(black, line)), 0.0825124, 2e-5);
  const Picture dot = made([](int x, int y) { return Color(x == 32 && y == 24 ? 1.0f : 0.0f); });
  EXPECT_NEAR(mean(flip_map(black, dot)), 0.0046570, 2e-5);
}

TEST(Flip, WorksOnOnePixel) {
  EXPECT_GT(mean(flip_map(Picture(1, 1, Color(0.0f)), Picture(1, 1, Color(1.0f)))), 0.9);
}

TEST(HeatPicture, RisesFromBlackToPale) {
  const Picture heat = heat_picture({0.0f, 0.25f, 0.5f, 0.75f, 1.0f, 7.0f}, 6, 1);
  EXPECT_EQ(heat.pixels[0], Color(0.0f));
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_GT(heat.pixels[i].x + heat.pixels[i].y, heat.pixels[i - 1].x + heat.pixels[i - 1].y);
  }
  EXPECT_EQ(heat.pixels[4], heat.pixels[5]);
}
