#include "integrator/wide_lens.h"

#include <gtest/gtest.h>

#include <cmath>

#include "integrator/camera_view.h"
#include "test_scenes.h"

namespace lumivec::test {
namespace {

constexpr CameraKind wide_kinds[] = {CameraKind::fisheye,          CameraKind::spherical,
                                     CameraKind::ultra_wide,       CameraKind::panoramic,
                                     CameraKind::upright_cylinder, CameraKind::lying_cylinder};

Camera wide_camera(CameraKind kind) {
  Camera camera;
  camera.kind = kind;
  camera.xangle = 2.5f;
  camera.yangle = 1.75f;
  camera.xmag = 0.6f;
  camera.ymag = 0.45f;
  return camera;
}

void expect_direction(const WideLens& lens, const V2d& at, const V3d& expected) {
  V3d direction;
  ASSERT_TRUE(lens.direction(at, direction));
  EXPECT_LT((direction - expected.normalized()).length(), 1e-6)
      << at << ": " << direction << " and not " << expected.normalized();
}

TEST(wide_lens, fisheye) {
  Camera camera = wide_camera(CameraKind::fisheye);
  camera.xangle = camera.yangle = static_cast<float>(pi * 200.0 / 180.0);
  const WideLens lens(camera, 2.0);
  const double a = pi * 100.0 / 180.0;
  expect_direction(lens, V2d(0.0), V3d(0, 0, -1));
  // The width is twice the height: a quarter of it to the right is as far as half of the height up.
  expect_direction(lens, V2d(0.25 - 1e-9, 0.0), V3d(std::sin(a), 0, -std::cos(a)));
  expect_direction(lens, V2d(0.0, 0.25), V3d(0, std::sin(a / 2), -std::cos(a / 2)));
  V3d nowhere;
  EXPECT_FALSE(lens.direction(V2d(0.26, 0.0), nowhere));
  EXPECT_FALSE(lens.direction(V2d(0.2, 0.4), nowhere));
}

TEST(wide_lens, spherical) {
  Camera camera = wide_camera(CameraKind::spherical);
  camera.xangle = static_cast<float>(2.0 * pi);
  camera.yangle = static_cast<float>(pi);
  const WideLens lens(camera, 0.3);  // whatever the picture's shape
  expect_direction(lens, V2d(0.0), V3d(0, 0, -1));
  expect_direction(lens, V2d(0.25, 0.0), V3d(1, 0, 0));
  expect_direction(lens, V2d(0.5, 0.0), V3d(0, 0, 1));
  expect_direction(lens, V2d(-0.125, 0.25), V3d(-0.5, std::sqrt(0.5), -0.5));
}

// Found by rays through POV-Ray's own cameras at the corner pixels of its pictures.
TEST(wide_lens, agrees_with_povray) {
  struct Case {
    CameraKind kind;
    double xangle, yangle, xmag, ymag;
    V2d at;
    V3d expected;
  };
  const double degree = pi / 180.0;
  const V2d corner(0.5 - 0.5 / 90, 0.5 - 0.5 / 60);
  const Case cases[] = {
      {CameraKind::ultra_wide, 120, 80, 1, 1, corner, {0.7552, 0.5565, -0.3464}},
      {CameraKind::panoramic, 1, 1, 0.75, 0.5, corner, {0.0392, 0.9992, -0.0004}},
      {CameraKind::upright_cylinder, 120, 1, 1, 0.5, corner, {0.7719, 0.4412, -0.4577}},
      {CameraKind::lying_cylinder, 1, 120, 0.75, 1, corner, {0.5957, 0.6885, -0.4137}},
      {CameraKind::spherical, 100, 50, 1, 1, {0.49375, 0.4875}, {0.6913, 0.4127, -0.5931}},
  };
  for (const Case& c : cases) {
    Camera camera;
    camera.kind = c.kind;
    camera.xangle = static_cast<float>(c.xangle * degree);
    camera.yangle = static_cast<float>(c.yangle * degree);
    camera.xmag = static_cast<float>(c.xmag);
    camera.ymag = static_cast<float>(c.ymag);
    V3d direction;
    ASSERT_TRUE(WideLens(camera, 1.5).direction(c.at, direction));
    EXPECT_LT((direction - c.expected).length(), 1.5e-4)
        << camera_kind_name(c.kind) << ": " << direction << " and not " << c.expected;
  }
}

TEST(wide_lens, finds_directions_again) {
  for (const CameraKind kind : wide_kinds) {
    const WideLens lens(wide_camera(kind), 1.4);
    int found = 0;
    for (double x = -0.48; x < 0.49; x += 0.06) {
      for (double y = -0.48; y < 0.49; y += 0.06) {
        V3d direction;
        if (!lens.direction(V2d(x, y), direction)) continue;
        V2d at;
        ASSERT_TRUE(lens.project(direction, at)) << camera_kind_name(kind) << " " << V2d(x, y);
        EXPECT_LT((at - V2d(x, y)).length(), 1e-6) << camera_kind_name(kind);
        ++found;
      }
    }
    EXPECT_GT(found, 150) << camera_kind_name(kind);
  }
}

// A picture of everything takes in a sphere; of less, what the closed forms say.
TEST(wide_lens, solid_angles_add_up) {
  const auto whole = [](const Camera& camera) {
    const WideLens lens(camera, 1.0);
    constexpr int n = 200;
    double sum = 0.0;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j)
        sum += lens.solid_angle(V2d((i + 0.5) / n - 0.5, (j + 0.5) / n - 0.5));
    }
    return sum / (n * n);
  };
  Camera camera = wide_camera(CameraKind::spherical);
  camera.xangle = static_cast<float>(2.0 * pi);
  camera.yangle = static_cast<float>(pi);
  EXPECT_NEAR(whole(camera), 4.0 * pi, 1e-3);
  camera.kind = CameraKind::fisheye;
  camera.xangle = camera.yangle = static_cast<float>(pi);
  EXPECT_NEAR(whole(camera), 2.0 * pi, 0.02);  // the circle's edge goes through pixels
  camera.kind = CameraKind::upright_cylinder;
  camera.xangle = 2.0f;
  camera.ymag = 0.75f;
  EXPECT_NEAR(whole(camera), 2.0 * 2.0 * 0.75 / std::hypot(1.0, 0.75), 1e-3);
}

// The eye's rays lead to what project() says, with an importance that makes every pixel's sum one.
TEST(wide_lens, views_project_what_their_rays_see) {
  Scene scene;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}), diffuse(Color(0.5f)), M44d());
  const TracedScene traced(scene, 1);
  for (const CameraKind kind : wide_kinds) {
    Camera camera = wide_camera(kind);
    camera.camera_to_world = rotation({0, 1, 0}, 0.7) * translation({1, 2, 3});
    const CameraView view(camera, traced, 140, 100);
    for (const V2f& at : {V2f(70, 50), V2f(40.5f, 30.5f), V2f(99.5f, 61.5f)}) {
      const CameraRay ray = view.ray(at.x, at.y);
      ASSERT_FALSE(ray.black);
      constexpr float far = 5.0f;
      const V3f seen = ray.origin + ray.direction * far;
      V2f pixel;
      V3f to_eye;
      float distance, importance;
      ASSERT_TRUE(view.project(seen, pixel, to_eye, distance, importance));
      EXPECT_LT((pixel - at).length(), 1e-3f) << camera_kind_name(kind);
      EXPECT_LT((to_eye + ray.direction).length(), 1e-5f);
      EXPECT_NEAR(distance, far, 1e-4f);
      EXPECT_NEAR(view.depth(seen), far, 1e-4f);
      const V3f right = view.ray(at.x + 0.5f, at.y).direction,
                left = view.ray(at.x - 0.5f, at.y).direction;
      const V3f below = view.ray(at.x, at.y + 0.5f).direction,
                above = view.ray(at.x, at.y - 0.5f).direction;
      const float solid_angle = (right - left).cross(below - above).length();
      EXPECT_NEAR(importance * solid_angle * far * far, 1.0f, 3e-3f) << camera_kind_name(kind);
    }
    const float across = (view.ray(70, 50.5f).direction - view.ray(70, 49.5f).direction).length();
    EXPECT_NEAR(view.footprint(3.0f), 3.0f * across, 1e-3f * 3.0f * across);
  }
}

TEST(wide_lens, a_perspective_camera_stands_for_it) {
  Camera camera = wide_camera(CameraKind::fisheye);
  camera.yfov = 1.25f;
  EXPECT_TRUE(is_wide(camera));
  EXPECT_EQ(flat_camera(camera).kind, CameraKind::perspective);
  EXPECT_EQ(flat_camera(camera).yfov, 1.25f);
  camera.kind = CameraKind::orthographic;
  EXPECT_FALSE(is_wide(camera));
  EXPECT_EQ(flat_camera(camera).kind, CameraKind::orthographic);
}

}  // namespace
}  // namespace lumivec::test
