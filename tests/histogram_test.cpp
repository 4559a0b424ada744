#include "viewer/window/histogram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lumivec {
namespace {

std::size_t bin_of(float stops) {
  return std::size_t((stops - Histogram::first_stop) * Histogram::bins_per_stop);
}

TEST(Histogram, CountsStopsFromMiddleGray) {
  const std::vector<Color> pixels = {Color(0.18f * 1.01f),
                                     Color(0.18f * 1.01f),
                                     Color(0.18f * 4.04f),
                                     Color(0.0f),
                                     Color(1e-9f),
                                     Color(1e6f),
                                     Color(std::numeric_limits<float>::quiet_NaN())};
  const Histogram h = histogram(pixels, 7, 0.0, 1);
  EXPECT_FLOAT_EQ(h.counts[0][bin_of(0.01f)], std::log10(3.0f));
  EXPECT_FLOAT_EQ(h.counts[0][bin_of(2.01f)], std::log10(2.0f));
  EXPECT_EQ(h.black, 1u);
  EXPECT_EQ(h.below, 1u);
  EXPECT_EQ(h.above, 1u);
  EXPECT_EQ(h.not_finite, 1u);
  const Histogram brighter = histogram(pixels, 7, 1.0, 1);
  EXPECT_FLOAT_EQ(brighter.counts[0][bin_of(1.01f)], std::log10(3.0f));
}

TEST(Histogram, CountsChannelsApart) {
  const Histogram h = histogram({Color(0.19f, 0.0f, 0.37f)}, 1, 0.0, 1);
  EXPECT_GT(h.counts[1][bin_of(0.07f)], 0.0f);
  EXPECT_GT(h.counts[3][bin_of(1.03f)], 0.0f);
  for (const float n : h.counts[2]) EXPECT_EQ(n, 0.0f);
}

TEST(Histogram, TellsSharesOfTerms) {
  std::array<std::vector<Color>, term_count> layers;
  for (auto& layer : layers) layer.assign(4, Color(0.0f));
  EXPECT_EQ(term_shares(layers)[0], 0.0);
  layers[2].assign(4, Color(3.0f));
  layers[3].assign(4, Color(1.0f));
  EXPECT_NEAR(term_shares(layers)[2], 0.75, 1e-6);
  EXPECT_NEAR(term_shares(layers)[3], 0.25, 1e-6);
}

}  // namespace
}  // namespace lumivec
