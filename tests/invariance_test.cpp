// What a picture keeps when the scene is changed in ways that cannot be seen, and what the hard
// cases of geometry show.
#include "cornell_scene.h"

namespace lumivec::test {
namespace {

constexpr int size = 48;
constexpr int block = 8;

Framebuffer cornell(const CornellOptions& options, int samples = 16, std::uint64_t seed = 1) {
  return render_clean(cornell_scene(options), cornell_camera(options), square(size, samples, seed));
}

// With the same random numbers nearly all paths stay the same; where rounding turns one at an edge,
// its block differs by that path.
void expect_same_blocks(const Framebuffer& a, const Framebuffer& b, double share = 0.1) {
  EXPECT_LE(differing_blocks(beauty(a), beauty(b), size, block, 1e-3), share);
  EXPECT_LE(differing_blocks(beauty(a), beauty(b), size, block, 0.05), 0.03);
}

class scale : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(of_the_scene, scale, testing::Values(1e-3, 0.1, 1e3, 1e6));

TEST_P(scale, does_not_show) {
  CornellOptions scaled;
  scaled.scale = GetParam();
  expect_same_blocks(cornell({}), cornell(scaled));
}

TEST_P(scale, in_transforms_does_not_show) {
  CornellOptions scaled;
  scaled.world = scaling(V3d(GetParam()));
  expect_same_blocks(cornell({}), cornell(scaled));
}

TEST(invariance, translation) {
  CornellOptions moved;
  moved.world = translation({1e5, -1e5, 1e5});
  expect_same_blocks(cornell({}), cornell(moved));
}

TEST(invariance, rotation) {
  CornellOptions turned;
  turned.world = rotation({1, 2, 3}, 2.0);
  // Frames around normals turn differently: other samples of the same picture.
  const std::vector<Color> a = beauty(cornell({}, 64)), b = beauty(cornell(turned, 64));
  expect_same_mean(a, b, 0.02);
  EXPECT_LE(differing_blocks(a, b, size, block, 0.25), 0.1);
}

TEST(invariance, mirrored_scene) {
  CornellOptions mirrored;
  mirrored.world = scaling({-1, 1, 1});
  const Scene scene = cornell_scene(mirrored);
  const Framebuffer picture = render_clean(scene, cornell_camera(), square(size, 64));
  const std::vector<Color> pixels = beauty(picture);
  std::vector<Color> flipped(pixels.size());
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      flipped[std::size_t(y * size + x)] = pixels[std::size_t(y * size + size - 1 - x)];
    }
  }
  const std::vector<Color> expected = beauty(cornell({}, 64));
  expect_same_mean(expected, flipped, 0.02);
  EXPECT_LE(differing_blocks(expected, flipped, size, block, 0.25), 0.1);
  // And it is not the same picture unflipped: red is on the other side.
  EXPECT_GT(differing_blocks(expected, pixels, size, block, 0.25), 0.1);
}

TEST(invariance, twice_the_emission_is_twice_the_light) {
  CornellOptions brighter;
  brighter.emission = 20.0f;
  const std::vector<Color> a = beauty(cornell({}, 8)), b = beauty(cornell(brighter, 8));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(b[i][c], 2.0f * a[i][c], 1e-6f * b[i][c]);
  }
}

TEST(invariance, extreme_emission) {
  for (const float emission : {1e-20f, 1e-6f, 1e6f, 1e15f}) {
    CornellOptions options;
    options.emission = emission;
    const std::vector<Color> a = beauty(cornell({}, 4)), b = beauty(cornell(options, 4));
    const double expected = mean_of(a).value * double(emission) / 10.0;
    EXPECT_NEAR(mean_of(b).value, expected, 1e-3 * expected) << emission;
  }
}

TEST(invariance, one_light_or_two_of_half_its_power) {
  Light light;
  light.intensity = Color(4.0f);
  light.object_to_world = translation({0.3, 0.5, 0.6});
  CornellOptions dark;
  dark.emission = 0.0f;
  Scene one = cornell_scene(dark), two = one;
  one.lights = {light};
  light.intensity = Color(2.0f);
  two.lights = {light, light};
  const Framebuffer a = render_clean(one, cornell_camera(), square(size, 64));
  const Framebuffer b = render_clean(two, cornell_camera(), square(size, 64, 2));
  for (const Term t : {Term::specular, Term::direct, Term::indirect}) {
    expect_same_mean(term(a, t), term(b, t), 0.02);
  }
}

TEST(invariance, finer_tessellation_of_a_wall) {
  CornellOptions fine;
  fine.wall_grid = 37;
  expect_same_blocks(cornell({}), cornell(fine));
}

// A mesh large enough that Embree instances it shows what copies of it show.
TEST(invariance, instances_or_copies) {
  const Mesh ball = icosphere(0.3f, 6, true);
  const M44d first = translation({-0.5, -0.3, 0.2});
  const M44d second =
      scaling({-1.2, 0.5, 0.8}) * rotation({1, 2, 3}, 1.0) * translation({0.5, -0.4, 0.3});
  ASSERT_GT(2 * ball.triangles.size(), std::size_t(1) << 16) << "would be flattened";
  for (const bool specular : {false, true}) {
    const Material material = specular ? glass(1.5f) : diffuse({0.7f, 0.5f, 0.2f});
    CornellOptions options;
    options.specular = false;
    Scene copies = cornell_scene(options);
    add_mesh(copies, ball, material, first);
    add_mesh(copies, ball, material, second);
    Scene instances = copies;
    instances.instances.back().mesh = static_cast<int>(copies.meshes.size()) - 2;
    const Framebuffer a = render_clean(copies, cornell_camera(), square(size, 16));
    const Framebuffer b = render_clean(instances, cornell_camera(), square(size, 16));
    expect_same_mean(beauty(a), beauty(b), 0.03);
    EXPECT_LE(differing_blocks(beauty(a), beauty(b), size, block, 0.02), specular ? 0.5 : 0.1);
  }
}

TEST(invariance, sphere_or_fine_mesh) {
  CornellOptions options;
  options.specular = false;
  for (const Material& material : {diffuse({0.7f, 0.5f, 0.2f}), metal(Color(0.9f)), glass(1.5f)}) {
    Scene exact = cornell_scene(options), mesh = exact;
    const M44d place = scaling({1, 0.8, 1.2}) * translation({0.3, -0.3, 0.2});
    add_sphere(exact, 0.35f, material, place);
    add_mesh(mesh, icosphere(0.35f, 5, true), material, place);
    const Framebuffer a = render_clean(exact, cornell_camera(), square(size, 32));
    const Framebuffer b = render_clean(mesh, cornell_camera(), square(size, 32, 2));
    expect_same_mean(beauty(a), beauty(b), 0.03);
    EXPECT_LE(differing_blocks(beauty(a), beauty(b), size, block, 0.3), 0.06);
  }
}

TEST(invariance, black_and_white_surfaces) {
  Scene scene;
  add_mesh(scene, quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}), diffuse(Color(0.0f, 1.0f, 0.5f)));
  add_sphere(scene, 0.5f, diffuse(Color(1.0f, 0.0f, 0.5f)), translation({0, 0.5, 0}));
  scene.environment.radiance = Color(1.0f);
  const Framebuffer picture =
      render_clean(scene, orthographic_camera({3, 3, 3}, {0, 0.3, 0}, 1.0f), square(size, 32));
  for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
    // Red and green are each reflected by one of the two only: nothing goes between them.
    EXPECT_EQ(term(picture, Term::indirect)[i].x, 0.0f);
    EXPECT_LE(picture.beauty(i).y, 1.5f);
  }
}

// ---- hard geometry ----------------------------------------------------------------------------

// A room cut in two by a sheet without thickness: the dark half is dark.
TEST(hard_geometry, wall_of_zero_thickness) {
  Scene scene;
  add_mesh(scene, box({-2, -1, -1}, {2, 1, 1}, true), diffuse(Color(0.8f)));
  Material wall = diffuse(Color(0.8f));
  wall.double_sided = true;  // else the eye would look through its back
  add_mesh(scene, quad({0, -1, -1}, {0, 2, 0}, {0, 0, 2}), wall);
  add_mesh(scene, quad({0.2f, 0.9f, -0.8f}, {1.6f, 0, 0}, {0, 0, 1.6f}), emitter(Color(1e6f)));
  Light light;
  light.intensity = Color(1e6f);
  light.object_to_world = translation({0.01, 0, 0});
  scene.lights = {light};
  for (const V3d& target : {V3d(0, 0, 0), V3d(0, -1, -1), V3d(-0.1, 1, 0), V3d(-2, 0, 0)}) {
    const Camera camera = perspective_camera({-1.5, 0.2, 0.3}, target, 1.2);
    expect_black(beauty(render_clean(scene, camera, square(size, 32))));
  }
}

// The eye looks through the backs of one-sided surfaces, and light is stopped by them.
TEST(hard_geometry, backs_of_one_sided_surfaces) {
  const Camera camera = perspective_camera({0, 0, 3}, {0, 0, 0}, 0.3);
  for (const bool double_sided : {false, true}) {
    Scene scene;
    // Seen from the front, lit from behind the eye, with the sheet's back in between.
    add_mesh(scene, quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}), diffuse(Color(0.5f)));
    Material sheet = diffuse(Color(0.5f));
    sheet.double_sided = double_sided;
    add_mesh(scene, quad({-9, -9, 1}, {0, 18, 0}, {18, 0, 0}), sheet);
    Light light;
    light.object_to_world = translation({0, 0, 2});
    scene.lights = {light};
    const Framebuffer picture = render_clean(scene, camera, square(8, 4));
    const float depth = double_sided ? 2.0f : 3.0f;
    for (const float d : picture.depth) EXPECT_NEAR(d, depth, 1e-5f);
    if (double_sided) {
      EXPECT_GT(beauty(picture)[0].x, 0.0f);
    } else {
      expect_black(beauty(picture));
    }
  }
}

TEST(hard_geometry, tangent_spheres) {
  // A large sphere with six small ones that touch it, all in a bright environment: nothing may be
  // darker than what its own albedo and half the sky make it, or brighter than the sky.
  Scene scene;
  scene.environment.radiance = Color(1.0f);
  add_sphere(scene, 1.0f, diffuse(Color(0.5f)), M44d());
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      V3d at(0.0);
      at[axis] = side * 1.25;
      add_sphere(scene, 0.25f, diffuse(Color(0.5f)), translation(at));
      at[axis] = side * (1.5 + 0.0625);
      add_sphere(scene, 0.0625f, diffuse(Color(0.5f)), translation(at));
    }
  }
  const Framebuffer picture =
      render_clean(scene, orthographic_camera({3, 2, 4}, {0, 0, 0}, 1.8f), square(64, 64));
  for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
    const float v = picture.beauty(i).x;
    EXPECT_LE(v, 1.1f);
    EXPECT_GT(v, 0.05f);
  }
  // White ones are invisible: in a white furnace all is white.
  for (Material& m : scene.materials) m.base_color = Color(1.0f);
  const Framebuffer white =
      render_clean(scene, orthographic_camera({3, 2, 4}, {0, 0, 0}, 1.8f), square(32, 256));
  expect_mean(mean_of(beauty(white)), 1.0);
}

TEST(hard_geometry, coplanar_and_degenerate_triangles) {
  const Mesh ground = quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0});
  Scene plain;
  add_mesh(plain, ground, diffuse(Color(0.5f)));
  plain.environment.radiance = Color(1.0f);
  Scene messy = plain;
  add_mesh(messy, ground, diffuse(Color(0.5f)));  // the same place
  Mesh junk;
  junk.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 0}, {0, 1, 0}};
  junk.triangles = {{0, 1, 2}, {0, 0, 0}, {0, 3, 4}, {0, 4, 3}};
  add_mesh(messy, junk, diffuse(Color(0.5f)));
  Material light = emitter(Color(1.0f), true);
  add_mesh(messy, junk, light);
  add_mesh(messy, Mesh(), light);
  const Camera camera = orthographic_camera({0, 1, 0.5}, {0.1, 0, 0.1}, 0.5f);
  const Framebuffer picture = render_clean(messy, camera, square(16, 64));
  expect_mean(mean_of(beauty(picture)), 0.5);
  expect_mean(mean_of(beauty(render_clean(plain, camera, square(16, 64)))), 0.5);
}

TEST(hard_geometry, mirrors_that_face_each_other) {
  for (const float reflectance : {0.3f, 0.9f}) {
    Scene scene;
    Material mirror = metal(Color(reflectance));
    mirror.emission = Color(1.0f);
    mirror.double_sided = true;
    add_mesh(scene, quad({-9, 0, -9}, {0, 0, 18}, {18, 0, 0}), mirror);
    add_mesh(scene, quad({-9, 1, -9}, {18, 0, 0}, {0, 0, 18}), mirror);
    const Framebuffer picture =
        render_clean(scene, orthographic_camera({0, 0.5, 0}, {0, 0, 0}, 0.1f), square(16, 256));
    expect_mean(mean_of(term(picture, Term::emitted)), 1.0);
    expect_mean(mean_of(term(picture, Term::specular)), reflectance / (1.0 - reflectance), 0.02);
  }
}

TEST(hard_geometry, grazing_view) {
  Scene scene;
  add_mesh(scene, quad({-50, 0, -50}, {0, 0, 100}, {100, 0, 0}), diffuse(Color(0.5f)));
  scene.environment.radiance = Color(1.0f);
  for (const double angle : {1.5, 1.57, 1.5706}) {
    const Camera camera =
        orthographic_camera(V3d(std::sin(angle), std::cos(angle), 0) * 10.0, {0, 0, 0}, 1e-4f);
    const Framebuffer picture = render_clean(scene, camera, square(16, 64));
    expect_mean(mean_of(term(picture, Term::direct)), 0.5);
    expect_black(term(picture, Term::emitted));
  }
}

// A large floor under small things: they stand on it without a gap of light.
TEST(hard_geometry, small_box_on_a_large_floor) {
  Scene scene;
  const double side = 1000.0;
  const auto s = static_cast<float>(side);
  add_mesh(scene, quad({-s, 0, -s}, {0, 0, 2 * s}, {2 * s, 0, 0}), diffuse(Color(0.5f)));
  add_mesh(scene, box({-0.1f, 0, -0.1f}, {0.1f, 0.2f, 0.1f}), diffuse(Color(0.0f)));
  Light light;
  light.intensity = Color(100.0f);
  light.object_to_world = translation({10, 10, 0});
  scene.lights = {light};
  // The shadow reaches from x = -0.1 to about -0.3; its root must not be lit.
  const Camera shadow = orthographic_camera({-0.15, 1, 0}, {-0.15, 0, 0}, 0.03f);
  expect_black(term(render_clean(scene, shadow, square(16, 4)), Term::direct));
}

}  // namespace
}  // namespace lumivec::test
