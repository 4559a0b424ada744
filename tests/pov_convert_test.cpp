// What a described scene becomes: surfaces and which way they look, cameras, and that every number
// of the result is finite.
#include <cmath>
#include <numbers>
#include <vector>

#include "integrator/solid_boundaries.h"
#include "tests/pov_file.h"

namespace {

using lumivec::Mesh;
using lumivec::Scene;
using lumivec::V3d;
using lumivec::V3f;

V3d corner(const Mesh& mesh, std::uint32_t i) {
  return V3d(mesh.positions[i]);
}

// Of the surface; above 0 if it looks outward.
double volume(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
    sum += corner(mesh, t.x).dot(corner(mesh, t.y).cross(corner(mesh, t.z))) / 6.0;
  return sum;
}

double area(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const V3d a = corner(mesh, t.x);
    sum += (corner(mesh, t.y) - a).cross(corner(mesh, t.z) - a).length() / 2.0;
  }
  return sum;
}

struct Passage {
  V3d point;
  V3d outward;
};

// Where a line passes the surfaces of all solids.
std::vector<Passage> passages(const Scene& scene, const lumivec::Line& line) {
  std::vector<Passage> found;
  for (const lumivec::Instance& instance : scene.instances) {
    if (instance.solid < 0) continue;
    const lumivec::TracedSolid solid(scene.solids[std::size_t(instance.solid)], instance.solid_part,
                                     instance.object_to_world);
    double from = 0.0;
    while (const auto boundary = solid.first_boundary(line, from, 100.0)) {
      const auto place = solid.place(boundary->leaf, line, boundary->t);
      found.push_back({place.point, place.outward});
      from = boundary->t + 1e-6;
    }
  }
  return found;
}

// By the lengths within, over a grid that the edges of these tests lie on.
double volume_of_solids(const Scene& scene) {
  constexpr int cells = 96;
  constexpr double reach = 1.5, side = 2.0 * reach / cells;
  double sum = 0.0;
  for (int i = 0; i < cells * cells; ++i) {
    const V3d origin((i % cells + 0.5) * side - reach, (i / cells + 0.5) * side - reach, -10.0);
    for (const Passage& p : passages(scene, {origin, V3d(0.0, 0.0, 1.0)}))
      sum += (p.outward.z > 0.0 ? p.point.z : -p.point.z) * side * side;
  }
  return sum;
}

double volume(const Scene& scene) {
  double sum = volume_of_solids(scene);
  for (const Mesh& mesh : scene.meshes) sum += volume(mesh);
  return sum;
}

// ---- solids ------------------------------------------------------------------------------------

TEST(PovConvert, WhatADifferenceTakesAwayLooksIntoTheHole) {
  const Scene scene = PovFile("difference { box { -1, 1 } box { -0.5, 0.5 } }").load();
  EXPECT_NEAR(volume(scene), 7.0, 1e-3);
  const Scene nested = PovFile(
                           "difference { box { -1, 1 } difference { box { -0.5, 0.5 } "
                           "box { -0.25, 0.25 } } }")
                           .load();
  EXPECT_NEAR(volume(nested), 7.125, 1e-3);
}

TEST(PovConvert, ABiteOfASphereLooksOutward) {
  const Scene scene = PovFile("difference { box { -1, 1 } sphere { <0, 1, 0>, 0.5 } }").load();
  const auto down = passages(scene, {V3d(0.2, 5.0, 0.1), V3d(0.0, -1.0, 0.0)});
  ASSERT_EQ(down.size(), 2u);
  const V3d from_center = down[0].point - V3d(0, 1, 0);
  EXPECT_NEAR(from_center.length(), 0.5, 1e-9);
  EXPECT_NEAR(from_center.dot(down[0].outward), -0.5, 1e-9);
  EXPECT_NEAR(down[1].point.y, -1.0, 1e-9);
  EXPECT_NEAR(volume(scene), 8.0 - std::numbers::pi / 12.0, 0.01);
}

TEST(PovConvert, ACutSphereIsCoveredOnce) {
  const Scene scene = PovFile("intersection { sphere { 0, 1 } box { -2, <2, 0, 2> } }").load();
  for (int i = 0; i < 20; ++i) {
    const double x = 0.95 * i / 20.0;
    const auto up = passages(scene, {V3d(x, -5.0, 0.0), V3d(0.0, 1.0, 0.0)});
    ASSERT_EQ(up.size(), 2u);
    EXPECT_NEAR(up[0].point.y, -std::sqrt(1.0 - x * x), 1e-9);
    EXPECT_LT(up[0].outward.y, 0.0);
    EXPECT_NEAR(up[1].point.y, 0.0, 1e-9);
    EXPECT_NEAR(up[1].outward.y, 1.0, 1e-9);
  }
}

// What is taken away keeps its own texture on the face that it leaves.
TEST(PovConvert, ACutFaceLooksLikeWhatCut) {
  const Scene scene = PovFile(
                          "difference { box { -1, 1 pigment { rgb <1, 0, 0> } } "
                          "sphere { <0, 1, 0>, 0.5 pigment { rgb <0, 1, 0> } } }")
                          .load();
  ASSERT_EQ(scene.instances.size(), 2u);
  for (const lumivec::Instance& instance : scene.instances) {
    const lumivec::TracedSolid solid(scene.solids[std::size_t(instance.solid)], instance.solid_part,
                                     instance.object_to_world);
    const auto hit = solid.first_boundary({V3d(0.0, 5.0, 0.0), V3d(0.0, -1.0, 0.0)}, 0.0, 20.0);
    ASSERT_TRUE(hit);
    const bool green = scene.materials[std::size_t(instance.material)].base_color.y > 0.0f;
    EXPECT_NEAR(hit->t, green ? 4.5 : 6.0, 1e-9);
  }
}

TEST(PovConvert, InverseTurnsASurface) {
  EXPECT_NEAR(volume(PovFile("box { -1, 1 inverse }").load()), -8.0, 1e-6);
}

TEST(PovConvert, MirroredCutsLookOutward) {
  const Scene scene =
      PovFile("intersection { box { -1, 1 } box { -2, <2, 0, 2> } scale <-1, 1, 1> }").load();
  EXPECT_NEAR(volume(scene), 4.0, 1e-3);
}

// A wall whose ring of least radius is in the middle: as POV-Ray has it, what lies beyond that
// radius, within the wall and not above it, is inside, and what closes it cannot be seen.
TEST(PovConvert, AnOpenProfileIsInsideOfItsLine) {
  const std::string wall = "lathe { linear_spline 3, <1, 0>, <0.5, 0.5>, <1, 1> }";
  const lumivec::Line at_height{V3d(-5.0, 0.75, 0.0), V3d(1.0, 0.0, 0.0)};
  const Scene alone = PovFile(wall).load();
  const auto ends = passages(alone, at_height);
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_NEAR(ends[0].point.x, -0.75, 1e-9);
  EXPECT_NEAR(ends[1].point.x, 0.75, 1e-9);
  const auto cut = [&](const char* box) {
    return passages(
        PovFile("intersection { box { " + std::string(box) + " } " + wall + " }").load(),
        {V3d(0.0, 0.75, 5.0), V3d(0.0, 0.0, -1.0)});
  };
  // A column along the axis is where nothing is inside; one beside it ends on its own faces.
  EXPECT_TRUE(cut("<-0.1, 0, -0.1>, <0.1, 2, 0.1>").empty());
  const auto faces = cut("<-0.1, 0, 0.6>, <0.1, 2, 0.7>");
  ASSERT_EQ(faces.size(), 2u);
  EXPECT_NEAR(std::abs(faces[0].point.z), 0.6, 1e-9);
  EXPECT_NEAR(std::abs(faces[1].point.z), 0.7, 1e-9);
}

TEST(PovConvert, LargeUnionsTakeLinearTime) {
  PovFile file("union { #for (I, 1, 100000) sphere { I, 0.5 } #end }");
  EXPECT_EQ(file.load().instances.size(), 100000u);
}

// ---- textures ----------------------------------------------------------------------------------

TEST(PovConvert, TrianglesKeepTheirOwnTextures) {
  const std::string red = "texture { pigment { rgb <1, 0, 0> } finish { diffuse 1 } }";
  const std::string green = "texture { pigment { rgb <0, 1, 0> } finish { diffuse 1 } }";
  const Scene mesh = PovFile("mesh { triangle { 0, x, y " + red + " } triangle { 0, y, z " + green +
                             " } triangle { 0, z, x } }")
                         .load();
  EXPECT_EQ(mesh.instances.size(), 3u);
  const Scene mesh2 = PovFile("mesh2 { vertex_vectors { 4, 0, x, y, z } texture_list { 2, " + red +
                              green + " } face_indices { 2, <0, 1, 2>, 0, <0, 2, 3>, 1 } }")
                          .load();
  ASSERT_EQ(mesh2.instances.size(), 2u);
  EXPECT_EQ(mesh2.materials[static_cast<std::size_t>(mesh2.instances[1].material)].base_color,
            lumivec::Color(0, 1, 0));
}

TEST(PovConvert, APigmentBeginsWithThatOfItsTexture) {
  const std::string blue =
      "#declare T = texture { pigment { rgb <0, 0, 1> } finish { diffuse 1 } }\n";
  const Scene scaled = PovFile(blue + "sphere { 0, 1 texture { T pigment { scale 2 } } }").load();
  EXPECT_EQ(scaled.materials.at(0).base_color, lumivec::Color(0, 0, 1));
  const Scene usual = PovFile(
                          "#default { pigment { rgb <0, 0, 1> } finish { diffuse 1 } }\n"
                          "sphere { 0, 1 pigment { scale 2 } }")
                          .load();
  EXPECT_EQ(usual.materials.at(0).base_color, lumivec::Color(0, 0, 1));
}

TEST(PovConvert, EqualTexturesAreOneMaterial) {
  const Scene scene = PovFile("#for (I, 1, 9) sphere { I, 0.1 pigment { rgb 1 } } #end").load();
  EXPECT_EQ(scene.instances.size(), 9u);
  EXPECT_EQ(scene.materials.size(), 1u);
}

TEST(PovConvert, WhatIsLeftOutIsSaid) {
  PovFile file(
      "sphere { 0, 1 pigment { rgb 1 } finish { phong 1 metallic brilliance 2 } "
      "interior_texture { pigment { rgb 0 } } }\n"
      "blob { threshold 0.5 sphere { 0, 1, 1 pigment { rgb 1 } } }\n"
      "light_source { 5 rgb 1 projected_through { sphere { 1, 1 } } }");
  file.load();
  for (const char* words :
       {"metallic", "brilliance", "interior_texture", "blob", "projected_through"})
    EXPECT_TRUE(file.warns(words)) << words;
}

TEST(PovConvert, LightsAreAsTheLanguageHasThem) {
  PovFile file(
      "#version 3.7; global_settings { assumed_gamma 1 }\n"
      "light_source { <1, 2, 3> rgb 0.5 }\n"
      "light_source { 0 rgb 1 fade_distance 4 fade_power 3 shadowless }\n"
      "light_source { y rgb 1 spotlight point_at 0 radius 10 falloff 20 tightness 7 }\n"
      "light_source { y rgb 1 cylinder point_at 0 radius 2 falloff 3 }\n"
      "light_source { y rgb 1 parallel point_at 0 }\n"
      "light_source { y rgb 1 area_light 4 * x, 2 * z, 5, 5 circular adaptive 1 jitter }\n");
  const Scene scene = file.load();
  EXPECT_FALSE(file.warns("light"));
  ASSERT_EQ(scene.lights.size(), 6u);
  constexpr float pi = std::numbers::pi_v<float>, degree = pi / 180.0f;
  const auto& lights = scene.lights;
  using lumivec::LightKind;
  EXPECT_EQ(lights[0].kind, LightKind::point);
  EXPECT_FLOAT_EQ(lights[0].intensity.x, 0.5f * pi);
  EXPECT_GT(lights[0].fade_distance, 0.0f);
  EXPECT_EQ(lights[0].fade_power, 0.0f);
  EXPECT_EQ(lights[0].object_to_world[3][0], 1.0);
  EXPECT_EQ(lights[0].object_to_world[3][2], -3.0);
  EXPECT_TRUE(lights[0].casts_shadows);
  EXPECT_FALSE(lights[1].casts_shadows);
  EXPECT_EQ(lights[1].fade_distance, 4.0f);
  EXPECT_EQ(lights[1].fade_power, 3.0f);
  EXPECT_EQ(lights[2].kind, LightKind::spot);
  EXPECT_FLOAT_EQ(lights[2].inner_cone, 10.0f * degree);
  EXPECT_FLOAT_EQ(lights[2].outer_cone, 20.0f * degree);
  EXPECT_EQ(lights[2].tightness, 7.0f);
  EXPECT_TRUE(lights[2].smooth_edge);
  EXPECT_NEAR(lights[2].object_to_world[2][1], 1.0, 1e-12);  // shines along -Z: down
  EXPECT_EQ(lights[3].kind, LightKind::beam);
  EXPECT_EQ(lights[3].inner_radius, 2.0f);
  EXPECT_EQ(lights[3].outer_radius, 3.0f);
  EXPECT_EQ(lights[4].kind, LightKind::directional);
  EXPECT_FLOAT_EQ(lights[4].intensity.x, pi);
  EXPECT_EQ(lights[5].kind, LightKind::point);
  EXPECT_EQ(lights[5].shadow_u, V3f(2, 0, 0));
  EXPECT_EQ(lights[5].shadow_v, V3f(0, 0, -1));
  EXPECT_TRUE(lights[5].round_shadows);
}

TEST(PovConvert, ObjectsAreHiddenWhereTheyAskForIt) {
  PovFile file(
      "sphere { 0, 1 no_image }\n"
      "union { box { -1, 1 no_reflection } difference { sphere { 0, 2 } box { 0, 3 } } no_shadow "
      "}\n"
      "light_source { 5 rgb 1 looks_like { sphere { 0, 1 } } }");
  const Scene scene = file.load();
  ASSERT_EQ(scene.instances.size(), 4u);
  const bool expected[4][3] = {
      {false, true, true}, {true, false, false}, {true, true, false}, {true, true, false}};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(scene.instances[i].seen_by_eye, expected[i][0]) << i;
    EXPECT_EQ(scene.instances[i].seen_in_reflections, expected[i][1]) << i;
    EXPECT_EQ(scene.instances[i].casts_shadows, expected[i][2]) << i;
  }
}

TEST(PovConvert, CamerasThatAreNotFlat) {
  const struct {
    const char* text;
    lumivec::CameraKind kind;
    double xangle, yangle;  // degrees
  } cases[] = {
      {"fisheye right x up y angle 200", lumivec::CameraKind::fisheye, 200, 200},
      {"fisheye right x up 0.5 * y", lumivec::CameraKind::fisheye, 90, 45},
      {"spherical right 2 * x up y", lumivec::CameraKind::spherical, 360, 180},
      {"spherical angle 100", lumivec::CameraKind::spherical, 100, 50},
      {"spherical angle 100, 20", lumivec::CameraKind::spherical, 100, 20},
      {"ultra_wide_angle right 1.5 * x up y angle 120", lumivec::CameraKind::ultra_wide, 120, 80},
      {"cylinder 1 angle 70", lumivec::CameraKind::upright_cylinder, 70, 70},
      {"cylinder 2", lumivec::CameraKind::lying_cylinder, 90, 90},
  };
  for (const auto& c : cases) {
    PovFile file(std::string("camera { ") + c.text + " location -5 * z } sphere { 0, 1 }");
    const Scene scene = file.load();
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].kind, c.kind) << c.text;
    EXPECT_NEAR(double(scene.cameras[0].xangle) * 180.0 / std::numbers::pi, c.xangle, 1e-4)
        << c.text;
    EXPECT_NEAR(double(scene.cameras[0].yangle) * 180.0 / std::numbers::pi, c.yangle, 1e-4)
        << c.text;
    EXPECT_FALSE(file.warns("perspective")) << c.text;
  }
  PovFile omnimax("camera { omnimax location -5 * z } sphere { 0, 1 }");
  omnimax.load();
  EXPECT_TRUE(omnimax.warns("omnimax camera is taken for a perspective one"));
}

// ---- height fields -----------------------------------------------------------------------------

// Grey, 4 by 3 pixels that rise from black to white along x.
std::string ramp() {
  const std::string hex =
      "89504e470d0a1a0a0000000d4948445200000004000000030800000000919ff11a0000001049444154789c636008"
      "5d"
      "f59f014e000027e705fb5fba1cae0000000049454e44ae426082";
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return bytes;
}

TEST(PovConvert, AHeightFieldIsItsPicture) {
  PovFile file("height_field { \"ramp.png\" }");
  file.write("ramp.png", ramp());
  const Scene scene = file.load();
  ASSERT_EQ(scene.meshes.size(), 1u);
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.triangles.size(), 12u);
  for (const V3f& p : mesh.positions) EXPECT_NEAR(p.y, p.x, 1e-6f);
  EXPECT_NEAR(area(mesh), std::numbers::sqrt2, 1e-5);
  for (const auto& t : mesh.triangles) {
    const V3f up = (mesh.positions[t.y] - mesh.positions[t.x])
                       .cross(mesh.positions[t.z] - mesh.positions[t.x]);
    EXPECT_GT(up.y, 0.0f);
  }
}

TEST(PovConvert, UnderWaterAHeightFieldEnds) {
  PovFile file("height_field { \"ramp.png\" water_level 0.5 smooth }");
  file.write("ramp.png", ramp());
  EXPECT_EQ(file.load().meshes.at(0).triangles.size(), 8u);
}

TEST(PovConvert, APictureOfAHeightFieldIsBounded) {
  PovFile file("height_field { \"huge.png\" }");
  std::string huge = ramp();
  // 60000 pixels wide and high, with the header's checksum.
  huge.replace(16, 8, std::string("\0\0\xea\x60\0\0\xea\x60", 8));
  huge.replace(29, 4, "\xa5\xb9\x2a\x9e");
  file.write("huge.png", huge);
  EXPECT_NE(file.error().find("--max-bytes"), std::string::npos);
  PovFile text("height_field { \"text.png\" }");
  text.write("text.png", "no picture");
  text.load();
  EXPECT_TRUE(text.warns("text.png"));
}

// ---- cameras -----------------------------------------------------------------------------------

// Measured with POV-Ray 3.7: a box of known size was rendered, and its pixels counted.
void expect_view(const std::string& camera, double width, double height) {
  const Scene scene = PovFile("camera { " + camera + " } sphere { 0, 1 }").load();
  EXPECT_NEAR(2.0 * scene.cameras.at(0).xmag, width, 0.01 * width) << camera;
  EXPECT_NEAR(2.0 * scene.cameras.at(0).ymag, height, 0.01 * height) << camera;
}

TEST(PovConvert, OrthographicViewsAreAsWideAsTheAngleOrTheDistanceSays) {
  const std::string there = "orthographic location <0, 0, -10> ";
  const double wide = 2.0 * 10.0 * std::tan(std::numbers::pi / 12.0);
  expect_view(there + "look_at 0 right 4 * x * 1.333 up 4 * y", 5.332, 4.0);
  expect_view(there + "look_at 0 angle 30", wide, wide / 1.33);
  expect_view("orthographic angle 30 location <0, 0, -10> look_at 0", wide, wide / 1.33);
  expect_view(there + "look_at 0 right 6 * x * 1.333 up 6 * y angle 30", wide, wide / 1.333);
  expect_view(there + "angle 30 look_at 0 right 6 * x * 1.333 up 6 * y", wide, wide / 1.333);
  expect_view(there + "look_at 0", 13.3, 10.0);
  expect_view(there, 14.63, 11.0);  // it looks at z
  expect_view(there + "direction 3 * z look_at 0", 13.3 / 3.0, 10.0 / 3.0);
  expect_view(there + "look_at 0 up 8 * y", 1.33, 8.0);
}

// ---- numbers that are none ---------------------------------------------------------------------

TEST(PovConvert, NumbersThatAreNotFiniteAreErrors) {
  const std::string infinite = "1e300 * 1e300", sphere = "sphere { 0, 1 }\n";
  const std::string words = "not finite";
  expect_error(sphere + "light_source { " + infinite + " rgb 1 }", words);
  expect_error(sphere + "light_source { 5 rgb " + infinite + " }", words);
  expect_error(sphere + "light_source { 5 rgb 1 area_light " + infinite + " * x, y, 2, 2 }", words);
  expect_error(sphere + "camera { location " + infinite + " }", words);
  expect_error(sphere + "camera { right " + infinite + " * x }", words);
  expect_error("sphere { 0, 1 pigment { rgb 1 } finish { emission " + infinite + " } }", words);
  expect_error("mesh { triangle { 0, x, " + infinite + " * y } }", words);
  expect_error("triangle { 0, x, 1e300 * y }", words);
  expect_error(sphere + "background { rgb " + infinite + " }", words);
}

}  // namespace
