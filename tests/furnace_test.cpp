// A closed room whose walls all emit e and reflect ρ: every term is a part of a geometric series.
#include "test_scenes.h"

namespace lumivec::test {
namespace {

const Color emission(1.0f, 2.0f, 1e-6f);

Material wall(float albedo) {
  Material m = diffuse(Color(albedo));
  m.emission = emission;
  m.double_sided = true;
  return m;
}

void expect_series(const Scene& scene, float rho) {
  const Camera camera = perspective_camera({0.3, -0.2, 0.4}, {1.0, 0.5, -1.0}, 1.2);
  const Framebuffer picture = render_clean(scene, camera, square(16, 64));
  expect_black(term(picture, Term::specular));
  expect_black(term(picture, Term::caustic));
  for (int c = 0; c < 3; ++c) {
    const double e = emission[c];
    expect_mean(mean_of(term(picture, Term::emitted), c), e);
    expect_mean(mean_of(term(picture, Term::direct), c), rho * e);
    expect_mean(mean_of(term(picture, Term::indirect), c), rho * rho * e / (1.0 - rho), 0.015);
    expect_mean(mean_of(beauty(picture), c), e / (1.0 - rho), 0.015);
  }
}

class furnace : public testing::TestWithParam<float> {};
INSTANTIATE_TEST_SUITE_P(albedo, furnace, testing::Values(0.0f, 0.5f, 0.8f, 0.95f));

TEST_P(furnace, box) {
  Scene scene;
  add_mesh(scene, box({-1, -2, -1.5f}, {2, 1, 1}, true), wall(GetParam()));
  expect_series(scene, GetParam());
}

TEST_P(furnace, box_of_six_rectangles) {
  Scene scene;
  const Mesh all = box({-1, -2, -1.5f}, {2, 1, 1});
  for (std::size_t i = 0; i < all.triangles.size(); i += 2) {
    Mesh side = all;
    side.triangles = {all.triangles[i], all.triangles[i + 1]};
    add_mesh(scene, side, wall(GetParam()));
  }
  expect_series(scene, GetParam());
}

TEST_P(furnace, sphere) {
  Scene scene;
  add_sphere(scene, 2.0f, wall(GetParam()), translation({0.3, 0.1, -0.2}));
  expect_series(scene, GetParam());
}

TEST_P(furnace, ellipsoid) {
  Scene scene;
  add_sphere(scene, 1.0f, wall(GetParam()), scaling({2.0, 1.5, 3.0}));
  expect_series(scene, GetParam());
}

TEST_P(furnace, convex_object_in_a_bright_environment) {
  Scene scene;
  scene.environment.radiance = emission;
  add_sphere(scene, 1.0f, diffuse(Color(GetParam())), M44d());
  const Framebuffer picture =
      render_clean(scene, orthographic_camera({0, 0, 5}, {0, 0, 0}, 0.7f), square(24, 64));
  for (int c = 0; c < 3; ++c) {
    expect_mean(mean_of(term(picture, Term::direct), c), double(GetParam()) * emission[c]);
  }
  expect_black(term(picture, Term::emitted));
  expect_black(term(picture, Term::indirect));
}

// A white room without light, a white room whose light escapes nowhere but into the lamp: paths
// end.
TEST(white_room, paths_end) {
  Scene dark;
  add_mesh(dark, box({-1, -1, -1}, {1, 1, 1}, true), diffuse(Color(1.0f)));
  const Camera camera = perspective_camera({0.3, -0.2, 0.4}, {1.0, 0.5, -1.0}, 1.2);
  Framebuffer picture = render_clean(dark, camera, square(4, 4));
  expect_black(beauty(picture));

  Scene lit = dark;
  add_sphere(lit, 0.5f, emitter(Color(1.0f)), translation({0, 0.3, 0}));
  picture =
      render_clean(lit, perspective_camera({0.9, -0.9, 0.9}, {1, -1, 1}, 0.2), square(16, 512));
  // All light that ever comes back was emitted by the lamp: the room is as bright as it is.
  expect_mean(mean_of(beauty(picture)), 1.0, 0.01);
}

TEST(white_room, mirror_room_without_light_ends) {
  Scene scene;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}, true), metal(Color(1.0f)));
  const Framebuffer picture = render_clean(
      scene, perspective_camera({0.3, -0.2, 0.4}, {1.0, 0.5, -1.0}, 1.2), square(4, 4));
  expect_black(beauty(picture));
}

}  // namespace
}  // namespace lumivec::test
