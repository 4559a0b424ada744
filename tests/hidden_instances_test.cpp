// Instances that the eye, mirrors or the shadows of lamps know nothing of.
#include "test_scenes.h"

namespace lumivec::test {
namespace {

enum class Form { mesh, ball, ellipsoid };

// A white floor under a lamp, and something black halfway between them.
Scene floor_and_screen(Form form) {
  Scene scene;
  add_mesh(scene, quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), diffuse(Color(1.0f)));
  const Material black = diffuse(Color(0.0f));
  if (form == Form::mesh)
    add_mesh(scene, box({-1, 1, -1}, {1, 1.5f, 1}), black);
  else if (form == Form::ball)
    add_sphere(scene, 0.4f, black, translation({0, 1.2, 0}));
  else
    add_sphere(scene, 0.4f, black, scaling({2, 1, 1.5}) * translation({0, 1.2, 0}));
  Light lamp;
  lamp.intensity = Color(static_cast<float>(pi));
  lamp.fade_distance = 1.0f;
  lamp.object_to_world = translation({0, 3, 0});
  scene.lights = {lamp};
  return scene;
}

double direct_light(const Scene& scene, const Camera& camera) {
  return mean_of(term(render_clean(scene, camera, square(4, 16)), Term::direct)).value;
}

const Camera& from_below() {
  static const Camera camera = orthographic_camera({0, 0.5, 0}, {0, 0, 0}, 1e-3f);
  return camera;
}

const Camera& from_above() {
  static const Camera camera = orthographic_camera({0, 2.5, 0}, {0, 0, 0}, 1e-3f);
  return camera;
}

TEST(hidden_instances, cast_no_shadow) {
  for (const Form form : {Form::mesh, Form::ball, Form::ellipsoid}) {
    Scene scene = floor_and_screen(form);
    EXPECT_EQ(direct_light(scene, from_below()), 0.0);
    scene.instances[1].casts_shadows = false;
    EXPECT_NEAR(direct_light(scene, from_below()), 1.0, 1e-3);
    EXPECT_EQ(direct_light(scene, from_above()), 0.0);  // it is seen all the same
  }
}

TEST(hidden_instances, are_not_seen_by_the_eye) {
  for (const Form form : {Form::mesh, Form::ball, Form::ellipsoid}) {
    Scene scene = floor_and_screen(form);
    scene.instances[1].casts_shadows = false;
    scene.instances[1].seen_by_eye = false;
    EXPECT_NEAR(direct_light(scene, from_above()), 1.0, 1e-3);
    // Its shadow is there all the same.
    scene.instances[1].casts_shadows = true;
    EXPECT_EQ(direct_light(scene, from_above()), 0.0);
  }
}

// A mirror shows the lamp's glow, unless something stands before that.
TEST(hidden_instances, are_not_seen_in_mirrors) {
  for (const Form form : {Form::mesh, Form::ball, Form::ellipsoid}) {
    for (const bool path : {true, false}) {
      Scene scene = floor_and_screen(form);
      scene.lights.clear();
      scene.materials[0] = metal(Color(1.0f));
      add_mesh(scene, quad({-5, 4, -5}, {10, 0, 0}, {0, 0, 10}), emitter(Color(2.0f), true));
      const auto mirrored = [&] {
        RenderSettings settings = square(4, 16);
        settings.integrator = path ? Integrator::path : Integrator::light_vectors;
        const Framebuffer picture = render_clean(scene, from_below(), settings);
        return mean_of(term(picture, Term::specular)).value;
      };
      EXPECT_EQ(mirrored(), 0.0);
      scene.instances[1].seen_by_eye = false;
      EXPECT_EQ(mirrored(), 0.0);
      scene.instances[1].seen_in_reflections = false;
      EXPECT_NEAR(mirrored(), 2.0, 1e-2);
    }
  }
}

}  // namespace
}  // namespace lumivec::test
