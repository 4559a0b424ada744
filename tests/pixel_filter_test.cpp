#include "integrator/pixel_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace lumivec {
namespace {

// The filters' formulas (Cycles, pbrt), not normalised.
double formula(PixelFilter filter, double x) {
  switch (filter) {
    case PixelFilter::box:
      return std::abs(x) <= 0.5;
    case PixelFilter::tent:
      return std::max(0.0, 1.0 - std::abs(x));
    case PixelFilter::gaussian:
      return std::max(0.0, std::exp(-2.0 * x * x) - std::exp(-2.0 * 2.25));
    case PixelFilter::blackman_harris: {
      if (std::abs(x) > 0.75) return 0.0;
      const double t = std::numbers::pi * (x / 0.75 + 1.0);
      return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) -
             0.01168 * std::cos(3 * t);
    }
  }
  return 0.0;
}

class pixel_filter : public testing::TestWithParam<PixelFilter> {};
INSTANTIATE_TEST_SUITE_P(all, pixel_filter,
                         testing::Values(PixelFilter::box, PixelFilter::tent, PixelFilter::gaussian,
                                         PixelFilter::blackman_harris));

TEST_P(pixel_filter, samples_are_distributed_as_the_filter) {
  const PixelFilterSampler sampler(GetParam());
  constexpr int bins = 60, samples = 600000;
  constexpr double reach = 1.5;
  std::vector<double> expected(bins), counts(bins);
  double total = 0.0;
  for (int i = 0; i < bins * 100; ++i) {
    const double f = formula(GetParam(), reach * (2.0 * (i + 0.5) / (bins * 100) - 1.0));
    expected[std::size_t(i / 100)] += f;
    total += f;
  }
  for (int i = 0; i < samples; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / samples;
    const double x = sampler.offset(V2f(u, 0.5f)).x;
    ASSERT_LE(std::abs(x), reach);
    const int bin = std::clamp(static_cast<int>((x / reach + 1.0) * 0.5 * bins), 0, bins - 1);
    counts[std::size_t(bin)] += 1.0 / samples;
  }
  for (int i = 0; i < bins; ++i) {
    EXPECT_NEAR(counts[std::size_t(i)], expected[std::size_t(i)] / total, 1e-3) << "bin " << i;
  }
}

TEST_P(pixel_filter, axes_are_alike_and_symmetric) {
  const PixelFilterSampler sampler(GetParam());
  for (const float u : {0.0f, 0.01f, 0.2f, 0.5f, 0.77f, 0x1.fffffep-1f}) {
    const V2f a = sampler.offset(V2f(u, 1.0f - u)), b = sampler.offset(V2f(1.0f - u, u));
    EXPECT_EQ(a.x, b.y);
    EXPECT_NEAR(a.x, -a.y, 1e-3f);
  }
  EXPECT_NEAR(sampler.offset(V2f(0.5f, 0.5f)).x, 0.0f, 1e-4f);
}

}  // namespace
}  // namespace lumivec
