#include "viewer/window/camera_keys.h"

#include <gtest/gtest.h>

#include <fstream>

#include "temporary_folder.h"
#include "test_scenes.h"
#include "viewer/walk/camera_path.h"

namespace lumivec::test {
namespace {

std::vector<OrbitCamera> keys() {
  std::vector<OrbitCamera> result(3);
  result[0].take(perspective_camera({0, 0, 5}, {0, 0, 0}, 0.7), V3d(0.0));
  result[1].take(perspective_camera({4, 1, 3}, {0, 1, 0}, 0.9), V3d(0, 1, 0));
  result[2].take(perspective_camera({5, 2, -1}, {1, 1, 0}, 0.7), V3d(1, 1, 0));
  return result;
}

// What is played in the window is what walk does with the file.
TEST(CameraKeys, ArePlayedAsTheyAreWalked) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "path.json";
  std::ofstream(file) << camera_keys_text(keys());
  const Camera usual = keys()[0].camera();
  constexpr int frames = 9;
  const std::vector<Camera> walked =
      camera_path(parse_camera_path("--path", file.string()), usual, V3d(0.0), frames);
  for (int i = 0; i < frames; ++i) {
    const OrbitCamera played = camera_between(keys(), 2.0 * i / (frames - 1));
    const Camera& expected = walked[std::size_t(i)];
    EXPECT_TRUE(played.camera().camera_to_world.equalWithAbsError(expected.camera_to_world, 1e-9))
        << i;
    EXPECT_NEAR(played.camera().yfov, expected.yfov, 1e-5);
  }
}

TEST(CameraKeys, StayWithinThePath) {
  EXPECT_EQ(camera_between(keys(), -3.0).eye(), keys()[0].eye());
  EXPECT_NEAR((camera_between(keys(), 99.0).eye() - keys()[2].eye()).length(), 0.0, 1e-12);
  EXPECT_EQ(camera_between({keys()[1]}, 0.5).eye(), keys()[1].eye());
}

}  // namespace
}  // namespace lumivec::test
