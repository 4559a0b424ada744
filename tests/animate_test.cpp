// Scenes posed at a time: what moves, what is said to have changed, and the way back to rest.
#include "loader/animate.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/animated_file.h"
#include "tests/scene_bits.h"

namespace {

using lumivec::M44d;
using lumivec::PlayedAnimation;
using lumivec::pose_scene;
using lumivec::PoseChanges;
using lumivec::Scene;
using lumivec::V3d;
using Indices = std::vector<int>;

PoseChanges rest(Scene& scene) {
  return pose_scene(scene, std::span<const PlayedAnimation>());
}

V3d position(const M44d& m) {
  return {m[3][0], m[3][1], m[3][2]};
}

void expect_near(const V3d& a, const V3d& b, double tolerance = 1e-6) {
  EXPECT_NEAR((a - b).length(), 0.0, tolerance) << a << " " << b;
}

const float half_turn_sine = std::numbers::sqrt2_v<float> / 2.0f;  // of a quaternion of 90 degrees

// Node 0, which moves, carries 1, which carries the triangle; the triangle also stands at node 2.
void family(GltfFile& file) {
  file.patch(R"({"scenes": [{"nodes": [0, 2]}],
    "nodes": [{"children": [1], "scale": [2, 2, 2]}, {"mesh": 0, "translation": [0, 1, 0]},
              {"mesh": 0}]})");
  animate(file, 0, "translation", {0, 2}, {0, 0, 0, 10, 0, 0});
}

TEST(Animate, ChildrenMoveWithTheirParents) {
  GltfFile file;
  family(file);
  Scene scene = file.load();
  const PoseChanges changes = pose_scene(scene, 0, 1.0);
  EXPECT_EQ(position(scene.instances[0].object_to_world), V3d(5, 2, 0));
  EXPECT_EQ(scene.instances[0].object_to_world[0][0], 2.0);
  EXPECT_EQ(position(scene.instances[1].object_to_world), V3d(0));
  EXPECT_EQ(changes.instances, Indices{0});
  EXPECT_TRUE(changes.meshes.empty() && changes.lights.empty() && changes.cameras.empty());
}

TEST(Animate, ParentsMayBeListedAfterTheirChildren) {
  GltfFile file;
  file.patch(R"({"scenes": [{"nodes": [2]}], "nodes": [{"mesh": 0}, {"children": [0]},
                             {"children": [1]}]})");
  animate(file, 2, "translation", {0}, {1, 0, 0});
  animate(file, 1, "translation", {0}, {0, 1, 0});
  animate(file, 0, "translation", {0}, {0, 0, 1});
  Scene scene = file.load();
  pose_scene(scene, 0, 0.0);
  EXPECT_EQ(position(scene.instances[0].object_to_world), V3d(1, 1, 1));
}

TEST(Animate, WhatIsNotAnimatedStays) {
  GltfFile file;
  file.patch(R"({"nodes": [{"mesh": 0, "translation": [1, 2, 3], "scale": [4, 5, 6]}]})");
  animate(file, 0, "rotation", {0}, {0, 0, half_turn_sine, half_turn_sine});
  Scene scene = file.load();
  EXPECT_EQ(pose_scene(scene, 0, 0.0).instances, Indices{0});
  const M44d& m = scene.instances[0].object_to_world;
  EXPECT_EQ(position(m), V3d(1, 2, 3));
  expect_near(V3d(m[0][0], m[0][1], m[0][2]), V3d(0, 4, 0));
  expect_near(V3d(m[1][0], m[1][1], m[1][2]), V3d(-5, 0, 0));
}

TEST(Animate, PosingTwiceChangesNothing) {
  GltfFile file;
  family(file);
  Scene scene = file.load();
  EXPECT_FALSE(pose_scene(scene, 0, 1.5).empty());
  EXPECT_TRUE(pose_scene(scene, 0, 1.5).empty());
  EXPECT_FALSE(pose_scene(scene, 0, 7.0).empty());
  EXPECT_TRUE(pose_scene(scene, 0, 8.0).empty());  // both after the last key
}

TEST(Animate, WithoutAnimationsTheSceneIsAtRest) {
  GltfFile file;
  family(file);
  Scene scene = file.load();
  EXPECT_TRUE(rest(scene).empty());
  pose_scene(scene, 0, 1.5);
  EXPECT_EQ(rest(scene).instances, Indices{0});
  EXPECT_EQ(difference(scene, file.load()), "");
}

TEST(Animate, AnotherAnimationStartsFromRest) {
  GltfFile file;
  family(file);
  animate(file, 2, "translation", {0}, {0, 0, 1}, "LINEAR", 1);
  Scene scene = file.load();
  pose_scene(scene, 0, 2.0);
  EXPECT_EQ(pose_scene(scene, 1, 0.0).instances, (Indices{0, 1}));
  EXPECT_EQ(position(scene.instances[0].object_to_world), V3d(0, 2, 0));
  EXPECT_EQ(position(scene.instances[1].object_to_world), V3d(0, 0, 1));
}

TEST(Animate, SeveralPlayAtOnceEachAtItsTime) {
  GltfFile file;
  family(file);
  animate(file, 2, "translation", {0, 1}, {0, 0, 1, 0, 0, 2}, "LINEAR", 1);
  animate(file, 0, "translation", {0}, {0, 7, 0}, "LINEAR", 2);
  Scene scene = file.load();
  const PlayedAnimation both[] = {{0, 2.0}, {1, 0.5}};
  pose_scene(scene, both);
  EXPECT_EQ(position(scene.instances[0].object_to_world), V3d(10, 2, 0));
  EXPECT_EQ(position(scene.instances[1].object_to_world), V3d(0, 0, 1.5));
  const PlayedAnimation rivals[] = {{0, 2.0}, {2, 0.0}};
  pose_scene(scene, rivals);
  EXPECT_EQ(position(scene.instances[0].object_to_world), V3d(0, 9, 0));
}

TEST(Animate, AnimationsThatAreNotThereAreRefused) {
  GltfFile file;
  family(file);
  Scene scene = file.load();
  EXPECT_THROW(pose_scene(scene, 1, 1.0), std::out_of_range);
  EXPECT_EQ(difference(scene, file.load()), "");
}

TEST(Animate, LengthIsTheLastKeys) {
  GltfFile file;
  family(file);
  animate(file, 0, "scale", {3, 4.5f}, {1, 1, 1, 2, 2, 2});
  EXPECT_EQ(animation_length(file.load().animations[0]), 4.5);
  EXPECT_EQ(animation_length(lumivec::Animation()), 0.0);
}

TEST(Animate, InstancingMovesWithItsNode) {
  GltfFile file;
  const int places = file.accessor<float>("VEC3", GltfFile::float32, {1, 0, 0, 2, 0, 0});
  file.patch(R"({"nodes": [{"mesh": 0, "extensions":
    {"EXT_mesh_gpu_instancing": {"attributes": {}}}}]})");
  file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      places;
  animate(file, 0, "scale", {0, 1}, {1, 1, 1, 3, 3, 3});
  Scene scene = file.load();
  EXPECT_EQ(pose_scene(scene, 0, 1.0).instances, (Indices{0, 1}));
  EXPECT_EQ(position(scene.instances[0].object_to_world), V3d(3, 0, 0));
  EXPECT_EQ(position(scene.instances[1].object_to_world), V3d(6, 0, 0));
}

TEST(Animate, NegativeScalesMirror) {
  GltfFile file;
  animate(file, 0, "scale", {0, 1}, {1, 1, 1, -1, 1, 1});
  Scene scene = file.load();
  pose_scene(scene, 0, 1.0);
  EXPECT_LT(scene.instances[0].object_to_world.determinant(), 0.0);
  EXPECT_TRUE(scene.instances[0].visible);
}

TEST(Animate, WhatIsScaledToNothingIsHidden) {
  GltfFile file;
  animate(file, 0, "scale", {0, 1, 2}, {1, 1, 1, -1, 1, 1, 0, 0, 0});
  Scene scene = file.load();
  for (const double nothing : {0.5, 2.0}) {
    rest(scene);
    EXPECT_EQ(pose_scene(scene, 0, nothing).instances, Indices{0});
    EXPECT_FALSE(scene.instances[0].visible);
    EXPECT_EQ(scene.instances[0].object_to_world, M44d());
    EXPECT_TRUE(pose_scene(scene, 0, nothing).empty());
  }
  EXPECT_EQ(pose_scene(scene, 0, 1.0).instances, Indices{0});
  EXPECT_TRUE(scene.instances[0].visible);
}

TEST(Animate, WhatStartsAsNothingAppears) {
  GltfFile file;
  file.root["nodes"][0]["scale"] = {0, 0, 0};
  animate(file, 0, "scale", {0, 1}, {0, 0, 0, 2, 2, 2});
  Scene scene = file.load();
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_FALSE(scene.instances[0].visible);
  pose_scene(scene, 0, 1.0);
  EXPECT_TRUE(scene.instances[0].visible);
  EXPECT_EQ(scene.instances[0].object_to_world[1][1], 2.0);
  rest(scene);
  EXPECT_EQ(difference(scene, file.load()), "");
}

TEST(Animate, WhatFliesTooFarIsHidden) {
  GltfFile file;
  animate(file, 0, "translation", {0, 1}, {0, 0, 0, 1e30f, 0, 0});
  Scene scene = file.load();
  pose_scene(scene, 0, 1.0);
  EXPECT_FALSE(scene.instances[0].visible);
}

// Products of scales that double cannot hold.
TEST(Animate, TransformsThatAreNotFiniteAreHarmless) {
  GltfFile file;
  file.root["nodes"] = nlohmann::json::array();
  constexpr int depth = 12;
  for (int i = 0; i < depth; ++i) {
    file.root["nodes"].push_back({{"children", {i + 1}}});
    animate(file, i, "scale", {0}, {3e38f, -3e38f, 3e38f});
  }
  file.root["nodes"].push_back({{"mesh", 0}, {"camera", 0}, {"translation", {1, 1, 1}}});
  file.root["nodes"].back()["extensions"]["KHR_lights_punctual"]["light"] = 0;
  file.root["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}}};
  file.root["cameras"] =
      nlohmann::json::parse(R"([{"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}])");
  Scene scene = file.load();
  EXPECT_FALSE(pose_scene(scene, 0, 0.0).empty());
  EXPECT_FALSE(scene.instances[0].visible);
  EXPECT_EQ(scene.cameras[0].camera_to_world, M44d());
  EXPECT_EQ(scene.lights[0].object_to_world, M44d());
  EXPECT_TRUE(pose_scene(scene, 0, 0.0).empty());
  rest(scene);
  EXPECT_EQ(difference(scene, file.load()), "");
}

TEST(Animate, LightsAndCamerasMove) {
  GltfFile file;
  file.patch(R"({"nodes": [{"children": [1, 2]},
    {"camera": 0, "translation": [0, 0, 3]}, {"extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": {}}]}}})");
  animate(file, 0, "rotation", {0, 1}, {0, 0, 0, 1, 0, half_turn_sine, 0, half_turn_sine});
  animate(file, 1, "scale", {0}, {3, 3, 3});
  Scene scene = file.load();
  const PoseChanges changes = pose_scene(scene, 0, 1.0);
  EXPECT_EQ(changes.cameras, Indices{0});
  EXPECT_EQ(changes.lights, Indices{0});
  const M44d& eye = scene.cameras[0].camera_to_world;
  expect_near(position(eye), V3d(3, 0, 0));
  expect_near(V3d(eye[2][0], eye[2][1], eye[2][2]), V3d(1, 0, 0));
  const M44d& lamp = scene.lights[0].object_to_world;
  expect_near(V3d(-lamp[2][0], -lamp[2][1], -lamp[2][2]), V3d(-1, 0, 0));
}

TEST(Animate, LightsAndCamerasThatAreScaledToNothingKeepTheirPlace) {
  GltfFile file;
  file.patch(R"({"nodes": [{"camera": 0, "translation": [0, 0, 3], "scale": [0, 0, 0],
      "extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "cameras": [{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional"}]}}})");
  animate(file, 0, "scale", {0, 1}, {0, 0, 0, 1, 1, 1});
  animate(file, 0, "rotation", {0}, {0, half_turn_sine, 0, half_turn_sine});
  Scene scene = file.load();
  ASSERT_EQ(scene.lights.size(), 1u);
  ASSERT_FALSE(file.report.default_camera);
  EXPECT_EQ(scene.cameras[0].camera_to_world, M44d().setTranslation(V3d(0, 0, 3)));
  pose_scene(scene, 0, 1.0);
  const M44d& m = scene.lights[0].object_to_world;
  expect_near(V3d(m[2][0], m[2][1], m[2][2]), V3d(1, 0, 0));
}

}  // namespace
