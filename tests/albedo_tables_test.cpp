#include "integrator/albedo_tables.h"

#include <gtest/gtest.h>

#include <cstring>

#include "bsdf_fixture.h"

namespace lumivec {
namespace {

Albedo look_up(const AlbedoTable& table, float cosine, float roughness) {
  return table.at(table.column_of(cosine), AlbedoTable::row_of(roughness));
}

TEST(AlbedoTables, InterpolatesTheAlbedos) {
  Random random(41);
  for (const float eta : {1.33f, 1.5f, 2.42f, 1.0f / 1.33f, 1.0f / 1.5f, 1.0f / 2.42f}) {
    const AlbedoTable& table = test_tables().nearest(eta);
    double squares = 0.0;
    constexpr int samples = 2000;
    for (int i = 0; i < samples; ++i) {
      const float roughness = delta_roughness + (1.0f - delta_roughness) * random();
      const float cosine = random();
      const Albedo a = look_up(table, cosine, roughness);
      const Albedo b = ggx_albedo(cosine, roughness * roughness, eta);
      for (const auto part :
           {&Albedo::reflected, &Albedo::reflected_exact, &Albedo::reflected_schlick,
            &Albedo::reflected_total, &Albedo::transmitted, &Albedo::transmitted_exact}) {
        EXPECT_NEAR(a.*part, b.*part, 0.1f) << eta << ' ' << cosine << ' ' << roughness;
        squares += (a.*part - b.*part) * (a.*part - b.*part);
      }
    }
    EXPECT_LT(std::sqrt(squares / (6 * samples)), 3e-3) << eta;
  }
}

TEST(AlbedoTables, AverageIsTheIntegralOfTheTable) {
  for (const float eta : {1.5f, 1.0f / 2.42f})
    for (const float roughness : {0.04f, 0.3f, 0.77f, 1.0f}) {
      const AlbedoTable& table = test_tables().nearest(eta);
      double reflected = 0.0, transmitted = 0.0;
      constexpr int n = 100000;
      for (int i = 0; i < n; ++i) {
        const float mu = (i + 0.5f) / n;
        const Albedo a = look_up(table, mu, roughness);
        reflected += 2.0 * mu * a.reflected / n;
        transmitted += 2.0 * mu * a.transmitted / n;
      }
      const Albedo average = table.average(AlbedoTable::row_of(roughness));
      EXPECT_NEAR(average.reflected, reflected, 1e-5) << eta << ' ' << roughness;
      EXPECT_NEAR(average.transmitted, transmitted, 1e-5) << eta << ' ' << roughness;
    }
}

TEST(AlbedoTables, CoatedAverageIsTheIntegralOfTheProduct) {
  const AlbedoTable& coat = test_tables().nearest(coat_index);
  for (const float eta : {1.5f, 1.0f / 1.33f})
    for (const float roughness : {0.0f, 0.3f, 0.9f})
      for (const float coat_roughness : {0.0f, 0.5f}) {
        const AlbedoTable& table = test_tables().nearest(eta);
        double reflected = 0.0;
        constexpr int n = 100000;
        for (int i = 0; i < n; ++i) {
          const float mu = (i + 0.5f) / n;
          const Albedo c = look_up(coat, mu, coat_roughness);
          reflected += 2.0 * mu / n * (0.04 * c.reflected + 0.96 * c.reflected_exact) *
                       look_up(table, mu, roughness).reflected_exact;
        }
        const CoatedAlbedo both = table.coated_average(AlbedoTable::row_of(roughness),
                                                       AlbedoTable::row_of(coat_roughness));
        EXPECT_NEAR(both.reflected_exact, reflected, 1e-4)
            << eta << ' ' << roughness << ' ' << coat_roughness;
      }
}

TEST(AlbedoTables, LossesAreDrawnByTheirDensity) {
  Random random(42);
  for (const float eta : {1.5f, 1.0f / 1.5f})
    for (const float roughness : {0.05f, 0.2f, 1.0f}) {
      const AlbedoTable& table = test_tables().nearest(eta);
      const AlbedoRow row = AlbedoTable::row_of(roughness);
      constexpr int samples = 50000;
      int below = 0;
      for (int i = 0; i < samples; ++i) {
        const float mu = table.sample_loss(random(), row);
        ASSERT_GE(mu, 0.0f);
        ASSERT_LE(mu, 1.0f);
        below += mu < 0.13f;
      }
      double all = 0.0, expected = 0.0;
      constexpr int n = 200000;
      for (int i = 0; i < n; ++i) {
        const float mu = (i + 0.5f) / n;
        const double p = 2.0 * pi * table.loss_pdf(table.column_of(mu), row) / n;
        all += p;
        if (mu < 0.13f) expected += p;
      }
      EXPECT_NEAR(all, 1.0, 2e-3);
      EXPECT_NEAR(double(below) / samples, expected, 5.0 * std::sqrt(0.25 / samples) + 2e-3)
          << eta << ' ' << roughness;
    }
}

TEST(AlbedoTables, ClampToTheirEdges) {
  const AlbedoTable& table = test_tables().nearest(1.5f);
  EXPECT_EQ(look_up(table, 1.0000001f, 0.5f).reflected, look_up(table, 1.0f, 0.5f).reflected);
  EXPECT_EQ(look_up(table, 0.5f, 2.0f).reflected, look_up(table, 0.5f, 1.0f).reflected);
  EXPECT_EQ(look_up(table, 0.5f, 0.029f).reflected, 1.0f);
}

TEST(AlbedoTables, UnknownIndexFallsBackToTheNearest) {
  const std::vector<float> indices = {1.33f, 2.42f};
  const AlbedoTables tables(indices);
  EXPECT_EQ(tables.nearest(1.33f).eta(), 1.33f);
  EXPECT_EQ(tables.nearest(1.0f / 1.33f).eta(), 1.0f / 1.33f);
  EXPECT_EQ(tables.nearest(2.3f).eta(), 2.42f);
  EXPECT_EQ(tables.nearest(0.1f).eta(), 1.0f / 2.42f);
  EXPECT_EQ(tables.nearest(100.0f).eta(), 2.42f);
  EXPECT_EQ(tables.nearest(coat_index).eta(), coat_index);
  tables.nearest(0.0f);
}

TEST(AlbedoTables, BoundariesBetweenTwoMediaAreKnown) {
  const std::vector<float> indices = {1.33f, 2.42f};
  const AlbedoTables tables(indices);
  EXPECT_EQ(tables.nearest(1.33f / 2.42f).eta(), 1.33f / 2.42f);
  EXPECT_EQ(tables.nearest(2.42f / 1.33f).eta(), 2.42f / 1.33f);
}

TEST(AlbedoTables, OddIndicesAreIgnored) {
  const std::vector<float> indices = {0.0f,
                                      0.0f,
                                      -1.0f,
                                      std::numeric_limits<float>::infinity(),
                                      std::numeric_limits<float>::quiet_NaN(),
                                      1.5f};
  const AlbedoTables tables(indices);
  EXPECT_EQ(tables.nearest(1.4f).eta(), 1.5f);
  EXPECT_EQ(AlbedoTables({}).nearest(3.0f).eta(), coat_index);
}

TEST(AlbedoTables, AreTheSameEveryTime) {
  const std::vector<float> indices = {1.4f};
  const AlbedoTables first(indices), second(indices);
  for (float mu = 0.0f; mu < 1.0f; mu += 0.1f) {
    const Albedo a = look_up(first.nearest(1.4f), mu, 0.3f);
    const Albedo b = look_up(second.nearest(1.4f), mu, 0.3f);
    EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
  }
}

}  // namespace
}  // namespace lumivec
