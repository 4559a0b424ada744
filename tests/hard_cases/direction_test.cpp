// Light whose one direction says little: from opposite sides, from everywhere, along the surface.
#include "hard_case.h"

namespace lumivec::test {
namespace {

// Records reach a few pixels at least, over which light may change by more than is aimed at if
// pixels are much larger than these.
constexpr int size = 32;
const double aim = RenderSettings().cache_error;

class direction : public each_integrator {
 protected:
  // The mean of indirect light against the path tracer's.
  static void expect_reference(const std::string& name, const Scene& scene, const Camera& camera,
                               const std::string& defect = {}) {
    const Mean reference = mean_of_seeds(scene, camera, settings_for(Integrator::path, size, 16, 7),
                                         4, Term::indirect);
    const Mean mean = mean_of_seeds(
        scene, camera, settings_for(GetParam(), size, cached() ? 4 : 16), 4, Term::indirect);
    const double noise = std::hypot(reference.error, mean.error) / reference.value;
    const double error = std::abs(mean.value / reference.value - 1.0);
    if (defect.empty()) {
      EXPECT_LT(noise, 0.01) << "too noisy to tell";
      expect_error(name, error, sigmas * noise + (cached() ? aim : 0.0));
    } else {
      // Its own noise is what the cache may not have: no room for it.
      const double allowed =
          cached() ? sigmas * reference.error / reference.value + aim : sigmas * noise;
      expect_error_unless_known(name, error, allowed, defect);
    }
  }
};
INSTANTIATE_TEST_SUITE_P(of, direction, integrators, integrator_name);

// A floor between two low walls that are lit from above: its light comes along the floor, from both
// sides, and cancels in the sum of directions but for the little that comes down. Where normals
// lean to one side, it does not cancel.
Scene between_walls(float height, bool leaning) {
  Scene scene;
  Mesh floor = quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  if (leaning) floor.normals.assign(4, V3f(0.5f, 1, 0).normalized());
  add_mesh(scene, floor, diffuse(Color(0.5f)));
  const Material wall = diffuse(Color(0.9f));
  add_mesh(scene, quad({-1.2f, 0, -1}, {0, height, 0}, {0, 0, 2}), wall);
  add_mesh(scene, quad({1.2f, 0, -1}, {0, 0, 2}, {0, height, 0}), wall);
  for (const double side : {-1.0, 1.0}) {
    Light light;
    light.kind = LightKind::directional;
    light.object_to_world = look_at({-side, 1, 0}, {0, 0, 0}, {0, 0, 1});
    scene.lights.push_back(light);
  }
  return scene;
}

const Camera above = orthographic_camera({0, 3, 0}, {0, 0, 0}, 0.9f);

TEST_P(direction, opposite_sides) {
  expect_reference("light from opposite sides", between_walls(0.5f, false), above);
}

TEST_P(direction, opposite_sides_and_leaning_normals) {
  expect_reference("light from opposite sides, normals leaning", between_walls(0.5f, true), above);
}

// Walls so low that a hemisphere of paths meets them a few times.
TEST_P(direction, opposite_sides_low) {
  expect_reference("light from low opposite sides", between_walls(0.2f, false), above);
}

// Walls so low that it may miss them.
TEST_P(direction, opposite_sides_lowest) {
  expect_reference("light from lowest opposite sides", between_walls(0.05f, false), above,
                   "paths that leave evenly in all directions miss a low, small source too often");
}

// In a room that is equally bright everywhere, spheres with normals that disagree with their facets
// are as bright as all else: no light is lost, and none is won, by leaning normals. Facets are lit
// by what is above them; coarse ones show both ways.
TEST_P(direction, from_everywhere_on_a_coarse_mesh) {
  Material wall = diffuse(Color(0.5f));
  wall.emission = Color(1.0f);
  Scene scene;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}, true), wall);
  add_mesh(scene, icosphere(0.5f, 1, true), wall);
  const Camera camera = perspective_camera({0.2, 0.3, 0.95}, {0, 0, 0}, 0.8);
  expect_reference("light from everywhere, normals leaning", scene, camera);
}

// Direct light that just skims the floor, by Lambert's cosine; and what it throws up a wall.
TEST_P(direction, grazing_light) {
  Scene scene;
  add_mesh(scene, quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}), diffuse(Color(0.5f)));
  Light light;
  light.kind = LightKind::directional;
  light.intensity = Color(1e3f);
  const double elevation = 1e-3;
  light.object_to_world =
      look_at({std::cos(elevation), std::sin(elevation), 0}, {0, 0, 0}, {0, 0, 1});
  scene.lights = {light};
  const Framebuffer bare = render_case(scene, above, settings_for(GetParam(), size, 4));
  expect_black(term(bare, Term::indirect));
  expect_error("grazing light, direct",
               largest_error(term(bare, Term::direct), 0.5 / pi * 1e3 * std::sin(elevation)), 1e-3);

  // The light meets a wall at right angles; the floor gets that back.
  add_mesh(scene, quad({-1, 0, -1}, {0, 1, 0}, {0, 0, 2}), diffuse(Color(0.5f)));
  expect_reference("grazing light, indirect", scene, above);
}

}  // namespace
}  // namespace lumivec::test
