#include <cmath>

#include "integrator/camera_view.h"
#include "test_scenes.h"

namespace lumivec::test {
namespace {

// A scene whose traced space is far from the world's origin.
Scene far_scene() {
  Scene scene;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}), diffuse(Color(0.5f)),
           translation({1000, -2000, 500}));
  return scene;
}

V3d in_world(const V3f& p, const TracedScene& scene) {
  return V3d(p) + scene.origin();
}

TEST(camera, looks_along_minus_z) {
  const Scene scene = far_scene();
  const TracedScene traced(scene, 1);
  Camera camera;
  camera.yfov = static_cast<float>(pi / 2);
  camera.camera_to_world = translation({1000, -2000, 510});
  const CameraView view(camera, traced, 200, 100);
  const CameraRay middle = view.ray(100, 50);
  EXPECT_LT((middle.direction - V3f(0, 0, -1)).length(), 1e-6f);
  EXPECT_LT((in_world(middle.origin, traced) - V3d(1000, -2000, 510)).length(), 1e-4);
  // The vertical field of view is the camera's, the horizontal one follows: row 0 is on top.
  EXPECT_LT((view.ray(100, 0).direction - V3f(0, 1, -1).normalized()).length(), 1e-6f);
  EXPECT_LT((view.ray(100, 100).direction - V3f(0, -1, -1).normalized()).length(), 1e-6f);
  EXPECT_LT((view.ray(0, 50).direction - V3f(-2, 0, -1).normalized()).length(), 1e-6f);
  EXPECT_LT((view.ray(200, 50).direction - V3f(2, 0, -1).normalized()).length(), 1e-6f);
}

TEST(camera, orthographic) {
  const Scene scene = far_scene();
  const TracedScene traced(scene, 1);
  Camera camera = orthographic_camera({1000, -2000, 510}, {1000, -2000, 500}, 3.0f);
  const CameraView view(camera, traced, 200, 100);
  for (const V2f& at : {V2f(0, 0), V2f(37, 81), V2f(200, 100)}) {
    const CameraRay ray = view.ray(at.x, at.y);
    EXPECT_LT((ray.direction - V3f(0, 0, -1)).length(), 1e-6f);
    const V3d expected(1000 + (at.x / 100.0 - 1.0) * 6.0, -2000 + (1.0 - at.y / 50.0) * 3.0, 510);
    EXPECT_LT((in_world(ray.origin, traced) - expected).length(), 1e-4);
  }
}

TEST(camera, scale_is_ignored_and_rotation_is_not) {
  const Scene scene = far_scene();
  const TracedScene traced(scene, 1);
  Camera camera;
  camera.camera_to_world = scaling(V3d(7.0)) * rotation({0, 1, 0}, pi / 2);
  const CameraView view(camera, traced, 100, 100);
  EXPECT_LT((view.ray(50, 50).direction - V3f(-1, 0, 0)).length(), 1e-6f);
}

Camera some_camera(CameraKind kind) {
  Camera camera;
  camera.kind = kind;
  camera.yfov = 0.9f;
  camera.ymag = 2.5f;
  camera.camera_to_world = look_at({1003, -1996, 507}, {1000, -2000, 500}, {0.1, 1, 0.2});
  return camera;
}

TEST(camera, projects_what_it_shoots) {
  const Scene scene = far_scene();
  const TracedScene traced(scene, 1);
  for (const CameraKind kind : {CameraKind::perspective, CameraKind::orthographic}) {
    const CameraView view(some_camera(kind), traced, 160, 90);
    for (const V2f& at : {V2f(80, 45), V2f(1, 1), V2f(158.5f, 2.25f), V2f(33, 88)}) {
      const CameraRay ray = view.ray(at.x, at.y);
      for (const float distance : {0.5f, 8.0f, 200.0f}) {
        V2f pixel;
        V3f to_eye;
        float found = 0.0f, importance = 0.0f;
        const V3f p = ray.origin + ray.direction * distance;
        ASSERT_TRUE(view.project(p, pixel, to_eye, found, importance));
        EXPECT_NEAR(pixel.x, at.x, 2e-3f);
        EXPECT_NEAR(pixel.y, at.y, 2e-3f);
        EXPECT_NEAR(found, distance, 1e-4f * distance + 1e-5f);
        EXPECT_LT((to_eye + ray.direction).length(), 1e-4f);
        EXPECT_NEAR(view.depth(p), distance * ray.direction.dot(view.ray(80, 45).direction),
                    1e-4f * distance);
      }
    }
  }
}

TEST(camera, does_not_project_what_it_cannot_see) {
  const Scene scene = far_scene();
  const TracedScene traced(scene, 1);
  for (const CameraKind kind : {CameraKind::perspective, CameraKind::orthographic}) {
    Camera camera = some_camera(kind);
    camera.znear = 1.0f;
    camera.zfar = 10.0f;
    const CameraView view(camera, traced, 160, 90);
    const CameraRay middle = view.ray(80, 45), outside = view.ray(-1, 45);
    V2f pixel;
    V3f to_eye;
    float distance, importance;
    const auto sees = [&](const V3f& p) {
      return view.project(p, pixel, to_eye, distance, importance);
    };
    EXPECT_TRUE(sees(middle.origin + middle.direction * 5.0f));
    EXPECT_FALSE(sees(middle.origin - middle.direction * 5.0f));
    EXPECT_FALSE(sees(middle.origin + middle.direction * 0.9f));
    EXPECT_FALSE(sees(middle.origin + middle.direction * 10.1f));
    EXPECT_FALSE(sees(outside.origin + outside.direction * 5.0f));
  }
}

// A surface of radiance 1 that covers a pixel brings it 1: ∫ importance · cosθ dA over what the
// pixel sees.
TEST(camera, importance_is_normalised) {
  const Scene scene = far_scene();
  const TracedScene traced(scene, 1);
  for (const CameraKind kind : {CameraKind::perspective, CameraKind::orthographic}) {
    const CameraView view(some_camera(kind), traced, 160, 90);
    // A tilted plane through a point in front of the eye.
    const CameraRay middle = view.ray(80, 45);
    const V3f at = middle.origin + middle.direction * 6.0f;
    const V3f normal = (V3f(0.3f, 0.2f, 0.1f) - middle.direction).normalized();
    const auto on_plane = [&](float x, float y) {
      const CameraRay ray = view.ray(x, y);
      return ray.origin +
             ray.direction * ((at - ray.origin).dot(normal) / ray.direction.dot(normal));
    };
    for (const V2f& corner : {V2f(80, 45), V2f(5, 70), V2f(150, 3)}) {
      const V3f a = on_plane(corner.x, corner.y), b = on_plane(corner.x + 1, corner.y),
                c = on_plane(corner.x + 1, corner.y + 1), d = on_plane(corner.x, corner.y + 1);
      const float area = 0.5f * (c - a).cross(d - b).length();
      V2f pixel;
      V3f to_eye;
      float distance, importance;
      ASSERT_TRUE(view.project(on_plane(corner.x + 0.5f, corner.y + 0.5f), pixel, to_eye, distance,
                               importance));
      EXPECT_NEAR(importance * std::abs(to_eye.dot(normal)) * area, 1.0f, 5e-3f);
    }
  }
}

TEST(camera, near_and_far) {
  Scene scene;
  add_mesh(scene, quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), emitter(Color(1.0f)));
  add_mesh(scene, quad({-9, -9, -4}, {18, 0, 0}, {0, 18, 0}), emitter(Color(2.0f)));
  scene.environment.radiance = Color(3.0f);
  for (const CameraKind kind : {CameraKind::perspective, CameraKind::orthographic}) {
    Camera camera;
    camera.kind = kind;
    camera.yfov = 1.5f;
    const auto all_show = [&](float radiance) {
      for (const Color& c : beauty(render_clean(scene, camera, square(8, 1)))) {
        if (c.x != radiance) return false;
      }
      return true;
    };
    EXPECT_TRUE(all_show(1.0f));
    // Both are distances along the view axis, in the corners too.
    camera.znear = 2.01f;
    EXPECT_TRUE(all_show(2.0f));
    camera.zfar = 3.99f;
    EXPECT_TRUE(all_show(3.0f));
    camera.znear = 1.99f;
    EXPECT_TRUE(all_show(1.0f));
  }
}

// What the eye sees of depth, position, normal and object.
TEST(camera, first_hits) {
  Scene scene;
  add_mesh(scene, quad({0, -9, -4}, {9, 0, 0}, {0, 18, 0}), diffuse(Color(0.25f, 0.5f, 1.0f)),
           translation({1000, 0, 0}));
  Camera camera;
  camera.camera_to_world = translation({1000, 0, 0});
  const Framebuffer picture = render_clean(scene, camera, square(8, 4));
  const std::size_t left = 8 * 4, right = 8 * 4 + 7;
  EXPECT_EQ(picture.object[left], -1);
  EXPECT_EQ(picture.depth[left], std::numeric_limits<float>::infinity());
  EXPECT_EQ(picture.object[right], 0);
  EXPECT_NEAR(picture.depth[right], 4.0f, 1e-5f);
  EXPECT_NEAR(picture.position[right].z, -4.0f, 1e-5f);
  EXPECT_GT(picture.position[right].x, 1000.0f);
  EXPECT_LT((picture.normal[right] - V3f(0, 0, 1)).length(), 1e-6f);
  EXPECT_EQ(picture.albedo[right], Color(0.25f, 0.5f, 1.0f));
  EXPECT_EQ(picture.samples[right], 4u);
}

}  // namespace
}  // namespace lumivec::test
