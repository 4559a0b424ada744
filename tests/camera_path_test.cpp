#include "viewer/walk/camera_path.h"

#include <gtest/gtest.h>

#include <fstream>

#include "temporary_folder.h"
#include "test_scenes.h"
#include "viewer/errors.h"

namespace lumivec::test {
namespace {

V3d eye_of(const Camera& camera) {
  const M44d& m = camera.camera_to_world;
  return {m[3][0], m[3][1], m[3][2]};
}
V3d forward_of(const Camera& camera) {
  const M44d& m = camera.camera_to_world;
  return -V3d(m[2][0], m[2][1], m[2][2]).normalized();
}

TEST(camera_path, orbit_keeps_the_pivot_in_sight) {
  const V3d pivot(1.0, 0.5, -2.0);
  const Camera camera = perspective_camera({1.0, 1.5, 3.0}, pivot, 0.7);
  const std::vector<Camera> path =
      camera_path(parse_camera_path("--path", "orbit:90"), camera, pivot, 10);
  ASSERT_EQ(path.size(), 10u);
  EXPECT_EQ(path.front().camera_to_world, camera.camera_to_world);
  for (const Camera& view : path) {
    const V3d to_pivot = pivot - eye_of(view);
    EXPECT_NEAR(to_pivot.length(), (pivot - eye_of(camera)).length(), 1e-12);
    EXPECT_NEAR(forward_of(view).dot(to_pivot.normalized()), 1.0, 1e-12);
  }
  // A quarter, counter-clockwise seen from above: from +Z of the pivot to +X.
  EXPECT_NEAR((eye_of(path.back()) - V3d(6.0, 1.5, -2.0)).length(), 0.0, 1e-12);
}

TEST(camera_path, dolly_goes_straight_on) {
  const Camera camera = perspective_camera({0, 0, 5}, {0, 0, 0}, 0.7);
  const std::vector<Camera> path =
      camera_path(parse_camera_path("--path", "dolly:2"), camera, V3d(0.0), 5);
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR((eye_of(path[std::size_t(i)]) - V3d(0, 0, 5 - 0.5 * i)).length(), 0.0, 1e-12);
  EXPECT_EQ(camera_path(parse_camera_path("--path", "dolly:2"), camera, V3d(0.0), 1).size(), 1u);
}

class CameraPathFile : public testing::Test {
 protected:
  std::vector<Camera> read(const std::string& text, int frames = 3) {
    const std::filesystem::path file = folder_.path() / "path.json";
    std::ofstream(file) << text;
    const Camera camera = perspective_camera({0, 0, 5}, {0, 0, 0}, 0.7);
    return camera_path(parse_camera_path("--path", file.string()), camera, V3d(0.0), frames);
  }
  void expect_refused(const std::string& text, const std::string& what) {
    try {
      read(text);
      FAIL() << text;
    } catch (const CommandError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  }
  TemporaryFolder folder_;
};

TEST_F(CameraPathFile, JoinsKeys) {
  const std::vector<Camera> path = read(
      R"({"keys": [{"eye": [0, 0, 4], "target": [0, 0, 0], "yfov": 40},
                   {"eye": [2, 0, 4], "target": [2, 0, 0], "yfov": 60}]})");
  ASSERT_EQ(path.size(), 3u);
  EXPECT_NEAR((eye_of(path[1]) - V3d(1, 0, 4)).length(), 0.0, 1e-12);
  EXPECT_NEAR((forward_of(path[1]) - V3d(0, 0, -1)).length(), 0.0, 1e-12);
  EXPECT_NEAR(path[1].yfov, 50.0 * pi / 180.0, 1e-6);
}

TEST_F(CameraPathFile, RefusesWhatIsWrong) {
  expect_refused("{", "is not JSON");
  expect_refused("{}", "has no list \"keys\"");
  expect_refused(R"({"keys": []})", "has no list \"keys\"");
  expect_refused(R"({"keys": [{"eye": [0, 0, 1]}]})", "/keys/0/target: is missing");
  expect_refused(R"({"keys": [{"eye": [0, 0], "target": [0, 0, 0]}]})",
                 "/keys/0/eye: is not a list of three numbers");
  expect_refused(R"({"keys": [{"eye": [0, 0, 1e300], "target": [0, 0, 0]}]})", "/keys/0/eye");
  expect_refused(R"({"keys": [{"eye": [0, 1, 0], "target": [0, 0, 0]}]})", "on one line");
  expect_refused(R"({"keys": [{"eye": [0, 0, 1], "target": [0, 0, 0], "yfov": 180}]})",
                 "/keys/0/yfov");
}

TEST(camera_path, refuses_what_is_no_path) {
  EXPECT_THROW(parse_camera_path("--path", "orbit:fast"), UsageError);
  EXPECT_THROW(parse_camera_path("--path", "orbit"), UsageError);
  EXPECT_THROW(parse_camera_path("--path", "dolly:nan"), UsageError);
  const Camera camera = perspective_camera({0, 0, 5}, {0, 0, 0}, 0.7);
  EXPECT_THROW(camera_path(parse_camera_path("--path", "no_such_file.json"), camera, V3d(0.0), 2),
               CommandError);
}

}  // namespace
}  // namespace lumivec::test
