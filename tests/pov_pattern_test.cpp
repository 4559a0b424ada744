// Patterns of POV-Ray's pigments where rays hit them. All scenes are convex and stand in an even
// sky of radiance 1, so that what the eye sees of a diffuse surface is its reflectance.
#include <array>
#include <cmath>

#include "integrator/render.h"
#include "loader/pov/pattern_values.h"
#include "tests/png_bytes.h"
#include "tests/pov_file.h"

namespace {

using lumivec::Color;
using lumivec::Framebuffer;
using lumivec::Scene;
using lumivec::V3d;
using lumivec::pov::K;

constexpr int pixels = 32;  // along both edges of what is seen: 8 units, so that 4 are a unit

const std::string around =
    "global_settings { assumed_gamma 1 } background { rgb 1 } #default { finish { diffuse 1 "
    "ambient 0 } } camera { orthographic location <0, 0, -10> look_at 0 right 8*x up 8*y } ";

Framebuffer see(const Scene& scene) {
  lumivec::RenderSettings settings;
  settings.width = settings.height = pixels;
  settings.samples = 16;
  lumivec::RenderStatistics statistics;
  return render(scene, scene.cameras.at(0), settings, statistics);
}

Framebuffer see(const std::string& items) {
  PovFile file(around + items);
  const Framebuffer picture = see(file.load());
  EXPECT_FALSE(file.warns("average color")) << items;
  return picture;
}

// At a place of the plane z = 0.
Color at(const Framebuffer& picture, double x, double y) {
  const int column = static_cast<int>((x + 4.0) / 8.0 * pixels);
  const int row = static_cast<int>((4.0 - y) / 8.0 * pixels);
  return picture.beauty(std::size_t(row) * pixels + std::size_t(column));
}

void expect_color(const Color& seen, const Color& wanted, const char* what) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(seen[i], wanted[i], 0.03) << what << ' ' << i;
}

const Color red(0.8f, 0.1f, 0.1f), green(0.1f, 0.8f, 0.1f);
const std::string checker = "checker rgb <0.8, 0.1, 0.1> rgb <0.1, 0.8, 0.1>";

TEST(PovPattern, ACheckerOnAFaceBetweenCellsHasBothColorsInTheirPlaces) {
  const Framebuffer picture = see("plane { -z, 0 pigment { " + checker + " } }");
  for (int x = -3; x < 3; ++x) {
    for (int y = -3; y < 3; ++y)
      expect_color(at(picture, x + 0.6, y + 0.6), (x + y) % 2 == 0 ? red : green, "cell");
  }
}

TEST(PovPattern, TransformsOfAPatternAndOfItsObjectMoveIt) {
  const Framebuffer scaled =
      see("plane { -z, 0 pigment { " + checker + " scale 2 translate <1, 0, 0> } }");
  expect_color(at(scaled, 1.6, 0.6), red, "1..3");
  expect_color(at(scaled, 2.6, 1.6), red, "1..3");
  expect_color(at(scaled, 0.4, 0.6), green, "-1..1");
  // What moves the object after its texture moves both; what moves it before, only the object.
  const std::string box = "box { <-3, -3, 0>, <3, 3, 1> ";
  const Framebuffer with = see(box + "pigment { " + checker + " } translate x }");
  expect_color(at(with, 1.6, 0.6), red, "moved along");
  const Framebuffer without = see(box + "translate x pigment { " + checker + " } }");
  expect_color(at(without, 1.6, 0.6), green, "stays");
}

TEST(PovPattern, InstancesCarryTheirPatternAlong) {
  const Framebuffer picture =
      see("#declare Tile = box { <0, 0, 0>, <2, 2, 1> pigment { " + checker +
          " } } object { Tile translate <-3, 0, 0> } object { Tile translate <0, -2, 0> }");
  expect_color(at(picture, -2.4, 0.6), red, "first cell of the first");
  expect_color(at(picture, -1.4, 0.6), green, "second cell of the first");
  expect_color(at(picture, 0.6, -1.4), red, "first cell of the second");
  expect_color(at(picture, 1.6, -1.4), green, "second cell of the second");
}

TEST(PovPattern, AnExactSphereShowsItsPattern) {
  const std::string sphere =
      "sphere { 0, 1 pigment { gradient x color_map { [0.5 rgb <0.8, 0.1, 0.1>] "
      "[0.5 rgb <0.1, 0.8, 0.1>] } translate -0.5*x scale 8 } scale 3 ";
  PovFile file(around + sphere + "}");
  EXPECT_EQ(file.load().spheres.size(), 1u);
  const Framebuffer picture = see(sphere + "}");
  expect_color(at(picture, -1.1, 0.4), red, "left");
  expect_color(at(picture, 1.1, 0.4), green, "right");
  const Framebuffer turned = see(sphere + "rotate 180*z }");
  expect_color(at(turned, -1.1, 0.4), green, "left, turned");
  expect_color(at(turned, 1.1, 0.4), red, "right, turned");
  const Framebuffer ellipsoid = see(sphere + "scale <1, 0.5, 1> }");
  expect_color(at(ellipsoid, -1.1, 0.4), red, "left, squeezed");
  expect_color(at(ellipsoid, 1.1, 0.4), green, "right, squeezed");
}

// Two by two pixels: red and green above, grey and nothing below.
std::string quarters() {
  return PngBytes(2, 2, 8, 6,
                  {{231, 89, 89, 255, 89, 231, 89, 255}, {188, 188, 188, 255, 0, 0, 0, 0}})
      .file;
}
// What these bytes mean (IEC 61966-2-1).
const Color grey(0.503f);

TEST(PovPattern, APictureLiesInTheUnitSquareAndIsRepeated) {
  PovFile file(around +
               "plane { -z, 0 pigment { image_map { png \"p.png\" } scale 2 } } "
               "plane { -z, -1 pigment { rgb 0 } }");
  file.write("p.png", quarters());
  const Framebuffer picture = see(file.load());
  EXPECT_FALSE(file.warns("average color"));
  for (const double x : {-4.0, 0.0, 2.0}) {
    expect_color(at(picture, x + 0.6, 1.6), red, "upper left");
    expect_color(at(picture, x + 1.6, 1.6), green, "upper right");
    expect_color(at(picture, x + 0.6, 0.6), grey, "lower left");
    expect_color(at(picture, x + 1.6, 0.6), Color(0.0f), "what is behind the clear quarter");
    expect_color(at(picture, x + 0.6, -0.4), red, "below, upper left");
  }
}

TEST(PovPattern, PicturesAreShownOnceAndBlendedWhereAsked) {
  PovFile once(around +
               "plane { -z, 0 pigment { image_map { png \"p.png\" once } scale 2 } } "
               "plane { -z, -1 pigment { rgb 0 } }");
  once.write("p.png", quarters());
  const Framebuffer picture = see(once.load());
  expect_color(at(picture, 0.6, 1.6), red, "inside");
  expect_color(at(picture, 2.6, 1.6), Color(0.0f), "outside");
  PovFile blended(around +
                  "plane { -z, 0 pigment { image_map { png \"p.png\" interpolate 2 } scale 8 } }");
  blended.write("p.png", PngBytes(2, 1, 8, 0, {{0, 188}}).file);
  const Framebuffer smooth = see(blended.load());
  expect_color(at(smooth, 2.1, 0.1), Color(0.0f), "middle of the black pixel");
  expect_color(at(smooth, 3.9, 0.1), Color(0.5f * 0.503f), "half way");
}

TEST(PovPattern, APictureGoesAroundASphereFromXTowardZ) {
  PovFile file(around +
               "sphere { 0, 1 pigment { image_map { png \"p.png\" map_type 1 } } scale 3 }");
  file.write("p.png", PngBytes(4, 1, 8, 0, {{0, 89, 188, 231}}).file);
  const Framebuffer picture = see(file.load());
  EXPECT_FALSE(file.warns("average color"));
  // The eye looks along z: it sees the third and the fourth quarter of the turn.
  expect_color(at(picture, -1.1, 0.4), grey, "left");
  expect_color(at(picture, 1.1, 0.4), Color(0.8f), "right");
}

TEST(PovPattern, APicturesNumbersAreLightByItsGammaAndTheScenes) {
  const std::string scene =
      "background { rgb 1 } #default { finish { diffuse 1 ambient 0 } } camera { orthographic "
      "location <0, 0, -10> look_at 0 right 8*x up 8*y } plane { -z, 0 pigment { image_map { png "
      "\"p.png\" gamma 2 } } }";
  for (const char* gamma : {"1", "2.2"}) {
    PovFile file("global_settings { assumed_gamma " + std::string(gamma) + " } " + scene);
    file.write("p.png", PngBytes(1, 1, 8, 0, {{128}}).file);
    expect_color(at(see(file.load()), 0.6, 0.6), Color(0.252f), gamma);
  }
}

TEST(PovPattern, APictureThatIsNotThereIsMentioned) {
  PovFile file(around + "plane { -z, 0 pigment { image_map { png \"none.png\" } } }");
  file.load();
  EXPECT_TRUE(file.warns("none.png"));
}

TEST(PovPattern, WhatAPatternTransmitsShowsWhatLiesBehind) {
  const Framebuffer picture =
      see("plane { -z, 0 pigment { checker rgb <0.8, 0.1, 0.1> rgbt 1 } } "
          "plane { -z, -1 pigment { rgb 0 } }");
  expect_color(at(picture, 0.6, 0.6), red, "opaque");
  expect_color(at(picture, 1.6, 0.6), Color(0.0f), "clear");
}

TEST(PovPattern, LayersCoverEachOtherWhereTheyAreOpaque) {
  const Framebuffer picture =
      see("plane { -z, 0 texture { pigment { rgb <0.1, 0.8, 0.1> } } texture { pigment { checker "
          "rgb <0.8, 0.1, 0.1> rgbt 1 } } }");
  expect_color(at(picture, 0.6, 0.6), red, "upper");
  expect_color(at(picture, 1.6, 0.6), green, "lower");
}

TEST(PovPattern, PatternsChooseTextures) {
  const Framebuffer picture =
      see("plane { -z, 0 texture { checker texture { pigment { rgb <0.8, 0.1, 0.1> } } texture { "
          "pigment { rgb <0.1, 0.8, 0.1> } } } }");
  expect_color(at(picture, 0.6, 0.6), red, "first");
  expect_color(at(picture, 1.6, 0.6), green, "second");
}

TEST(PovPattern, ColorsAreBlendedAsWrittenAndThenMadeLinear) {
  const std::string gradient =
      "plane { -z, 0 pigment { gradient x color_map { [0 rgb 0] [1 rgb 1] } translate -0.5*x "
      "scale 8 } }";
  const Framebuffer linear = see(gradient);
  const Framebuffer encoded = see("global_settings { assumed_gamma 2.2 } " + gradient);
  const double value = (2.125 + 4.0) / 8.0;  // in the middle of a pixel
  EXPECT_NEAR(at(linear, 2.1, 0.1).x, value, 0.02);
  EXPECT_NEAR(at(encoded, 2.1, 0.1).x, std::pow(value, 2.2), 0.02);
}

TEST(PovPattern, BricksHaveMortarAtTheirUpperEndsAndEachSecondRowShifted) {
  const Framebuffer picture =
      see("plane { -z, 0 pigment { brick rgb <0.8, 0.1, 0.1> rgb <0.1, 0.8, 0.1> } }");
  expect_color(at(picture, -0.3, 1.1), red, "before a brick");
  expect_color(at(picture, 0.4, 1.1), green, "in a brick");
  expect_color(at(picture, 1.1, -0.3), red, "below a row");
  expect_color(at(picture, -0.3, 3.4), green, "in a shifted brick");
  expect_color(at(picture, 3.7, 3.4), red, "before a shifted brick");
}

TEST(PovPattern, GradientsRepeatBelowZeroAsAbove) {
  const Framebuffer picture =
      see("plane { -z, 0 pigment { gradient x color_map { [0 rgb 0] [1 rgb 1] } scale 2 } }");
  const double value = 0.3125;  // 0.625 of a period of 2, in the middle of a pixel
  for (const double x : {-3.4, -1.4, 0.6, 2.6})
    EXPECT_NEAR(at(picture, x, 0.1).x, value, 0.03) << x;
}

TEST(PovPattern, EmissionFollowsThePattern) {
  const Framebuffer picture =
      see("plane { -z, 0 pigment { " + checker + " } finish { diffuse 0 emission 1 } }");
  expect_color(at(picture, 0.6, 0.6), red, "first");
  expect_color(at(picture, 1.6, 0.6), green, "second");
}

// Figures: pictures by POV-Ray 3.7 of each pattern without a map and, for the value at the same
// pixel, with one from black to white.
TEST(PovPattern, PatternsWithoutAMapHaveTheLanguagesOwnColors) {
  using lumivec::pov::K;
  struct Figure {
    K kind;
    double value;
    double color[3];
  };
  const Figure figures[] = {{K::agate_, 0.2423, {0.9758, 0.8789, 0.7577}},
                            {K::agate_, 0.5643, {0.9, 0.7, 0.4357}},
                            {K::agate_, 0.6446, {0.9554, 0.6554, 0.3554}},
                            {K::bozo_, 0.3609, {1.0, 1.0, 1.0}},
                            {K::bozo_, 0.5213, {0.0, 1.0, 0.0}},
                            {K::bozo_, 0.6416, {0.0, 0.0, 1.0}},
                            {K::marble_, 0.3749, {0.9, 0.5001, 0.5001}},
                            {K::marble_, 0.9239, {0.0, 0.0, 0.0}},
                            {K::radial_, 0.4748, {1.0, 0.5743, 0.4257}},
                            {K::radial_, 0.825, {0.524, 0.476, 1.0}},
                            {K::wood_, 0.5397, {0.666, 0.312, 0.2}},
                            {K::wood_, 0.707, {0.4, 0.1333, 0.066}},
                            {K::onion_, 0.3, {0.3, 0.3, 0.3}},
                            {K::leopard_, 0.2, {0.2, 0.2, 0.2}}};
  constexpr double near = 1e-3;
  constexpr double steepest = 3.0;  // of all these maps, so that colors differ by this much more
  for (const Figure& figure : figures) {
    lumivec::pov::Pigment pigment;
    pigment.pattern.kind = figure.kind;
    bool met = false, approximate = false;
    for (int i = 0; i < 20000 && !met; ++i) {
      const lumivec::V3d p(0.0131 * i * std::cos(i), 0.0071 * i, 0.0113 * i * std::sin(i));
      const auto value = pattern_value(pigment.pattern, p);
      ASSERT_TRUE(value);
      if (std::abs(*value - figure.value) > near) continue;
      met = true;
      const auto color = pigment_color(pigment, p, approximate);
      EXPECT_NEAR(color.red, figure.color[0], steepest * near + 2e-4) << figure.value;
      EXPECT_NEAR(color.green, figure.color[1], steepest * near + 2e-4) << figure.value;
      EXPECT_NEAR(color.blue, figure.color[2], steepest * near + 2e-4) << figure.value;
    }
    EXPECT_TRUE(met) << figure.value;
    EXPECT_FALSE(approximate);
  }
}

// Figures: POV-Ray 3.7's pictures of spirals from black to white, in 16 bits, whose rays meet the
// plane where they are asked here but for less than 1e-3.
TEST(PovPattern, SpiralsHaveTheirArmsWhereTheLanguageHasThem) {
  lumivec::pov::Pattern spiral;
  spiral.kind = lumivec::pov::K::spiral1_;
  const auto value = [&](double arms, double x) {
    spiral.numbers = {arms};
    return pattern_value(spiral, {x, -0.0625, 0.0}).value_or(-1.0);
  };
  EXPECT_NEAR(value(3, 0.0625), 0.9268, 1e-3);
  EXPECT_NEAR(value(3, 0.5625), 0.5262, 1e-3);
  EXPECT_NEAR(value(3, 1.4375), 0.3362, 1e-3);
  EXPECT_NEAR(value(1, 0.0625), 0.4268, 1e-3);
  EXPECT_NEAR(value(1, 0.5625), 0.4033, 1e-3);
  EXPECT_NEAR(value(1, 1.4375), 0.6361, 1e-3);
}

// Figures: POV-Ray 3.7's picture of a gradient with this wave from black to white, in 16 bits; the
// places are rounded to 1e-4, where the wave's slope is at most 1.5.
TEST(PovPattern, CubicWavesRiseOnceInEachPeriod) {
  lumivec::pov::Pattern wave;
  wave.kind = lumivec::pov::K::gradient_;
  wave.vector = {1.0, 0.0, 0.0};
  wave.wave = lumivec::pov::K::cubic_wave_;
  const double figures[][2] = {
      {0.0595, 0.0102}, {0.1845, 0.0896}, {0.4345, 0.4023}, {0.6845, 0.7642}, {0.9345, 0.9877}};
  for (const auto& [x, value] : figures)
    EXPECT_NEAR(pattern_value(wave, {x, 0.0, 0.0}).value_or(-1.0), value, 3e-4) << x;
}

TEST(PovPattern, PatternsThatAreNotFollowedAreMentioned) {
  PovFile file(around + "plane { -z, 0 pigment { mandel 10 exponent 3 } }");
  file.load();
  EXPECT_TRUE(file.warns("a pattern that is not followed became its average color"));
  PovFile followed(around + "plane { -z, 0 pigment { granite } }");
  followed.load();
  EXPECT_FALSE(followed.warns("average color"));
}

// Gradients along x, y and z at a point of a warped pattern.
V3d warped(const lumivec::pov::PatternStep& warp, const V3d& point) {
  V3d found;
  for (int axis = 0; axis < 3; ++axis) {
    lumivec::pov::Pattern pattern;
    pattern.kind = K::gradient_;
    pattern.vector[axis] = 1.0;
    pattern.steps = {warp};
    found[axis] = lumivec::pov::pattern_value(pattern, point).value_or(-1.0);
  }
  return found;
}

// The wanted values are those of POV-Ray 3.7's pictures; of black holes, z goes as x does.
TEST(PovPattern, WarpsLayPatternsAsPovRayDoes) {
  struct Case {
    K kind;
    std::vector<V3d> vectors;
    std::vector<std::pair<K, V3d>> options;
    V3d point, wanted;
  };
  const V3d x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), one(1.0);
  const V3d a(-0.721375, 0.438875, 0.5), b(1.153625, -0.498625, 0.5), c(0.216125, 0.001375, 0.2);
  const std::vector<Case> cases = {
      {K::cylindrical_, {}, {}, a, {0.4035, 0.4389, 0.8777}},
      {K::cylindrical_, {}, {{K::dist_exp_, one}}, b, {0.0818, 0.5014, 0.2573}},
      {K::cylindrical_, {}, {{K::orientation_, y}}, b, {0.0651, 0.7427, 0.5014}},
      {K::cylindrical_, {}, {{K::orientation_, x}}, a, {0.8777, 0.4389, 0.5965}},
      {K::spherical_, {}, {}, b, {0.0651, 0.3798, 0.3526}},
      {K::spherical_, {}, {{K::dist_exp_, one}}, a, {0.3960, 0.6355, 0.9813}},
      {K::toroidal_, {}, {{K::major_radius_, one * 0.7}}, a, {0.4035, 0.6888, 0.4735}},
      {K::toroidal_,
       {},
       {{K::major_radius_, one * 0.7}, {K::dist_exp_, one}},
       b,
       {0.0487, 0.2870, 0.7478}},
      {K::planar_, {y, one * 0.3}, {}, b, {0.1536, 0.7000, 0.5014}},
      {K::repeat_, {x * 0.7}, {{K::offset_, y * 0.1}}, b, {0.4536, 0.6014, 0.5}},
      {K::repeat_, {x * 0.7}, {{K::flip_, x}}, b, {0.2464, 0.5014, 0.5}},
      {K::repeat_,
       {x * 0.7},
       {{K::offset_, x * 0.05 + y * 0.1}, {K::flip_, x + y}},
       b,
       {0.2964, 0.5986, 0.5}},
      {K::black_hole_, {V3d(0.0), one * 2.0}, {}, c, {0.3733, 0.0024, 0.3455}},
      {K::black_hole_,
       {V3d(0.0), one * 2.0},
       {{K::strength_, one * 2.0}},
       c,
       {0.4323, 0.0027, 0.4}},
      {K::black_hole_, {V3d(0.0), one * 2.0}, {{K::inverse_, one}}, c, {0.0590, 0.0004, 0.0546}},
  };
  for (std::size_t i = 0; i < cases.size(); ++i) {
    lumivec::pov::PatternStep warp;
    warp.kind = lumivec::pov::PatternStep::Kind::warp;
    warp.warp = cases[i].kind;
    warp.vectors = cases[i].vectors;
    warp.options = cases[i].options;
    const V3d found = warped(warp, cases[i].point);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], cases[i].wanted[k], 0.001) << i << ' ' << k;
  }
}

TEST(PovPattern, WarpsThatReachNoEndStillHaveAValue) {
  lumivec::pov::PatternStep warp;
  warp.kind = lumivec::pov::PatternStep::Kind::warp;
  warp.warp = K::spherical_;
  warp.options = {{K::dist_exp_, V3d(-1.0)}};
  const V3d found = warped(warp, V3d(0.0));
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(std::isfinite(found[k])) << k;
}

}  // namespace
