#include "viewer/window/orbit_camera.h"

#include <gtest/gtest.h>

#include "test_scenes.h"

namespace lumivec::test {
namespace {

constexpr double exact = 1e-9;

OrbitCamera camera_at(const V3d& eye, const V3d& target) {
  OrbitCamera camera;
  camera.take(perspective_camera(eye, target, 0.7), target);
  return camera;
}

void expect_near(const V3d& a, const V3d& b, double tolerance = exact) {
  EXPECT_NEAR((a - b).length(), 0.0, tolerance) << a << " against " << b;
}

void expect_right_angles(const OrbitCamera& camera) {
  EXPECT_NEAR(camera.right().length(), 1.0, exact);
  EXPECT_NEAR(camera.up().length(), 1.0, exact);
  expect_near(camera.right().cross(camera.up()), -camera.forward());
}

// Where the picture shows a place: shares of half the picture's height from its middle.
V2f seen_at(const OrbitCamera& camera, const V3d& place) {
  const V3d v = place - camera.eye();
  const bool flat = camera.camera().kind == CameraKind::orthographic;
  const double scale = flat ? double(camera.camera().ymag)
                            : v.dot(camera.forward()) * std::tan(camera.camera().yfov / 2.0);
  return V2f(float(v.dot(camera.right()) / scale), float(v.dot(camera.up()) / scale));
}

TEST(OrbitCamera, OrbitsAroundThePivot) {
  OrbitCamera camera = camera_at({0, 0, 5}, {0, 0, 0});
  camera.orbit(pi / 2, 0.0);
  expect_near(camera.eye(), {5, 0, 0});
  expect_near(camera.forward(), {-1, 0, 0});
  camera.orbit(0.0, pi / 4);
  expect_near(camera.eye(), V3d(5, 5, 0) * std::sqrt(0.5));
  expect_near(camera.forward(), V3d(-1, -1, 0) * std::sqrt(0.5));
}

TEST(OrbitCamera, KeepsThePivotWhereItIsInThePicture) {
  for (const bool flat : {false, true}) {
    Camera start = perspective_camera({1, 2, 5}, {0, 0, 0}, 0.7);
    if (flat) {
      start.kind = CameraKind::orthographic;
      start.ymag = 2.0f;
    }
    OrbitCamera camera;
    const V3d pivot(0.4, -0.3, 0.6);
    camera.take(start, pivot);
    const V2f before = seen_at(camera, pivot);
    camera.orbit(0.8, -0.4);
    camera.dolly(6.0);
    camera.orbit(-2.0, 1.3);
    camera.dolly(-2.5);
    EXPECT_NEAR((seen_at(camera, pivot) - before).length(), 0.0, 1e-5);
  }
}

// Many small steps do what a large one does.
TEST(OrbitCamera, DoesNotDependOnTheFrameRate) {
  const auto moved = [](int steps) {
    OrbitCamera camera = camera_at({1, 2, 5}, {0, 0, 0});
    const double share = 1.0 / steps;
    for (int i = 0; i < steps; ++i) camera.orbit(1.2 * share, 0.0);
    for (int i = 0; i < steps; ++i) camera.orbit(0.0, 0.7 * share);
    for (int i = 0; i < steps; ++i) camera.fly(V3d(0.3, -0.2, 0.5) * share);
    for (int i = 0; i < steps; ++i) camera.dolly(3.0 * share);
    for (int i = 0; i < steps; ++i) camera.pan(0.1 * share, 0.3 * share);
    for (int i = 0; i < steps; ++i) camera.look(0.2 * share, 0.0);
    for (int i = 0; i < steps; ++i) camera.roll(0.2 * share);
    return camera;
  };
  const OrbitCamera one = moved(1), many = moved(240);
  expect_near(one.eye(), many.eye());
  expect_near(one.pivot(), many.pivot());
  expect_near(one.forward(), many.forward());
  expect_near(one.up(), many.up());
}

// Over the pole and on, all the way round; a drag always has an effect of the same size.
TEST(OrbitCamera, HasNoPole) {
  OrbitCamera camera = camera_at({0, 0, 5}, {0, 0, 0});
  const V3d eye = camera.eye(), up = camera.up();
  for (int i = 0; i < 360; ++i) {
    const V3d last = camera.eye();
    camera.orbit(0.0, pi / 180);
    EXPECT_NEAR((camera.eye() - last).length(), 10.0 * std::sin(pi / 360), exact);
    expect_right_angles(camera);
  }
  expect_near(camera.eye(), eye);
  expect_near(camera.up(), up);

  camera.look_from_axis(ViewAxis::positive_y);
  const V3d right = camera.right();
  camera.orbit(0.5, 0.0);
  EXPECT_NEAR(camera.right().dot(right), std::cos(0.5), exact);
  camera.orbit(0.0, -0.5);
  EXPECT_NEAR(camera.eye().y, 5.0 * std::cos(0.5), exact);
}

TEST(OrbitCamera, StaysRightAngledForEver) {
  OrbitCamera camera = camera_at({1, 2, 5}, {0, 0, 0});
  const double distance = camera.distance();
  for (int i = 0; i < 100000; ++i) {
    camera.orbit(0.01, 0.007);
    camera.look(0.003, -0.002);
    camera.look(-0.003, 0.002);
  }
  expect_right_angles(camera);
  EXPECT_NEAR(camera.distance(), distance, 1e-6);
}

// What is dragged stays under the mouse.
TEST(OrbitCamera, PansByWhatIsSeen) {
  OrbitCamera camera = camera_at({0, 0, 5}, {0, 0, 0});
  camera.pan(-0.25, 0.1);
  const V2f seen = seen_at(camera, V3d(0.0));
  EXPECT_NEAR(seen.x, 0.5, 1e-6);  // a quarter of the height
  EXPECT_NEAR(seen.y, -0.2, 1e-6);
  expect_near(camera.pivot(), camera.eye() + V3d(0, 0, -5));
}

TEST(OrbitCamera, DolliesTowardThePivotAndNeverThrough) {
  OrbitCamera camera = camera_at({0, 0, 5}, {0, 0, 0});
  camera.dolly(2.0);
  EXPECT_NEAR(camera.eye().z, 5.0 * 0.81, exact);
  camera.dolly(1e4);
  EXPECT_GT(camera.eye().z, 0.0);
  camera.dolly(-2.0);
  EXPECT_TRUE(std::isfinite(camera.eye().z));
}

TEST(OrbitCamera, LooksFromTheSixSides) {
  OrbitCamera camera = camera_at({1, 3, 4}, {1, 0, 0});
  const V3d pivot = camera.pivot();
  const double away = camera.distance();
  const std::array<V3d, 6> sides = {
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  for (std::size_t i = 0; i < sides.size(); ++i) {
    camera.look_from_axis(static_cast<ViewAxis>(i));
    expect_near(camera.eye(), pivot + sides[i] * away);
    expect_near(camera.forward(), -sides[i]);
    expect_right_angles(camera);
    if (sides[i].y == 0.0) expect_near(camera.up(), {0, 1, 0});
  }
}

TEST(OrbitCamera, FramesEverything) {
  for (const bool flat : {false, true}) {
    for (const double aspect : {0.4, 1.0, 3.0}) {
      Camera start = perspective_camera({1, 2, 5}, {0, 0, 0}, 0.7);
      start.zfar = 7.0f;
      if (flat) start.kind = CameraKind::orthographic;
      OrbitCamera camera;
      camera.take(start, V3d(0.0));
      const V3d forward = camera.forward();
      const Imath::Box3d bounds(V3d(10, 20, 30), V3d(14, 21, 33));
      camera.frame(bounds, aspect);
      expect_near(camera.forward(), forward);
      double widest = 0.0;
      for (int i = 0; i < 8; ++i) {
        const V3d corner((i & 1) ? bounds.min.x : bounds.max.x,
                         (i & 2) ? bounds.min.y : bounds.max.y,
                         (i & 4) ? bounds.min.z : bounds.max.z);
        const V2f seen = seen_at(camera, corner);
        EXPECT_LT(std::abs(seen.x), aspect);
        EXPECT_LT(std::abs(seen.y), 1.0);
        widest = std::max({widest, std::abs(seen.x) / aspect, double(std::abs(seen.y))});
        EXPECT_LT((corner - camera.eye()).dot(camera.forward()), double(camera.camera().zfar));
      }
      EXPECT_GT(widest, 0.3) << "it is too small";
    }
  }
  OrbitCamera camera = camera_at({0, 0, 5}, {0, 0, 0});
  camera.frame(Imath::Box3d(), 1.0);
  expect_near(camera.eye(), {0, 0, 5});
}

TEST(OrbitCamera, LooksAroundAndLevels) {
  OrbitCamera camera = camera_at({0, 1, 0}, {0, 1, -1});
  camera.look(pi / 2, 0.0);
  expect_near(camera.forward(), {1, 0, 0});
  expect_near(camera.eye(), {0, 1, 0});
  camera.roll(0.4);
  EXPECT_NEAR(camera.up().y, std::cos(0.4), exact);
  camera.level();
  expect_near(camera.up(), {0, 1, 0});
  expect_near(camera.forward(), {1, 0, 0});
}

// A camera that its file has scaled and mirrored is taken as it is looked through.
TEST(OrbitCamera, TakesScaledCameras) {
  Camera start = perspective_camera({0, 0, 5}, {0, 0, 0}, 0.7);
  start.camera_to_world = scaling({-2.0, 2.0, 2.0}) * start.camera_to_world;
  OrbitCamera camera;
  camera.take(start, V3d(0.0));
  expect_near(camera.eye(), {0, 0, 5});
  expect_right_angles(camera);
}

}  // namespace
}  // namespace lumivec::test
