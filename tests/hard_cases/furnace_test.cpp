// Closed rooms and open skies whose every point is as bright as every other: infinite series in
// closed form.
#include "hard_case.h"

namespace lumivec::test {
namespace {

constexpr int size = 16;
// What cached light may be off by: the error that is aimed at by default.
const double aim = RenderSettings().cache_error;

class closed_form : public each_integrator {
 protected:
  // The picture's mean against what all its pixels ought to be, with room for its noise and, if
  // cached, for the error that is aimed at.
  static void expect_level(const std::string& name, const std::vector<Color>& pixels,
                           double expected) {
    const double allowed =
        sigmas * mean_of(pixels).error / expected + rounding + (cached() ? aim : 0.0);
    EXPECT_LT(allowed, 0.025) << "too noisy to tell";
    expect_error(name, mean_error(pixels, expected), allowed);
  }

  // A room whose walls emit 1 and reflect a share.
  static void expect_room(const std::string& name, float albedo, int samples) {
    Material wall = diffuse(Color(albedo));
    wall.emission = Color(1.0f);
    Scene scene;
    add_mesh(scene, box({-1, -2, -1.5f}, {2, 1, 1}, true), wall);
    const Camera camera = perspective_camera({0.3, -0.2, 0.4}, {1.0, 0.5, -1.0}, 1.2);
    const Framebuffer picture = render_case(scene, camera, settings_for(GetParam(), size, samples));
    const double rho = albedo;
    if (albedo == 0.0f) {
      expect_black(term(picture, Term::indirect));
    } else {
      expect_level(name + ", indirect", term(picture, Term::indirect), rho * rho / (1.0 - rho));
    }
    expect_level(name + ", sum", beauty(picture), 1.0 / (1.0 - rho));
  }
};
INSTANTIATE_TEST_SUITE_P(of, closed_form, integrators, integrator_name);

TEST_P(closed_form, black_room) {
  expect_room("room of albedo 0", 0.0f, 4);
}

TEST_P(closed_form, grey_room) {
  expect_room("room of albedo 0.5", 0.5f, 64);
}

TEST_P(closed_form, pale_room) {
  expect_room("room of albedo 0.95", 0.95f, 32);
}

// All light that ever comes back was emitted by the lamp: the room is as bright as the lamp.
TEST_P(closed_form, white_room) {
  Scene scene;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}, true), diffuse(Color(1.0f)));
  add_sphere(scene, 0.5f, emitter(Color(1.0f)), translation({0, 0.3, 0}));
  const Camera camera = perspective_camera({0.9, -0.9, 0.9}, {-1, -0.4, -1}, 1.2);
  const Framebuffer picture = render_case(scene, camera, settings_for(GetParam(), size, 128));
  expect_level("room of albedo 1 with a lamp, sum", beauty(picture), 1.0);
}

// White things under a white sky cannot be seen, down to the points where they touch.
TEST_P(closed_form, tangent_spheres) {
  Scene scene;
  scene.environment.radiance = Color(1.0f);
  add_sphere(scene, 1.0f, diffuse(Color(1.0f)), M44d());
  for (int axis = 0; axis < 3; ++axis) {
    V3d at(0.0);
    at[axis] = 1.25;
    add_sphere(scene, 0.25f, diffuse(Color(1.0f)), translation(at));
    at[axis] = 1.5 + 0.0625;
    add_sphere(scene, 0.0625f, diffuse(Color(1.0f)), translation(at));
  }
  const Framebuffer picture = render_case(scene, orthographic_camera({3, 2, 4}, {0, 0, 0}, 1.8f),
                                          settings_for(GetParam(), size, 64));
  expect_level("white tangent spheres under a white sky", beauty(picture), 1.0);
}

// Two parallel mirrors close a room of emitting walls: everything is as bright as without them.
TEST_P(closed_form, mirrors_that_face_each_other) {
  Material wall = diffuse(Color(0.5f));
  wall.emission = Color(1.0f);
  Scene scene;
  const Mesh all = box({-1, -1, -1}, {1, 1, 1}, true);
  // The box has its sides in pairs: z, y, x.
  for (std::size_t i = 0; i < all.triangles.size(); i += 2) {
    Mesh side = all;
    side.triangles = {all.triangles[i], all.triangles[i + 1]};
    add_mesh(scene, side, i >= 8 ? metal(Color(1.0f)) : wall);
  }
  const Camera camera = perspective_camera({0.2, 0.1, 0.9}, {0.5, -0.2, -1}, 1.3);
  const Framebuffer picture = render_case(scene, camera, settings_for(GetParam(), size, 128));
  expect_level("mirrors facing each other, sum", beauty(picture), 2.0);
}

// From the middle of a ball of glass no ray is reflected totally: all come from the walls, and the
// radiance inside is n² times that outside.
TEST_P(closed_form, camera_inside_glass) {
  Material wall = diffuse(Color(0.5f));
  wall.emission = Color(1.0f);
  Scene scene;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}, true), wall);
  add_sphere(scene, 0.4f, glass(1.5f), M44d());
  const Camera camera = perspective_camera({0.05, 0.02, 0.03}, {0.5, -0.2, -1}, 1.3);
  const Framebuffer picture = render_case(scene, camera, settings_for(GetParam(), size, 128));
  expect_level("camera inside glass, sum", beauty(picture), 2.0 * 1.5 * 1.5);
}

}  // namespace
}  // namespace lumivec::test
