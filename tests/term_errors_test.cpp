#include "tools/term_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

using namespace lumivec;

namespace {

Framebuffer uniform(float value, int size = 2) {
  Framebuffer framebuffer;
  framebuffer.width = framebuffer.height = size;
  for (std::vector<Color>& term : framebuffer.terms) {
    term.assign(framebuffer.pixel_count(), Color(value));
  }
  return framebuffer;
}

// The true picture, which is 1, with noise of that standard deviation.
TermPictures noisy(double deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(0.0f, static_cast<float>(deviation));
  Framebuffer framebuffer = uniform(1.0f, 64);
  for (std::vector<Color>& term : framebuffer.terms) {
    for (Color& c : term) c += Color(noise(random), noise(random), noise(random));
  }
  return term_pictures(framebuffer);
}

TermPictures mean_of(const TermPictures& a, const TermPictures& b) {
  TermPictures mean = a;
  for (std::size_t i = 0; i < layer_count; ++i) {
    for (std::size_t p = 0; p < mean[i].pixels.size(); ++p) {
      mean[i].pixels[p] = (a[i].pixels[p] + b[i].pixels[p]) * 0.5f;
    }
  }
  return mean;
}

}  // namespace

TEST(TermErrors, AreOfEachTermAndTheSum) {
  Framebuffer test = uniform(1.0f);
  for (Color& c : test.terms[indirect_layer]) c = Color(1.5f);
  const TermErrors errors =
      term_errors(term_pictures(test), term_pictures(uniform(1.0f)), TermNoise());
  for (std::size_t i = 0; i < layer_count; ++i) {
    const bool differs = i == indirect_layer || i == sum_layer;
    EXPECT_NEAR(errors[i].rmse, differs ? 0.5 : 0.0, 1e-7) << error_layer_name(i);
    const double reference = i == sum_layer ? 5.0 : 1.0;
    EXPECT_NEAR(errors[i].relmse, differs ? 0.25 / (reference * reference + 0.01) : 0.0, 1e-7);
    EXPECT_FALSE(errors[i].below_noise);
  }
}
TEST(TermErrors, TellTheNoiseOfAReferenceByItsHalves) {
  const TermPictures a = noisy(0.1, 1), b = noisy(0.1, 2), mean = mean_of(a, b);
  const TermNoise noise = noise_of_halves(a, mean);
  const TermPictures truth = term_pictures(uniform(1.0f, 64));
  const TermErrors real = term_errors(mean, truth, TermNoise());
  for (std::size_t i = 0; i < layer_count; ++i) {
    EXPECT_NEAR(noise[i].rmse, real[i].rmse, 0.05 * real[i].rmse);
    EXPECT_NEAR(noise[i].relmse, real[i].relmse, 0.1 * real[i].relmse);
  }
}
TEST(TermErrors, AreFreeOfTheReferencesNoise) {
  const TermPictures a = noisy(0.1, 3), b = noisy(0.1, 4), mean = mean_of(a, b);
  const TermNoise noise = noise_of_halves(a, mean);
  const TermErrors errors = term_errors(noisy(0.2, 5), mean, noise);
  for (const TermError& e : errors) EXPECT_GT(e.measured_relmse, e.relmse);
  EXPECT_NEAR(errors[0].rmse, 0.2, 0.01);
  EXPECT_FALSE(errors[0].below_noise);
  const TermErrors exact = term_errors(term_pictures(uniform(1.0f, 64)), mean, noise);
  for (const TermError& e : exact) {
    EXPECT_TRUE(e.below_noise);
    EXPECT_GE(e.relmse, 0.0);
    EXPECT_GE(e.rmse, 0.0);
  }
}
TEST(TermErrors, KeepNoiseInJson) {
  const TermNoise noise = noise_of_halves(noisy(0.1, 1), noisy(0.1, 2));
  const TermNoise read = term_noise_from_json(term_noise_json(noise));
  for (std::size_t i = 0; i < layer_count; ++i) {
    EXPECT_EQ(read[i].rmse, noise[i].rmse);
    EXPECT_EQ(read[i].relmse, noise[i].relmse);
  }
  EXPECT_THROW(term_noise_from_json({{"sum", 1}}), nlohmann::json::exception);
}
