#include "viewer/scene_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "viewer/scene_report.h"

using namespace lumivec;

namespace {

// A triangle placed twice and a sphere squeezed to an ellipsoid.
Scene small_scene() {
  Scene scene;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  scene.meshes.push_back(mesh);
  scene.spheres.push_back({2.0f});
  scene.materials.resize(2);
  scene.materials[1].emission = Color(0.0f, 3.0f, 0.0f);
  Instance first;
  first.mesh = 0;
  Instance second = first;
  second.material = 1;
  second.object_to_world.setTranslation(V3d(10, 0, 0));
  Instance ball;
  ball.sphere = 0;
  ball.object_to_world.setScale(V3d(1, 0.5, 1));
  scene.instances = {first, second, ball};
  Image image;
  image.name = "wood";
  image.width = 4;
  image.height = 2;
  image.rgba8.resize(32);
  scene.images.push_back(image);
  scene.cameras.resize(1);
  return scene;
}

}  // namespace

TEST(SceneSummary, CountsShapes) {
  const SceneCounts counts = count_scene(small_scene());
  EXPECT_EQ(counts.triangles, 1u);
  EXPECT_EQ(counts.triangles_instanced, 2u);
  EXPECT_EQ(counts.spheres, 1u);
  EXPECT_EQ(counts.emissive_instances, 1u);
  EXPECT_EQ(counts.bytes_images, 32u);
}
TEST(SceneSummary, BoundsTheWorld) {
  const Imath::Box3d bounds = world_bounds(small_scene());
  EXPECT_EQ(bounds.min, V3d(-2, -1, -2));
  EXPECT_EQ(bounds.max, V3d(11, 1, 2));
}
TEST(SceneSummary, BoundsATurnedEllipsoid) {
  Scene scene = small_scene();
  M44d turn;
  turn.setEulerAngles(V3d(0, 0, 3.14159265358979 / 4.0));
  scene.instances = {scene.instances[2]};
  scene.instances[0].object_to_world = scene.instances[0].object_to_world * turn;
  EXPECT_NEAR(world_bounds(scene).max.x, std::sqrt((4.0 + 1.0) / 2.0), 1e-9);
}
TEST(SceneSummary, OfAnEmptySceneHasNoBounds) {
  EXPECT_TRUE(world_bounds(Scene()).isEmpty());
}

// Node 0 carries a light and node 1, which has a camera and a mesh of its own weights.
static Scene animated_scene() {
  Scene scene = small_scene();
  scene.nodes.resize(2);
  scene.nodes[1].parent = 0;
  scene.lights.resize(1);
  scene.lights[0].node = 0;
  scene.cameras[0].node = 1;
  Animation go{"go", {AnimationChannel(), AnimationChannel()}};
  go.channels[0].node = 0;
  go.channels[0].times = {0.0f, 2.5f};
  go.channels[1].node = 1;
  go.channels[1].target = AnimationTarget::weights;
  go.channels[1].times = {1.0f};
  scene.animations = {go, Animation{"idle", {}}};
  scene.motion.nodes = {0, 1};
  scene.motion.instances.resize(2);
  scene.motion.instances[0].node = 1;
  scene.motion.instances[1].node = 0;
  scene.motion.deformations.resize(1);
  scene.motion.deformations[0].weights_node = 1;
  return scene;
}

TEST(SceneSummary, CountsWhatAnimationsChange) {
  const Scene scene = animated_scene();
  const AnimationCounts go = count_animation(scene, scene.animations[0]);
  EXPECT_EQ(go.nodes, 1u);
  EXPECT_EQ(go.instances, 2u);
  EXPECT_EQ(go.meshes, 1u);
  EXPECT_EQ(go.lights, 1u);
  EXPECT_EQ(go.cameras, 1u);
  const AnimationCounts idle = count_animation(scene, scene.animations[1]);
  EXPECT_EQ(idle.nodes + idle.instances + idle.meshes + idle.lights + idle.cameras, 0u);
}
TEST(SceneSummary, HiddenInstancesHaveNoBounds) {
  Scene scene = small_scene();
  scene.instances[1].visible = false;
  EXPECT_EQ(world_bounds(scene).max, V3d(2, 1, 2));
}

TEST(SceneReport, SaysWhatAnimationsMove) {
  const Scene scene = animated_scene();
  const std::string text = scene_text("room.gltf", scene, LoadReport());
  EXPECT_NE(text.find("0: 'go', 2.50 s, moves 2 shapes, 1 light, 1 camera; deforms 1 mesh\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("1: 'idle', 0.00 s, changes nothing that is seen\n"), std::string::npos)
      << text;
  const auto json = nlohmann::json::parse(scene_json("room.gltf", scene, LoadReport()));
  EXPECT_EQ(json["animations"][0]["seconds"], 2.5);
  EXPECT_EQ(json["animations"][0]["deformed_meshes"], 1);
}
TEST(SceneReport, SaysWhatIsNotShown) {
  LoadReport report;
  report.format = "glTF 2.0";
  report.scene_names = {"room"};
  report.extensions_ignored = {"KHR_materials_sheen"};
  report.warnings = {{"/materials/3", "sheen is left out"}};
  const std::string text = scene_text("room.gltf", small_scene(), report);
  EXPECT_NE(text.find("not supported: KHR_materials_sheen\n"), std::string::npos) << text;
  EXPECT_NE(text.find("warning: /materials/3: sheen is left out\n"), std::string::npos);
  EXPECT_NE(text.find("'wood', 4x2, 8 bit"), std::string::npos);
}
TEST(SceneReport, IsValidJsonWhateverTheNames) {
  LoadReport report;
  report.scene_names = {"broken \xff name"};
  Scene scene = small_scene();
  scene.cameras[0].name = "\"quoted\"";
  const auto json = nlohmann::json::parse(scene_json("room.gltf", scene, report));
  EXPECT_EQ(json["triangles_instanced"], 2);
  EXPECT_EQ(json["bounds"]["max"][0], 11.0);
  EXPECT_EQ(json["cameras"][0]["name"], "\"quoted\"");
  EXPECT_EQ(json["textures"][0]["width"], 4);
}
