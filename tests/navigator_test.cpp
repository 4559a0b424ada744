#include "viewer/window/navigator.h"

#include <gtest/gtest.h>

#include "test_scenes.h"

namespace lumivec::test {
namespace {

OrbitCamera usual() {
  OrbitCamera camera;
  camera.take(perspective_camera({0, 0, 5}, {0, 0, 0}, 0.7), V3d(0.0));
  return camera;
}

// The scene goes with the mouse.
TEST(Navigator, DragsTheScene) {
  OrbitCamera camera = usual();
  Navigator navigator;
  navigator.drag_to(0.7, 0.7, camera);
  EXPECT_EQ(camera.eye(), usual().eye()) << "no button is down";
  navigator.begin_drag(Navigator::Drag::orbit, 0.5, 0.5);
  navigator.drag_to(0.6, 0.5, camera);
  EXPECT_LT(camera.eye().x, 0.0);
  camera = usual();
  navigator.begin_drag(Navigator::Drag::pan, 0.5, 0.5);
  navigator.drag_to(0.6, 0.4, camera);
  EXPECT_LT(camera.eye().x, 0.0);
  EXPECT_LT(camera.eye().y, 0.0);
  camera = usual();
  navigator.begin_drag(Navigator::Drag::look, 0.5, 0.5);
  navigator.drag_to(0.6, 0.4, camera);
  EXPECT_GT(camera.forward().x, 0.0);
  EXPECT_GT(camera.forward().y, 0.0);
  EXPECT_EQ(camera.eye(), usual().eye());
  navigator.end_drag();
  const V3d forward = camera.forward();
  navigator.drag_to(0.9, 0.9, camera);
  EXPECT_EQ(camera.forward(), forward);
}

TEST(Navigator, FliesAsFarAtAnyFrameRate) {
  const auto flown = [](int frames) {
    OrbitCamera camera = usual();
    Navigator navigator;
    navigator.set_scale(8.0);
    navigator.hold(Navigator::forward, true);
    navigator.hold(Navigator::right, true);
    for (int i = 0; i < frames; ++i) navigator.fly(1.0 / frames, 1.0, camera);
    return camera.eye();
  };
  EXPECT_NEAR((flown(10) - flown(500)).length(), 0.0, 1e-9);
  EXPECT_NEAR((flown(10) - usual().eye()).length(), 2.0, 1e-9) << "a quarter of 8 a second";
}

// Nothing goes on once keys are let go, and a pause of the program throws no one out of the room.
TEST(Navigator, HasNoInertia) {
  OrbitCamera camera = usual();
  Navigator navigator;
  navigator.set_scale(8.0);
  navigator.hold(Navigator::forward, true);
  navigator.fly(1000.0, 1.0, camera);
  EXPECT_GT(camera.eye().z, 4.0);
  navigator.let_go();
  EXPECT_FALSE(navigator.flying());
  const V3d eye = camera.eye();
  navigator.fly(1.0, 1.0, camera);
  EXPECT_EQ(camera.eye(), eye);
}

}  // namespace
}  // namespace lumivec::test
