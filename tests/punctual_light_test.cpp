// Lights without extent that fade, narrow and cast shadows in ways of their own.
#include <cmath>

#include "integrator/lights.h"
#include "test_scenes.h"

namespace lumivec::test {
namespace {

// A light at (0, 2, 0) that shines down, above a floor of reflectance 1: its radiance at x from the
// middle is the illuminance by π.
Light light_above(LightKind kind) {
  Light light;
  light.kind = kind;
  light.intensity = Color(static_cast<float>(pi));
  light.object_to_world = look_at({0, 2, 0}, {0, 0, 0}, {0, 0, -1});
  return light;
}

Scene floor_under(const Light& light) {
  Scene scene;
  add_mesh(scene, quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}), diffuse(Color(1.0f)));
  scene.lights = {light};
  return scene;
}

// Of a small patch of the floor.
double radiance_at(const Scene& scene, double x) {
  const Framebuffer picture =
      render_clean(scene, orthographic_camera({x, 1, 0}, {x, 0, 0}, 1e-3f), square(4, 16));
  return mean_of(term(picture, Term::direct)).value;
}

double smooth(double t) {
  t = std::clamp(t, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

TEST(punctual_light, fades_by_the_formula) {
  for (const auto& [distance, power] : {std::pair(1.0f, 0.0f), {1.0f, 2.0f}, {1.5f, 3.0f}}) {
    Light light = light_above(LightKind::point);
    light.fade_distance = distance;
    light.fade_power = power;
    const Scene scene = floor_under(light);
    for (const double x : {0.0, 0.7, 1.95}) {
      const double d = std::hypot(x, 2.0);
      const double expected = 2.0 / (1.0 + std::pow(d / double(distance), double(power))) * 2.0 / d;
      EXPECT_NEAR(radiance_at(scene, x), expected, 2e-3 * expected) << power << " at " << x;
    }
  }
}

TEST(punctual_light, spots_narrow_within_their_cone) {
  Light light = light_above(LightKind::spot);
  light.fade_distance = 1.0f;
  light.inner_cone = static_cast<float>(pi / 12);
  light.outer_cone = static_cast<float>(pi / 6);
  light.smooth_edge = true;
  light.tightness = 10.0f;
  const Scene scene = floor_under(light);
  for (const double x : {0.1, 0.5, 0.8, 1.0}) {
    const double cosine = 2.0 / std::hypot(x, 2.0);
    const double ramp = (cosine - std::cos(pi / 6)) / (std::cos(pi / 12) - std::cos(pi / 6));
    const double expected = cosine * std::pow(cosine, 10.0) * smooth(ramp);
    EXPECT_NEAR(radiance_at(scene, x), expected, 3e-3) << x;
  }
  EXPECT_EQ(radiance_at(scene, 1.2), 0.0);
}

TEST(punctual_light, beams_are_parallel_and_end) {
  Light light = light_above(LightKind::beam);
  light.fade_distance = 1.0f;
  light.inner_radius = 0.5f;
  light.outer_radius = 1.0f;
  const Scene even = floor_under(light);
  light.tightness = 3.0f;
  const Scene tight = floor_under(light);
  for (const double x : {0.1, 0.4, 0.6, 0.9}) {
    const double edge = smooth((1.0 - x) / 0.5);
    EXPECT_NEAR(radiance_at(even, x), edge, 3e-3) << x;
    EXPECT_NEAR(radiance_at(tight, x), edge * std::pow(1.0 - x, 3.0), 3e-3) << x;
  }
  EXPECT_EQ(radiance_at(even, 1.05), 0.0);
  // Nothing behind where it starts.
  light.object_to_world = look_at({0, -1, 0}, {0, -2, 0}, {0, 0, -1});
  EXPECT_EQ(radiance_at(floor_under(light), 0.2), 0.0);
}

// Half of the area is hidden behind a screen's edge at (0, 1, 0), as seen from the floor's middle.
TEST(punctual_light, shadows_alone_are_those_of_an_area) {
  for (const bool round : {false, true}) {
    Light light = light_above(LightKind::point);
    light.fade_distance = 1.0f;
    light.shadow_u = V3f(0.5f, 0, 0);
    light.shadow_v = V3f(0, 0, 0.5f);
    light.round_shadows = round;
    Scene scene = floor_under(light);
    EXPECT_NEAR(radiance_at(scene, 0.0), 1.0, 1e-3);
    add_mesh(scene, quad({0, 1.2f, 2}, {3, 0, 0}, {0, 0, -4}), diffuse(Color(0.0f)));
    EXPECT_NEAR(radiance_at(scene, 0.0), 0.5, 0.03) << round;
    // At x the edge hides what lies beyond x - x · 2 / 1.2 of the middle.
    const double x = 0.15, from = x * (1.0 - 2.0 / 1.2) / 0.5;
    const double share = round ? 0.5 + (std::asin(from) + from * std::sqrt(1.0 - from * from)) / pi
                               : 0.5 + 0.5 * from;
    EXPECT_NEAR(radiance_at(scene, x), share * 2.0 / std::hypot(x, 2.0), 0.03) << round;
    scene.lights[0].casts_shadows = false;
    EXPECT_NEAR(radiance_at(scene, 0.0), 1.0, 1e-3);
  }
}

}  // namespace
}  // namespace lumivec::test
