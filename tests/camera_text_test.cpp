#include "viewer/camera_text.h"

#include <gtest/gtest.h>

#include "test_scenes.h"
#include "viewer/errors.h"

namespace lumivec::test {
namespace {

const Camera usual = perspective_camera({0, 0, 5}, {0, 0, 0}, 0.7);

std::string refusal(const std::string& text) {
  try {
    parse_camera_text("--camera", text, usual);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

TEST(CameraText, ComesBackAsTheSameView) {
  for (const bool flat : {false, true}) {
    Camera camera = perspective_camera({1.1, -2.3, 5.7}, {0.1, 0.2, 0.3}, 0.9);
    camera.camera_to_world = rotation({0, 0, 1}, 0.3) * camera.camera_to_world;
    if (flat) {
      camera.kind = CameraKind::orthographic;
      camera.ymag = 2.3f;
      camera.xmag = 4.6f;
    }
    const std::string text = camera_text(camera, V3d(0.1, 0.2, 0.3));
    EXPECT_TRUE(is_camera_text(text));
    EXPECT_EQ(text.find_first_of(" \t\n'\"\\$&|;<>()*?`"), std::string::npos) << text;
    const Camera back = parse_camera_text("--camera", text, usual);
    EXPECT_TRUE(back.camera_to_world.equalWithAbsError(camera.camera_to_world, 1e-12)) << text;
    EXPECT_EQ(back.kind, camera.kind);
    if (flat) {
      EXPECT_EQ(back.ymag, camera.ymag);
    } else {
      EXPECT_NEAR(back.yfov, camera.yfov, 1e-6);
    }
  }
}

// A parallel view in a scene whose camera has no size of its own.
TEST(CameraText, GivesAParallelViewAWidth) {
  Camera empty = usual;
  empty.xmag = empty.ymag = 0.0f;
  const Camera camera = parse_camera_text("--camera", "eye=0,0,1/target=0,0,0/ymag=2", empty);
  EXPECT_EQ(camera.kind, CameraKind::orthographic);
  EXPECT_EQ(camera.ymag, 2.0f);
  EXPECT_EQ(camera.xmag, 2.0f);
}

TEST(CameraText, LeavesWhatItDoesNotSay) {
  const Camera camera = parse_camera_text("--camera", "eye=1,2,3/target=1,2,0", usual);
  EXPECT_EQ(camera.yfov, usual.yfov);
  EXPECT_TRUE(camera.camera_to_world.equalWithAbsError(translation({1, 2, 3}), 1e-12));
}

TEST(CameraText, RefusesWhatIsNoView) {
  EXPECT_EQ(refusal("eye=1,2,3"),
            "--camera: a view needs an eye and a target; write eye=X,Y,Z/target=X,Y,Z");
  EXPECT_EQ(refusal("eye=1,2/target=0,0,0"),
            "--camera: '1,2' is not a place; give three numbers, such as 0,1,2");
  EXPECT_EQ(refusal("eye=1,2,x/target=0,0,0"), "--camera: 'x' is not a number");
  EXPECT_EQ(refusal("eye=0,1,0/target=0,0,0"),
            "--camera: eye, target and up lie on one line; move one of them");
  EXPECT_EQ(refusal("eye=1,1,1/target=1,1,1"),
            "--camera: eye, target and up lie on one line; move one of them");
  EXPECT_EQ(refusal("eye=0,1,0/taget=0,0,0"),
            "--camera: there is no 'taget' in a view; did you mean 'target'?");
  EXPECT_EQ(refusal("eye=0,0,1/target=0,0,0/yfov=180"),
            "--camera: 180 is out of range; give a number from 0.01 to 179");
  const std::string place = "eye=0,0,1/target=0,0,0";
  for (const char* no_size : {"/ymag=0", "/ymag=1e-300", "/ymag=nan", "/ymag=inf", "/yfov=nan"})
    EXPECT_EQ(refusal(place + no_size).substr(0, 10), "--camera: ") << no_size;
  for (const char* nowhere :
       {"eye=nan,0,0/target=0,0,0", "eye=0,0,1/target=0,inf,0", "eye=0,0,1/target=0,0,0/up=0,0,0"})
    EXPECT_EQ(refusal(nowhere).substr(0, 10), "--camera: ") << nowhere;
  EXPECT_FALSE(is_camera_text("front"));
}

}  // namespace
}  // namespace lumivec::test
