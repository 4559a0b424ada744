// Curved shapes of the scene language as exact solids, against closed forms, and what is
// degenerate.
#include <cmath>

#include "integrator/solid_boundaries.h"
#include "tests/png_bytes.h"
#include "tests/pov_file.h"
#include "tests/tiny_font.h"

namespace {

using lumivec::Line;
using lumivec::Scene;
using lumivec::V3d;

// The scene's coordinates are left-handed and z is mirrored on the way to the world.
std::vector<double> hits(const Scene& scene, V3d origin, V3d direction) {
  origin.z = -origin.z;
  direction.z = -direction.z;
  std::vector<double> found;
  for (const lumivec::Instance& instance : scene.instances) {
    if (instance.solid < 0) continue;
    const lumivec::TracedSolid solid(scene.solids[std::size_t(instance.solid)], instance.solid_part,
                                     instance.object_to_world);
    double from = 0.0;
    while (const auto boundary = solid.first_boundary({origin, direction}, from, 100.0)) {
      found.push_back(boundary->t);
      from = boundary->t + 1e-9;
    }
  }
  return found;
}

void expect_hits(const std::string& text, const V3d& origin, const V3d& direction,
                 const std::vector<double>& wanted) {
  PovFile file(text);
  const Scene scene = file.load();
  EXPECT_TRUE(scene.meshes.empty()) << text;
  const std::vector<double> found = hits(scene, origin, direction);
  ASSERT_EQ(found.size(), wanted.size()) << text;
  for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-9) << text;
}

const V3d right(1.0, 0.0, 0.0), down(0.0, -1.0, 0.0), ahead(0.0, 0.0, 1.0);

TEST(PovShapes, PrismsOfAllSplines) {
  const std::string square = " 5, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1> ";
  expect_hits("prism { linear_spline -1, 1," + square + "}", V3d(-5.0, 0.5, 0.25), right, {4, 6});
  expect_hits("prism { linear_spline -1, 1," + square + "}", V3d(0.5, 5.0, 0.25), down, {4, 6});
  expect_hits("prism { linear_spline -1, 1," + square + "open }", V3d(0.5, 5.0, 0.25), down, {});
  // Not closed: POV-Ray closes it.
  expect_hits("prism { linear_spline -1, 1, 4, <-1, -1>, <1, -1>, <1, 1>, <-1, 1> }",
              V3d(-5.0, 0.5, 0.25), right, {4, 6});
  expect_hits("prism { conic_sweep linear_spline 0.5, 1," + square + "}", V3d(-5.0, 0.75, 0.0),
              right, {4.25, 5.75});
  // Bézier stretches with controls on their chords are straight.
  expect_hits(
      "prism { bezier_spline 0, 1, 12, <0, 0>, <1, 0>, <2, 0>, <3, 0>, <3, 0>, <2, 1>, <1, "
      "2>, <0, 3>, <0, 3>, <0, 2>, <0, 1>, <0, 0> }",
      V3d(-5.0, 0.5, 1.0), right, {5, 7});
  // Its side from (-1, 2) to (1, 0) is (-1 + t + t², 2 - 2t²): x = 0 where z = √5 - 1.
  expect_hits("prism { quadratic_spline 0, 1, 5, <1, 0>, <1, 0>, <-1, 0>, <-1, 2>, <1, 0> }",
              V3d(0.0, 0.5, -5.0), ahead, {5.0, 4.0 + std::sqrt(5.0)});
}

TEST(PovShapes, LathesAndSors) {
  expect_hits("lathe { linear_spline 3, <0, -1>, <1, 0>, <0, 1> }", V3d(-5.0, 0.5, 0.0), right,
              {4.5, 5.5});
  expect_hits("lathe { cubic_spline 5, <0, -1>, <0.5, 0>, <1, 1>, <1.5, 2>, <2, 3> }",
              V3d(-5.0, 0.5, 0.0), right, {4.25, 5.75});
  // Between radii of 1 with level slopes the square of the radius is 1.
  const std::string cylinder = "sor { 4, <1, -1>, <1, 0>, <1, 1>, <1, 2> ";
  expect_hits(cylinder + "}", V3d(-5.0, 0.5, 0.0), right, {4, 6});
  expect_hits(cylinder + "}", V3d(0.5, 5.0, 0.0), down, {4, 5});
  expect_hits(cylinder + "open }", V3d(0.5, 5.0, 0.0), down, {});
}

TEST(PovShapes, BlobsSuperellipsoidsAndSweeps) {
  expect_hits("blob { threshold 0.25 sphere { 0, 2, 1 } }", V3d(-5.0, 0.0, 0.0), right,
              {5 - std::sqrt(2.0), 5 + std::sqrt(2.0)});
  expect_hits("blob { threshold 0.25 cylinder { -2*x, 2*x, 1, 1 scale <1, 2, 1> } }",
              V3d(0.5, 5.0, 0.0), down, {5 - std::sqrt(2.0), 5 + std::sqrt(2.0)});
  expect_hits("superellipsoid { <1, 1> scale 2 }", V3d(-5.0, 0.0, 0.0), right, {3, 7});
  expect_hits("sphere_sweep { linear_spline 2, <0, -1, 0>, 0.5, <0, 1, 0>, 0.5 }",
              V3d(-5.0, 0.0, 0.0), right, {4.5, 5.5});
  expect_hits("sphere_sweep { linear_spline 2, <0, -1, 0>, 0.5, <0, 1, 0>, 0.5 }",
              V3d(0.0, 5.0, 0.0), down, {3.5, 6.5});
  // Evenly spaced on a line: the splines are that line, between the second and the third.
  const std::string even = " 4, <0, -3, 0>, 1, <0, -1, 0>, 1, <0, 1, 0>, 1, <0, 3, 0>, 1 }";
  for (const char* spline : {"b_spline", "cubic_spline"})
    expect_hits("sphere_sweep { " + std::string(spline) + even, V3d(0.0, 5.0, 0.0), down, {3, 7});
}

TEST(PovShapes, AreCutAndCutLikeOthers) {
  const std::string sweep = "sphere_sweep { linear_spline 2, <-2, 0, 0>, 0.5, <2, 0, 0>, 0.5 }";
  expect_hits("difference { box { -1, 1 } " + sweep + " }", V3d(0.0, 5.0, 0.0), down,
              {4, 4.5, 5.5, 6});
  expect_hits("lathe { linear_spline 3, <0, -1>, <1, 0>, <0, 1> clipped_by { plane { x, 0 } } }",
              V3d(-5.0, 0.5, 0.0), right, {4.5});
  expect_hits("box { -1, 1 clipped_by { superellipsoid { <1, 1> scale 1.2 inverse } } }",
              V3d(-5.0, 0.0, 0.0), right, {});
}

TEST(PovShapes, DegenerateOnesAreNothing) {
  for (const char* text : {
           "prism { linear_spline 0, 1, 3, <1, 1>, <1, 1>, <1, 1> }",
           "prism { linear_spline 1, 1, 3, <0, 0>, <1, 0>, <0, 1> }",
           "prism { bezier_spline 0, 1, 4, <1, 0>, <1, 0>, <1, 0>, <1, 0> }",
           "prism { conic_sweep linear_spline 0, 0, 3, <0, 0>, <1, 0>, <0, 1> }",
           "lathe { linear_spline 2, <0, 1>, <0, 1> }",
           "lathe { cubic_spline 4, <0, 1>, <0, 1>, <0, 1>, <0, 1> }",
           "sor { 4, <0, 0>, <0, 0>, <0, 0>, <0, 0> }",
           "blob { threshold 0.5 }",
           "blob { threshold 0.5 sphere { 0, 0, 1 } sphere { 0, 1, 0 } }",
           "blob { threshold 2 sphere { 0, 1, 1 } cylinder { 0, 0, 1, 0.5 } }",
           "sphere_sweep { linear_spline 2, 0, 0, x, 0 }",
           "sphere_sweep { cubic_spline 4, 0, 0, 0, 0, 0, 0, 0, 0 }",
           "sphere_sweep { b_spline 2, 0, 1, x, 1 }",
       }) {
    PovFile file(text);
    EXPECT_EQ(file.error(), "") << text;
    const Scene scene = file.load();
    for (const double x : {0.0, 0.3, 1.0})
      EXPECT_TRUE(hits(scene, V3d(-5.0 + x, 0.31, x - 5.0), V3d(1.0, 0.0, 1.0)).empty()) << text;
  }
}

TEST(PovShapes, ManyComponentsAndPointsAreBounded) {
  PovFile blob(
      "blob { threshold 0.5 #for (I, 1, 1000000) sphere { <mod(I, 100), mod(int(I / 100), 100), "
      "int(I / 10000)>, 0.4, 1 } #end }");
  blob.options.max_bytes = 64u << 20;
  EXPECT_NE(blob.error().find("max"), std::string::npos) << blob.error();
  PovFile sweep(
      "sphere_sweep { linear_spline 20000 #for (I, 1, 20000) <I / 100, 0, 0>, 0.5 #end }");
  const auto found = hits(sweep.load(), V3d(50.0, 5.0, 0.0), down);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0], 4.5, 1e-9);
}

TEST(PovShapes, TextsAreTheirLettersOutlines) {
  PovFile file("text { ttf \"tiny.ttf\" \"AA\" 0.5, 0.25 }");
  file.write("tiny.ttf", tiny_font());
  const Scene scene = file.load();
  EXPECT_FALSE(file.warns("letter"));
  // Through the letters below, in and above their holes; the second begins 1.25 to the right.
  for (const double height : {0.1, 0.7}) {
    const auto found = hits(scene, V3d(-1.0, height, 0.25), right);
    ASSERT_EQ(found.size(), 4u);
    const double wanted[] = {1.1, 1.9, 2.35, 3.15};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(found[i], wanted[i], 1e-7);
  }
  EXPECT_EQ(hits(scene, V3d(-1.0, 0.4, 0.25), right).size(), 8u);
  const auto through = hits(scene, V3d(0.2, 0.4, -1.0), ahead);
  ASSERT_EQ(through.size(), 2u);
  EXPECT_NEAR(through[0], 1.0, 1e-7);
  EXPECT_NEAR(through[1], 1.5, 1e-7);
  EXPECT_TRUE(hits(scene, V3d(0.5, 0.4, -1.0), ahead).empty());
}

TEST(PovShapes, FontsThatCannotBeHad) {
  PovFile missing("text { ttf \"none.ttf\" \"A\" 1, 0 }");
  EXPECT_NE(missing.error().find("none.ttf"), std::string::npos) << missing.error();
  EXPECT_NE(missing.error().find("line 1, column 12"), std::string::npos) << missing.error();
  PovFile wrong("text { ttf \"scene.pov\" \"A\" 1, 0 }");
  EXPECT_NE(wrong.error().find("no font"), std::string::npos) << wrong.error();
  PovFile standard("text { ttf \"../timrom.ttf\" \"A\" 1, 0 }");
  EXPECT_NE(standard.error(), "");
  PovFile short_name("text { ttf \"tiny\" \"A\" 1, 0 }");
  short_name.write("tiny.ttf", tiny_font());
  EXPECT_EQ(hits(short_name.load(), V3d(-1.0, 0.1, 0.25), right).size(), 2u);
  PovFile outside("text { ttf \"../none.ttf\" \"A\" 1, 0 }");
  EXPECT_NE(outside.error(), "");
}

// Whatever a font's bytes are, it gives letters or one line.
TEST(PovShapes, BrokenFontsDoNoHarm) {
  const std::string whole = tiny_font();
  int given = 0, refused = 0;
  for (std::size_t i = 0; i < whole.size(); i += 3) {
    PovFile file("text { ttf \"tiny.ttf\" \"AB\" 0.5, 0 }");
    std::string broken = whole;
    broken[i] = static_cast<char>(~broken[i]);
    file.write("tiny.ttf", i % 2 ? broken : whole.substr(0, i));
    ++(file.error().empty() ? given : refused);
  }
  EXPECT_GT(given, 10);
  EXPECT_GT(refused, 10);
}

// Heights of a picture with a palette are the colors' places, whatever the colors.
TEST(PovShapes, HeightFieldsByPalette) {
  std::string palette(3 * 256, '\0');
  for (std::size_t i = 0; i < 256; ++i) {
    palette[3 * i] = static_cast<char>(255 - i);
    palette[3 * i + 1] = static_cast<char>(i * 7);
  }
  PovFile file("height_field { png \"heights.png\" }");
  file.write("heights.png", PngBytes(2, 2, 8, 3, {{51, 102}, {153, 255}}, palette).file);
  const Scene scene = file.load();
  ASSERT_EQ(scene.meshes.size(), 1u);
  const double wanted[] = {0.2, 0.4, 0.6, 1.0};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(scene.meshes[0].positions[i].y, wanted[i], 1e-6);
}

}  // namespace
