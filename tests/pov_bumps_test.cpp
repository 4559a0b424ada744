// Normals of POV-Ray's textures, against what its own pictures of a lit plane show.
#include <gtest/gtest.h>

#include <cmath>

#include "integrator/render.h"
#include "tests/pov_file.h"

namespace {

using lumivec::Scene;
using lumivec::V3d;

struct Bent {
  Scene scene;
  // How far a floor's normal leans against x, as a slope, at a point of the file's coordinates,
  // whose z is the other way round.
  double lean(const V3d& point) const {
    const V3d n = scene.patterns.at(0)->bent(V3d(point.x, point.y, -point.z), V3d(0, 1, 0));
    EXPECT_NEAR(n.length(), 1.0, 1e-12);
    return -n.x / n.y;
  }
};

Bent bent(const std::string& normal, const std::string& after = "") {
  PovFile file("plane { y, 0 pigment { rgb 1 } normal { " + normal + " } " + after + " }");
  Bent result{file.load()};
  EXPECT_FALSE(file.warns("bumps")) << normal;
  return result;
}

const V3d place(0.3, 0.0, 0.4);
constexpr double slope = 2.0 / 15.0;  // 0.1333 on POV-Ray's pictures

TEST(pov_bumps, slopes_count_in_the_patterns_own_units) {
  EXPECT_NEAR(bent("gradient x, 1").lean(place), slope, 1e-9);
  EXPECT_NEAR(bent("gradient x").lean(place), 0.5 * slope, 1e-9);
  EXPECT_NEAR(bent("gradient x bump_size 1").lean(place), slope, 1e-9);
  EXPECT_NEAR(bent("gradient x, -0.5").lean(place), -0.5 * slope, 1e-9);
  EXPECT_NEAR(bent("gradient z, 1").lean(place), 0.0, 1e-9);
  EXPECT_NEAR(bent("gradient x, 1 accuracy 0.1").lean(place), slope, 1e-9);
  // Whatever the scale, if it is even.
  EXPECT_NEAR(bent("gradient x, 1 scale 2").lean(place), slope, 1e-9);
  EXPECT_NEAR(bent("gradient x, 1 scale 2 no_bump_scale").lean(place), slope / 2.0, 1e-9);
  EXPECT_NEAR(bent("gradient x, 1 scale <2, 1, 1>").lean(place), slope / 2.0, 1e-9);
  EXPECT_NEAR(bent("gradient x, 1 scale <1, 2, 1>").lean(place), slope * 2.0, 1e-9);
  EXPECT_NEAR(bent("gradient x, 1 rotate 90*y").lean(place), 0.0, 1e-9);
  EXPECT_NEAR(bent("gradient x, 1", "rotate 180*y").lean(place), -slope, 1e-9);
  EXPECT_NEAR(bent("gradient x, 1 frequency 2").lean({0.2, 0, 0}), 2.0 * slope, 1e-9);
}

TEST(pov_bumps, waves_and_slope_maps_shape_them) {
  const Bent smooth = bent("gradient x, 1 slope_map { [0 <0, 0>] [1 <1, 0>] }");
  EXPECT_NEAR(smooth.lean(place), slope * 6.0 * 0.3 * 0.7, 1e-3 * slope);
  const Bent straight = bent("gradient x, 1 slope_map { [0 <0, 1>] [1 <1, 1>] }");
  EXPECT_NEAR(straight.lean(place), slope, 1e-9);
  const Bent folded = bent("gradient x, 1 triangle_wave");
  EXPECT_NEAR(folded.lean({0.3, 0, 0}), 2.0 * slope, 1e-9);
  EXPECT_NEAR(folded.lean({0.7, 0, 0}), -2.0 * slope, 1e-9);
}

TEST(pov_bumps, normals_are_mixed_and_chosen) {
  const Bent mixed = bent("gradient x normal_map { [0 gradient x, 1] [1 gradient z, 1] }");
  EXPECT_NEAR(mixed.lean(place), 0.7 * slope, 0.01 * slope);
  const Bent chosen = bent("checker normal { gradient x, 1 } normal { gradient z, 1 }");
  EXPECT_NEAR(chosen.lean({0.3, 1e-3, 0.4}), slope, 1e-9);
  EXPECT_NEAR(chosen.lean({1.3, 1e-3, 0.4}), 0.0, 1e-9);
  const Bent even = bent("average normal_map { [1 gradient x, 1] [1 gradient z, 1] }");
  EXPECT_NEAR(even.lean(place), slope / 2.0, 1e-9);
}

// With its usual controls a cushion's height is the distance from its middle, t: here the formula
// that POV-Ray's pictures follow to 0.008 of white.
TEST(pov_bumps, quilts_are_cushions) {
  const Bent quilt = bent("quilted 1 control0 0 control1 0");
  const V3d off(0.3 - 0.5, -0.5, 0.4 - 0.5);
  const double t = off.length(), k = 2.0 / std::sqrt(3.0) * t * t * t;
  EXPECT_NEAR(quilt.lean(place), -off.x * k / (1.0 + off.y * k), 1e-9);
}

// Patterns of noise have POV-Ray's strength: the spread of the lean, over a floor, is that of its
// pictures of 25 x 25 units, to a third: its table of gradients is another.
TEST(pov_bumps, noise_is_as_strong_as_it_should_be) {
  const auto spread = [](const std::string& normal) {
    const Bent b = bent(normal);
    double sum = 0.0, squares = 0.0;
    constexpr int n = 60;
    for (int i = 0; i < n * n; ++i) {
      const double lean = b.lean(V3d(i % n * 0.417, 0.0, i / n * 0.417));
      sum += lean;
      squares += lean * lean;
    }
    return std::sqrt(squares / (n * n) - sum * sum / (n * n) / (n * n));
  };
  EXPECT_NEAR(spread("bumps 0.5"), 0.147, 0.04);
  EXPECT_NEAR(spread("dents 0.5"), 0.0325, 0.01);
  EXPECT_NEAR(spread("bozo 0.5"), 0.02, 0.006);
}

// A texture says it of its layers; what it says of no direction leaves the normal alone.
TEST(pov_bumps, textures_of_textures_have_theirs) {
  PovFile file(
      "plane { y, 0 texture { gradient z texture_map { [0.5 pigment { rgb 1 } normal { gradient x, "
      "1 }] [0.5 pigment { rgb 1 }] } } }");
  const Bent half{file.load()};
  EXPECT_NEAR(half.lean({0.3, 0.0, 0.2}), slope, 1e-9);
  EXPECT_NEAR(half.lean({0.3, 0.0, 0.8}), 0.0, 1e-9);
}

TEST(pov_bumps, what_is_not_followed_is_said) {
  PovFile file("plane { y, 0 pigment { rgb 1 } normal { facets 1 } }");
  const Bent flat{file.load()};
  EXPECT_TRUE(file.warns("bumps"));
  EXPECT_NEAR(flat.lean(place), 0.0, 1e-12);
}

// A sun low over a bumpy floor: the light is what the leaning normal catches.
TEST(pov_bumps, are_seen_in_the_light) {
  PovFile file(
      "global_settings { assumed_gamma 1 } camera { orthographic location <0.4, 5, 0.4> right "
      "0.1*x up 0.1*y sky z look_at <0.4, 0, 0.4> } light_source { <1000, 1000, 0> rgb 1 parallel "
      "point_at 0 } plane { y, 0 pigment { rgb 1 } finish { ambient 0 diffuse 1 } normal { "
      "gradient x, 1 } }");
  const Scene scene = file.load();
  lumivec::RenderSettings settings;
  settings.width = settings.height = 4;
  settings.samples = 4;
  lumivec::RenderStatistics statistics;
  const lumivec::Framebuffer picture =
      lumivec::render(scene, scene.cameras.at(0), settings, statistics);
  // POV-Ray: 0.607.
  const double expected = (1.0 - slope) / std::sqrt(2.0 * (1.0 + slope * slope));
  EXPECT_NEAR(double(picture.terms[std::size_t(lumivec::Term::direct)][0].x), expected, 2e-3);
}

}  // namespace
