#include "integrator/ggx.h"

#include <gtest/gtest.h>

#include <array>

#include "bsdf_fixture.h"
#include "integrator/ggx_albedo.h"

namespace lumivec {
namespace {

constexpr std::array<float, 5> alphas = {9e-4f, 0.01f, 0.09f, 0.36f, 1.0f};

// Midpoints over the hemisphere in the variable in which GGX is flat: tan²θ / (α² + tan²θ) is its
// cumulative distribution.
template <typename F>
double integrate_facets(float alpha, const F& f) {
  constexpr int n = 400;
  double sum = 0.0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const double t = (i + 0.5) / n;
      const double u =
          1.0 - (1.0 - t) * (1.0 - t);  // tames what goes as 1 / cosθ towards the horizon
      const double tan2 = double(alpha) * alpha * u / (1.0 - u);
      const double cosine = 1.0 / std::sqrt(1.0 + tan2);
      const double sine = std::sqrt(tan2) * cosine;
      const double phi = 2.0 * std::numbers::pi * (k + 0.5) / n;
      const V3f h(float(sine * std::cos(phi)), float(sine * std::sin(phi)), float(cosine));
      const double density = cosine * (1.0 / (std::numbers::pi * alpha * alpha)) /
                             (std::pow(cosine, 4.0) * std::pow(1.0 + tan2 / alpha / alpha, 2.0));
      sum += f(h) / density * 2.0 * (1.0 - t);
    }
  return sum / (double(n) * n);
}

TEST(Ggx, FacetsCoverTheSurface) {
  for (const float alpha : alphas)
    EXPECT_NEAR(integrate_facets(alpha, [&](const V3f& h) { return ggx_density(h, alpha) * h.z; }),
                1.0, 1e-4)
        << alpha;
}

// Masking is right if what wo sees of all facets is what it sees of the surface.
TEST(Ggx, VisibleFacetsProjectToTheSurface) {
  for (const float alpha : alphas)
    for (const float cosine : {0.05f, 0.5f, 1.0f}) {
      const V3f wo = at_cosine(cosine);
      const float root = smith_root(cosine, alpha);
      const double seen = integrate_facets(alpha, [&](const V3f& h) {
        return std::max(0.0f, visible_normal_pdf(wo.dot(h), ggx_density(h, alpha), cosine, root));
      });
      EXPECT_NEAR(seen, 1.0, 2e-3) << alpha << ' ' << cosine;
    }
}

TEST(Ggx, SharpPeakIsExactInSinglePrecision) {
  const float alpha = 9e-4f;
  EXPECT_NEAR(ggx_density(up, alpha) * pi * alpha * alpha, 1.0f, 1e-6f);
  // tanθ = α: a quarter of the peak.
  const V3f h = V3f(alpha, 0.0f, 1.0f).normalized();
  EXPECT_NEAR(ggx_density(h, alpha) * pi * alpha * alpha, 0.25f, 1e-5f);
}

TEST(Ggx, MaskingRunsFromZeroToOne) {
  for (const float alpha : alphas) {
    EXPECT_FLOAT_EQ(smith_g1(1.0f, smith_root(1.0f, alpha)), 1.0f);
    EXPECT_EQ(smith_g1(0.0f, smith_root(0.0f, alpha)), 0.0f);
    float before = 0.0f;
    for (float c = 0.05f; c <= 1.0f; c += 0.05f) {
      const float g1 = smith_g1(c, smith_root(c, alpha));
      EXPECT_GE(g1, before);
      const float g2 =
          smith_g2_over_cosines(c, smith_root(c, alpha), 0.5f, smith_root(0.5f, alpha)) * c * 0.5f;
      EXPECT_LE(g2, std::min(g1, smith_g1(0.5f, smith_root(0.5f, alpha))) * 1.000001f);
      EXPECT_GE(g2, g1 * smith_g1(0.5f, smith_root(0.5f, alpha)) * 0.999999f);
      before = g1;
    }
  }
}

// The mean of a few functions over the drawn normals is their integral over the density.
TEST(Ggx, VisibleNormalsAreDrawnByTheirDensity) {
  Random random(31);
  for (const float alpha : alphas)
    for (const float cosine : {0.02f, 0.3f, 0.9f, 1.0f}) {
      const V3f wo = at_cosine(cosine);
      const float root = smith_root(cosine, alpha);
      const std::array<double (*)(const V3f&, float), 4> functions = {
          [](const V3f& h, float) { return double(h.z); },
          [](const V3f& h, float a) { return double(std::tanh(h.x / a)); },
          [](const V3f& h, float a) { return double(std::tanh(h.y / a)); },
          [](const V3f& h, float a) { return h.x * h.x + h.y * h.y > a * a ? 1.0 : 0.0; }};
      for (const auto& f : functions) {
        constexpr int samples = 20000;
        double sum = 0.0, squares = 0.0;
        for (int i = 0; i < samples; ++i) {
          const double value = f(sample_visible_normal(wo, alpha, random.pair()), alpha);
          sum += value;
          squares += value * value;
        }
        const double mean = sum / samples;
        const double error = std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples);
        const double expected = integrate_facets(alpha, [&](const V3f& h) {
          return f(h, alpha) *
                 std::max(0.0f, visible_normal_pdf(wo.dot(h), ggx_density(h, alpha), cosine, root));
        });
        EXPECT_NEAR(mean, expected, 5.0 * error + 3e-3) << alpha << ' ' << cosine;
      }
    }
}

TEST(Ggx, VisibleNormalsAreSeen) {
  Random random(32);
  for (const float alpha : alphas)
    for (const float cosine : {1e-4f, 1e-2f, 1.0f})
      for (int i = 0; i < 1000; ++i) {
        const V3f wo = at_cosine(cosine);
        const V3f h = sample_visible_normal(wo, alpha, random.pair());
        EXPECT_NEAR(h.length(), 1.0f, 1e-5f);
        EXPECT_GT(h.z, 0.0f);
        EXPECT_GT(wo.dot(h), -1e-6f);
      }
}

TEST(Ggx, ReflectionAndRefractionOnTheFlatSurface) {
  const V3f wo(0.6f, 0.0f, 0.8f);
  EXPECT_NEAR((reflect(wo, up) - V3f(-0.6f, 0.0f, 0.8f)).length(), 0.0f, 1e-6f);
  const V3f in = refract(wo, up, 1.5f, std::sqrt(1.0f - 0.16f));
  EXPECT_NEAR((in - V3f(-0.4f, 0.0f, -std::sqrt(1.0f - 0.16f))).length(), 0.0f, 1e-6f);
}

// Against an estimate from random samples of the same integral.
TEST(GgxAlbedo, AgreesWithRandomSampling) {
  Random random(33);
  for (const float eta : {1.5f, 1.0f / 1.5f, 2.42f})
    for (const float alpha : {0.01f, 0.09f, 1.0f})
      for (const float cosine : {0.1f, 0.4f, 0.77f, 1.0f}) {
        constexpr int samples = 40000;
        const V3f wo = at_cosine(cosine);
        const float root = smith_root(cosine, alpha);
        std::array<double, 6> sums{};
        for (int i = 0; i < samples; ++i) {
          const V2f u((i + random()) / samples, random());
          const V3f h = sample_visible_normal(wo, alpha, u);
          const FresnelShape shape = fresnel_shape(std::min(1.0f, wo.dot(h)), eta);
          const V3f r = reflect(wo, h);
          if (r.z > 0.0f) {
            const float g1 = smith_g1(cosine, root);
            const double w = smith_g2_over_cosines(cosine, root, r.z, smith_root(r.z, alpha)) *
                             cosine * r.z / g1;
            sums[0] += w;
            sums[1] += w * shape.exact;
            sums[2] += w * shape.schlick;
            sums[3] += w * shape.total;
          }
          if (shape.total > 0.0f) continue;
          const V3f t = refract(wo, h, eta, shape.cos_transmitted);
          if (t.z >= 0.0f) continue;
          const double w = smith_g1(-t.z, smith_root(t.z, alpha));
          sums[4] += w;
          sums[5] += w * shape.exact;
        }
        const Albedo a = ggx_albedo(cosine, alpha, eta);
        const std::array<float, 6> values = {a.reflected,         a.reflected_exact,
                                             a.reflected_schlick, a.reflected_total,
                                             a.transmitted,       a.transmitted_exact};
        for (std::size_t i = 0; i < values.size(); ++i)
          EXPECT_NEAR(values[i], sums[i] / samples, 0.012)
              << "eta " << eta << " alpha " << alpha << " cosine " << cosine << " part " << i;
      }
}

TEST(GgxAlbedo, SmoothBoundaryIsFresnels) {
  const Albedo a = ggx_albedo(0.6f, 0.0f, 1.5f);
  EXPECT_EQ(a.reflected, 1.0f);
  EXPECT_EQ(a.transmitted, 1.0f);
  EXPECT_NEAR(0.04f + 0.96f * a.reflected_exact, fresnel_dielectric(0.6f, 1.5f).reflectance, 1e-6f);
  EXPECT_EQ(ggx_albedo(0.3f, 0.0f, 1.0f / 1.5f).reflected_total, 1.0f);
  EXPECT_EQ(ggx_albedo(0.3f, 0.0f, 1.0f / 1.5f).transmitted, 0.0f);
}

}  // namespace
}  // namespace lumivec
