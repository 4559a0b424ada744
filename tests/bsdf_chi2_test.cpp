// sample() draws directions with the density that eval() states: χ² tests of every lobe, kind and
// combination.
#include <gtest/gtest.h>

#include <array>

#include "bsdf_fixture.h"

namespace lumivec {
namespace {

// Density of a direction around a frame's axis whose 1 − cos is logarithmically uniform from about
// width to 2, so that a mirror-like peak and the rest of the sphere both get some.
class LogPeak {
 public:
  LogPeak(const V3f& axis, float width) : frame_(make_frame(axis)), width_(width) {}

  V3f sample(Random& random) const {
    const float x = width_ * std::expm1(random() * std::log1p(2.0f / width_));
    const float r = std::sqrt(std::max(0.0f, x * (2.0f - x)));
    const float phi = 2.0f * pi * random();
    return frame_.to_world({r * std::cos(phi), r * std::sin(phi), 1.0f - x}).normalized();
  }
  float density(const V3f& w) const {
    return 1.0f / ((versed(frame_.to_local(w)) + width_) * std::log1p(2.0f / width_) * 2.0f * pi);
  }
  // Which of so many rings of equal probability, and which of so many sectors, w is in.
  int bin(const V3f& w, int rings, int sectors) const {
    const V3f v = frame_.to_local(w);
    const float place = std::log1p(versed(v) / width_) / std::log1p(2.0f / width_);
    const float turn = std::atan2(v.y, v.x) / (2.0f * pi) + 0.5f;
    return std::min(rings - 1, static_cast<int>(place * rings)) * sectors +
           std::min(sectors - 1, static_cast<int>(turn * sectors));
  }

 private:
  // 1 − z without cancellation.
  static float versed(const V3f& v) {
    return v.z > 0.0f ? (v.x * v.x + v.y * v.y) / (1.0f + v.z) : 1.0f - v.z;
  }

  Frame frame_;
  float width_;
};

// Bins around the directions where a surface's lobes peak, above and below it, and a density that
// finds all lobes: uniform, mirrored at facets around the normal (above, and turned to below), and
// around the refracted direction.
class PeakBins {
 public:
  static constexpr int rings = 12;
  static constexpr int sectors = 8;
  static constexpr int count = 2 * rings * sectors;

  PeakBins(const V3f& wo, const V3f& through, float width)
      : wo_(wo), facets_(up, width), above_({-wo.x, -wo.y, wo.z}, width), below_(through, width) {}

  std::size_t index(const V3f& w) const {
    return w.z > 0.0f ? above_.bin(w, rings, sectors)
                      : rings * sectors + below_.bin(w, rings, sectors);
  }

  V3f propose(Random& random) const {
    const float u = random();
    if (u < 0.4f) return random.direction();
    if (u < 0.6f) return below_.sample(random);
    const V3f h = facets_.sample(random);
    const V3f w = 2.0f * wo_.dot(h) * h - wo_;
    return u < 0.8f ? w : V3f(w.x, w.y, -w.z);
  }
  float density(const V3f& w) const {
    return 0.4f / (4.0f * pi) + 0.2f * below_.density(w) +
           0.2f * (mirrored_density(w) + mirrored_density({w.x, w.y, -w.z}));
  }

 private:
  float mirrored_density(const V3f& w) const {
    const V3f h = (wo_ + w).normalized();
    const float cosine = wo_.dot(h);
    return cosine > 0.0f ? (facets_.density(h) + facets_.density(-h)) / (4.0f * cosine) : 0.0f;
  }

  V3f wo_;
  LogPeak facets_, above_, below_;
};

// Probability that a χ² variable of so many degrees of freedom is larger: Wilson and Hilferty's
// cube root is normal.
double chi2_tail(double chi2, int freedom) {
  const double v = 2.0 / (9.0 * freedom);
  const double z = (std::cbrt(chi2 / freedom) - (1.0 - v)) / std::sqrt(v);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

struct Bin {
  double observed = 0.0;
  double expected = 0.0;
  double squares = 0.0;  // of the terms of expected, for its variance
  double largest = 0.0;  // of them

  void add(const Bin& b) {
    observed += b.observed;
    expected += b.expected;
    squares += b.squares;
    largest = std::max(largest, b.largest);
  }
  // Whether counts are about normal, and no single term decides what is expected.
  bool reliable() const { return expected >= 20.0 && largest < 0.1 * expected; }
};

V3f refracted(const SurfaceParameters& p, const V3f& wo) {
  if (p.thin_walled || p.eta == 0.0f) return -wo;
  const V3f bent(-wo.x / p.eta, -wo.y / p.eta, 0.0f);
  return V3f(bent.x, bent.y, -std::sqrt(std::max(0.0f, 1.0f - bent.length2()))).normalized();
}

// Least probability, over both kinds, that the samples of this surface come from its densities: of
// the counts in bins, and of their sum. Expected counts are Monte Carlo estimates too, from several
// proposals a sample; their variance is added.
double least_probability(const SurfaceParameters& p, const V3f& wo, Random& random, int samples) {
  constexpr int proposals = 3;
  const Bsdf bsdf = make_bsdf(p, wo);
  const auto sharpness = [](float roughness) {
    return roughness < delta_roughness ? 1.0f : roughness;
  };
  const float sharpest = std::min(sharpness(p.roughness),
                                  p.clearcoat > 0.0f ? sharpness(p.clearcoat_roughness) : 1.0f);
  const PeakBins bins(wo, refracted(p, wo), 0.1f * std::pow(sharpest, 4.0f));

  std::array<std::vector<Bin>, lobe_kind_count> kinds;
  for (auto& kind : kinds) kind.resize(PeakBins::count);
  for (int i = 0; i < samples; ++i) {
    BsdfSample s;
    if (bsdf.sample(random(), random.pair(), s) && !s.delta)
      kinds[static_cast<std::size_t>(s.kind)][bins.index(s.wi)].observed += 1.0;
    for (int k = 0; k < proposals; ++k) {
      const V3f w = bins.propose(random);
      const BsdfValue v = bsdf.eval(w);
      const double scale = 1.0 / (double(proposals) * bins.density(w));
      // sample() returns no direction that carries no light.
      const std::size_t bin = bins.index(w);
      for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        const double d = v.f_cos[kind] == Color(0.0f) ? 0.0 : v.pdf[kind] * scale;
        kinds[kind][bin].add({0.0, d, d * d, d});
      }
    }
  }
  double least = 1.0;
  for (const auto& kind : kinds) {
    Bin rest, all;
    double chi2 = 0.0;
    int freedom = 0;
    const auto count = [&](const Bin& bin) {
      const double difference = bin.observed - bin.expected;
      chi2 += difference * difference / (bin.expected + bin.squares);
      ++freedom;
    };
    for (const Bin& bin : kind) {
      all.add(bin);
      if (bin.reliable()) {
        count(bin);
        continue;
      }
      rest.add(bin);
      if (rest.reliable()) {
        count(rest);
        rest = Bin();
      }
    }
    if (all.observed > 10.0 && all.expected < 1e-3)
      return 0.0;  // samples where there is no density
    if (freedom > 0) least = std::min(least, chi2_tail(chi2, freedom));
    const double share = std::min(1.0, all.expected / samples);
    const double variance = samples * share * (1.0 - share) + all.squares -
                            all.expected * all.expected / (double(samples) * proposals);
    const double difference = all.observed - all.expected;
    if (all.reliable()) least = std::min(least, chi2_tail(difference * difference / variance, 1));
  }
  return least;
}

// With Šidák's correction: one in a thousand runs of the whole would fail if all were right (the
// seed is fixed).
void expect_agreement(const std::vector<NamedSurface>& surfaces, const std::vector<float>& cosines,
                      unsigned seed, int samples) {
  const double tests = 4.0 * static_cast<double>(surfaces.size() * cosines.size());
  const double threshold = 1.0 - std::pow(1.0 - 1e-3, 1.0 / tests);
  Random random(seed);
  for (const NamedSurface& s : surfaces)
    for (const float cosine : cosines)
      EXPECT_GT(least_probability(s.surface, at_cosine(cosine), random, samples), threshold)
          << s.name << ", cosine " << cosine;
}

TEST(BsdfChi2, UncoatedSurfaces) {
  std::vector<NamedSurface> all;
  for (const float roughness : {0.0f, 0.035f, 0.2f, 0.7f})
    for (const NamedSurface& s : white_surfaces(roughness)) all.push_back(s);
  expect_agreement(all, {0.1f, 0.78f}, 7, 40000);
}

TEST(BsdfChi2, CoatedSurfaces) {
  std::vector<NamedSurface> all;
  for (const auto& [roughness, coat_roughness] :
       {std::pair(0.1f, 0.0f), {0.5f, 0.1f}, {0.12f, 0.6f}})
    for (const NamedSurface& s : coated_surfaces(roughness, coat_roughness, 0.7f)) all.push_back(s);
  expect_agreement(all, {0.5f}, 8, 40000);
}

TEST(BsdfChi2, BentNormals) {
  Random random(9);
  std::vector<NamedSurface> all;
  for (const NamedSurface& s : coated_surfaces(0.4f, 0.3f)) {
    all.push_back(s);
    all.back().surface.normal = (up + 0.5f * random.direction()).normalized();
    all.back().surface.coat_normal = (up + 0.5f * random.direction()).normalized();
  }
  expect_agreement(all, {0.3f}, 10, 40000);
}

TEST(BsdfChi2, NormalAndGrazingViews) {
  expect_agreement(white_surfaces(0.3f), {0.01f, 1.0f}, 12, 40000);
}

// Discrete probabilities are what the samples' pdf says they are.
TEST(BsdfChi2, DeltaLobesAreChosenAsOftenAsTheySay) {
  Random random(11);
  std::vector<NamedSurface> all = white_surfaces(0.0f);
  for (const float roughness : {0.0f, 0.3f})
    for (const NamedSurface& s : coated_surfaces(roughness, 0.0f)) all.push_back(s);
  constexpr int samples = 20000;
  for (const NamedSurface& s : all) {
    const Bsdf bsdf = make_bsdf(s.surface, at_cosine(0.6f));
    struct Group {
      V3f wi;
      float pdf;
      int count;
    };
    std::vector<Group> groups;
    for (int i = 0; i < samples; ++i) {
      BsdfSample sample;
      if (!bsdf.sample(random(), random.pair(), sample) || !sample.delta) continue;
      EXPECT_EQ(sample.kind, LobeKind::specular);
      const auto same = [&](const Group& g) { return g.pdf == sample.pdf && g.wi == sample.wi; };
      const auto found = std::find_if(groups.begin(), groups.end(), same);
      if (found == groups.end()) {
        groups.push_back({sample.wi, sample.pdf, 1});
      } else {
        ++found->count;
      }
    }
    ASSERT_LE(groups.size(), 3u) << s.name;
    for (const Group& g : groups)
      EXPECT_NEAR(g.count, samples * g.pdf, 5.0 * std::sqrt(samples * g.pdf * (1.0 - g.pdf)) + 1.0)
          << s.name;
  }
}

TEST(BsdfChi2, TailIsThatOfChi2) {
  EXPECT_NEAR(chi2_tail(18.307, 10), 0.05, 1e-3);
  EXPECT_NEAR(chi2_tail(149.449, 100), 0.001, 1e-4);
}

}  // namespace
}  // namespace lumivec
