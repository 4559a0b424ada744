// The node tree and what hangs on it: transforms, scenes, instancing, cameras, lights, animations.
#include <cmath>
#include <numbers>

#include "tests/gltf_file.h"

namespace {

using lumivec::Camera;
using lumivec::CameraKind;
using lumivec::Color;
using lumivec::Light;
using lumivec::LightKind;
using lumivec::M44d;
using lumivec::Scene;
using lumivec::V3d;

V3d transformed(const V3d& p, const M44d& m) {
  V3d q;
  m.multVecMatrix(p, q);
  return q;
}

void expect_near(const V3d& a, const V3d& b) {
  EXPECT_NEAR((a - b).length(), 0.0, 1e-9) << a << " " << b;
}

TEST(GltfNode, ScaleThenRotationThenTranslation) {
  GltfFile file;
  file.patch(R"({"nodes": [{"mesh": 0, "translation": [10, 0, 0], "scale": [2, 3, 4],
    "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476]}]})");
  const Scene scene = file.load();
  expect_near(transformed(V3d(1, 0, 0), scene.instances[0].object_to_world), V3d(10, 2, 0));
  expect_near(transformed(V3d(0, 1, 0), scene.instances[0].object_to_world), V3d(7, 0, 0));
}

TEST(GltfNode, MatricesAreColumnMajor) {
  GltfFile file;
  file.patch(R"({"nodes": [{"mesh": 0, "matrix": [0,1,0,0, -1,0,0,0, 0,0,1,0, 5,6,7,1]}]})");
  expect_near(transformed(V3d(1, 0, 0), file.load().instances[0].object_to_world), V3d(5, 7, 7));
}

TEST(GltfNode, ParentsComeLast) {
  GltfFile file;
  file.patch(R"({"nodes": [{"children": [1], "translation": [1, 0, 0]},
    {"children": [2], "scale": [2, 2, 2]}, {"mesh": 0, "name": "leaf", "translation": [0, 1, 0]}]})");
  const Scene scene = file.load();
  ASSERT_EQ(scene.instances.size(), 1u);
  expect_near(transformed(V3d(0, 0, 0), scene.instances[0].object_to_world), V3d(1, 2, 0));
  EXPECT_EQ(scene.instances[0].name, "leaf");
  EXPECT_EQ(scene.instances[0].node, 2);
  EXPECT_EQ(scene.nodes[2].parent, 1);
  EXPECT_EQ(scene.nodes[0].parent, -1);
}

TEST(GltfNode, MirrorsAreKept) {
  GltfFile file;
  file.patch(R"({"nodes": [{"mesh": 0, "scale": [-1, 1, 1]}]})");
  const Scene scene = file.load();
  EXPECT_LT(scene.instances[0].object_to_world.determinant(), 0.0);
  EXPECT_EQ(scene.meshes[0].triangles[0], (Imath::Vec3<std::uint32_t>(0, 1, 2)));
}

TEST(GltfNode, FlattenedInstancesAreLeftOut) {
  for (const char* scale : {"[1, 0, 1]", "[0, 0, 0]", "[1e-300, 1, 1]"}) {
    GltfFile file;
    file.root["nodes"][0]["scale"] = nlohmann::json::parse(scale);
    EXPECT_TRUE(file.load().instances.empty()) << scale;
    EXPECT_TRUE(file.warns("/nodes/0: scales to nothing"));
  }
}

TEST(GltfNode, SmallAndLargeUniformScalesStay) {
  for (const double scale : {1e-12, 1e12}) {
    GltfFile file;
    file.root["nodes"][0]["scale"] = {scale, scale, scale};
    EXPECT_EQ(file.load().instances.size(), 1u) << scale;
  }
}

TEST(GltfNode, InstancesBeyondFloatAreLeftOut) {
  GltfFile file;
  file.patch(R"({"nodes": [{"mesh": 0, "translation": [1e30, 0, 0]}]})");
  EXPECT_TRUE(file.load().instances.empty());
  EXPECT_TRUE(file.warns("too far"));
}

TEST(GltfNode, BrokenTransformsAreErrors) {
  for (const char* node :
       {R"({"rotation": [0, 0, 0, 0]})", R"({"matrix": [1,0,0,0.5, 0,1,0,0, 0,0,1,0, 0,0,0,1]})",
        R"({"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,0]})"}) {
    GltfFile file;
    file.root["nodes"][0] = nlohmann::json::parse(node);
    EXPECT_TRUE(contains(file.error(), "/nodes/0")) << node;
  }
}

TEST(GltfNode, CyclesAndSecondParentsAreErrors) {
  const std::pair<const char*, const char*> cases[] = {
      {R"([{"children": [0]}])", "its own ancestor"},
      {R"([{}, {"children": [2]}, {"children": [1]}])", "its own ancestor"},
      {R"([{"children": [2]}, {"children": [2]}, {}])", "is a child of node 0 and of node 1"},
      {R"([{"children": [1, 1]}, {}])", "is a child of node 0 and of node 0"},
  };
  for (const auto& [nodes, expected] : cases) {
    GltfFile file;
    file.root["nodes"] = nlohmann::json::parse(nodes);
    EXPECT_TRUE(contains(file.error(), expected));
  }
}

TEST(GltfNode, LongChainsAreFine) {
  GltfFile file;
  constexpr std::size_t length = 20000;
  file.root["nodes"] = nlohmann::json::array();
  for (std::size_t i = 1; i < length; ++i) {
    file.root["nodes"].push_back({{"children", {i}}, {"translation", {1, 0, 0}}});
  }
  file.root["nodes"].push_back({{"mesh", 0}});
  const Scene scene = file.load();
  EXPECT_EQ(scene.instances.at(0).object_to_world[3][0], length - 1.0);
}

TEST(GltfNode, ScenesByNameAndIndex) {
  const char* scenes = R"({"scene": 1, "scenes": [{"name": "one", "nodes": [0]}, {"name": "two"},
                            {"nodes": [0]}]})";
  const std::tuple<const char*, std::size_t, int> cases[] = {
      {"", 0u, 1}, {"one", 1u, 0}, {"two", 0u, 1}, {"2", 1u, 2}};
  for (const auto& [wanted, instances, index] : cases) {
    GltfFile file;
    file.patch(scenes);
    file.options.scene = wanted;
    EXPECT_EQ(file.load().instances.size(), instances) << wanted;
    EXPECT_EQ(file.report.scene, index);
    EXPECT_EQ(file.report.scene_names, (std::vector<std::string>{"one", "two", ""}));
  }
  GltfFile file;
  file.patch(scenes);
  file.options.scene = "three";
  EXPECT_TRUE(contains(file.error(), "choose one of 0 (one), 1 (two), 2"));
}

TEST(GltfNode, WithoutScenesEverythingIsShown) {
  GltfFile file;
  file.root.erase("scene");
  file.root.erase("scenes");
  EXPECT_EQ(file.load().instances.size(), 1u);
  EXPECT_TRUE(file.warns("no scene"));
}

TEST(GltfNode, SceneRootsWithParentsAreErrors) {
  GltfFile file;
  file.patch(R"({"scenes": [{"nodes": [0, 1]}], "nodes": [{"children": [1]}, {"mesh": 0}]})");
  EXPECT_TRUE(contains(file.error(), "/scenes/0/nodes: lists node 1"));
}

TEST(GltfNode, GpuInstancing) {
  GltfFile file;
  const int translations = file.accessor<float>("VEC3", GltfFile::float32, {1, 0, 0, 2, 0, 0});
  const int scales = file.accessor<float>("VEC3", GltfFile::float32, {1, 1, 1, 0, 1, 1});
  const int rotations =
      file.accessor<std::int8_t>("VEC4", GltfFile::int8, {0, 0, 127, 0, 0, 0, 0, 127}, true);
  file.patch(R"({"nodes": [{"mesh": 0, "translation": [0, 5, 0], "extensions":
    {"EXT_mesh_gpu_instancing": {"attributes": {}}}}]})");
  auto& attributes = file.root["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  attributes["TRANSLATION"] = translations;
  attributes["ROTATION"] = rotations;
  const Scene scene = file.load();
  ASSERT_EQ(scene.instances.size(), 2u);
  expect_near(transformed(V3d(1, 0, 0), scene.instances[0].object_to_world), V3d(0, 5, 0));
  expect_near(transformed(V3d(1, 0, 0), scene.instances[1].object_to_world), V3d(3, 5, 0));
  attributes["SCALE"] = scales;
  EXPECT_EQ(file.load().instances.size(), 1u);
  attributes["SCALE"] = 0;
  EXPECT_TRUE(contains(file.error(), "elements"));
}

TEST(GltfNode, Cameras) {
  GltfFile file;
  file.patch(R"({"nodes": [{"children": [1, 2], "scale": [2, 2, 2]},
    {"camera": 0, "translation": [0, 0, 3]}, {"camera": 1}],
    "cameras": [{"type": "perspective", "name": "eye",
      "perspective": {"yfov": 0.5, "znear": 0.1, "aspectRatio": 1.5}},
      {"type": "orthographic", "orthographic": {"xmag": 2, "ymag": 1, "znear": 0, "zfar": 9}}]})");
  const Scene scene = file.load();
  ASSERT_EQ(scene.cameras.size(), 2u);
  EXPECT_FALSE(file.report.default_camera);
  EXPECT_EQ(scene.cameras[0].name, "eye");
  EXPECT_EQ(scene.cameras[0].yfov, 0.5f);
  EXPECT_EQ(scene.cameras[0].aspect, 1.5f);
  EXPECT_TRUE(std::isinf(scene.cameras[0].zfar));
  expect_near(transformed(V3d(0), scene.cameras[0].camera_to_world), V3d(0, 0, 6));
  EXPECT_NEAR(scene.cameras[0].camera_to_world.determinant(), 1.0, 1e-12);
  EXPECT_EQ(scene.cameras[1].kind, CameraKind::orthographic);
  EXPECT_EQ(scene.cameras[1].zfar, 9.0f);
}

TEST(GltfNode, UselessCamerasAreLeftOut) {
  for (const char* camera :
       {R"({"type": "perspective", "perspective": {"yfov": 0, "znear": 0.1}})",
        R"({"type": "perspective", "perspective": {"yfov": 3.2, "znear": 0.1}})",
        R"({"type": "orthographic",
            "orthographic": {"xmag": 0, "ymag": 1, "znear": 0, "zfar": 9}})"}) {
    GltfFile file;
    file.root["nodes"][0]["camera"] = 0;
    file.root["cameras"] = {nlohmann::json::parse(camera)};
    file.load();
    EXPECT_TRUE(file.report.default_camera) << camera;
    EXPECT_TRUE(file.warns("/cameras/0"));
  }
  GltfFile file;
  file.root["cameras"] = {{{"type", "perspective"}}};
  EXPECT_TRUE(contains(file.error(), "/cameras/0: has no perspective"));
}

TEST(GltfNode, DefaultCameraSeesEverything) {
  GltfFile file;
  file.patch(R"({"nodes": [{"mesh": 0, "translation": [100, 3, 7], "scale": [5, 1, 1]}]})");
  const Scene scene = file.load();
  EXPECT_TRUE(file.report.default_camera);
  const Camera& camera = scene.cameras[0];
  const M44d view = camera.camera_to_world.inverse();
  const double slope = std::tan(camera.yfov / 2.0);
  double widest = 0.0;
  for (const auto& p : scene.meshes[0].positions) {
    const V3d seen = transformed(transformed(V3d(p), scene.instances[0].object_to_world), view);
    ASSERT_LT(seen.z, 0.0);
    widest = std::max({widest, std::abs(seen.x / seen.z), std::abs(seen.y / seen.z)});
  }
  EXPECT_LT(widest, slope);
  EXPECT_GT(widest, 0.5 * slope);
  EXPECT_GT(camera.camera_to_world[3][1], 3.0);  // from above
}

TEST(GltfNode, Lights) {
  GltfFile file;
  file.patch(R"({"nodes": [{"children": [1, 2, 3], "translation": [0, 4, 0], "scale": [3, 3, 3]},
    {"extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"extensions": {"KHR_lights_punctual": {"light": 1}}, "name": "lamp"},
    {"extensions": {"KHR_lights_punctual": {"light": 2}},
     "rotation": [-0.7071067811865476, 0, 0, 0.7071067811865476]}],
    "extensions": {"KHR_lights_punctual": {"lights": [
      {"type": "point", "intensity": 800, "color": [1, 0.5, 0], "name": "bulb", "range": 3},
      {"type": "spot", "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.4}},
      {"type": "directional", "intensity": 100000}]}}})");
  const Scene scene = file.load();
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_EQ(scene.lights[0].kind, LightKind::point);
  EXPECT_EQ(scene.lights[0].intensity, Color(800, 400, 0));
  EXPECT_EQ(scene.lights[0].name, "bulb");
  EXPECT_EQ(scene.lights[0].range, 3.0f);
  expect_near(transformed(V3d(0), scene.lights[0].object_to_world), V3d(0, 4, 0));
  EXPECT_EQ(scene.lights[1].kind, LightKind::spot);
  EXPECT_EQ(scene.lights[1].name, "lamp");
  EXPECT_EQ(scene.lights[1].inner_cone, 0.2f);
  EXPECT_EQ(scene.lights[1].outer_cone, 0.4f);
  EXPECT_EQ(scene.lights[2].kind, LightKind::directional);
  const M44d& m = scene.lights[2].object_to_world;
  expect_near(V3d(-m[2][0], -m[2][1], -m[2][2]), V3d(0, -1, 0));
}

TEST(GltfNode, LightsThatContradictThemselves) {
  const std::pair<const char*, bool> cases[] = {
      {R"({"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.4}})", true},
      {R"({"type": "spot", "spot": {"outerConeAngle": 3}})", true},
      {R"({"type": "point", "intensity": -1})", true},
      {R"({"type": "area"})", false}};
  for (const auto& [light, stays] : cases) {
    GltfFile file;
    file.root["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    file.root["extensions"]["KHR_lights_punctual"]["lights"] = {nlohmann::json::parse(light)};
    const Scene scene = file.load();
    EXPECT_EQ(scene.lights.size(), stays ? 1u : 0u) << light;
    EXPECT_FALSE(file.report.warnings.empty()) << light;
    for (const Light& l : scene.lights) {
      EXPECT_LT(l.inner_cone, l.outer_cone);
      EXPECT_LE(l.outer_cone, std::numbers::pi_v<float> / 2);
      EXPECT_GE(l.intensity.x, 0.0f);
    }
  }
}

TEST(GltfNode, Animations) {
  GltfFile file;
  const int times = file.accessor<float>("SCALAR", GltfFile::float32, {0, 1});
  const int moves = file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 0, 1, 2, 3});
  const int backwards = file.accessor<float>("SCALAR", GltfFile::float32, {1, 0});
  file.patch(R"({"animations": [{"name": "go", "channels": [
      {"sampler": 0, "target": {"node": 0, "path": "translation"}},
      {"sampler": 1, "target": {"node": 0, "path": "scale"}},
      {"sampler": 0, "target": {"path": "translation"}},
      {"sampler": 0, "target": {"node": 0, "path": "pointer"}}],
    "samplers": [{"interpolation": "STEP"}, {}]}]})");
  auto& samplers = file.root["animations"][0]["samplers"];
  samplers[0]["input"] = times;
  samplers[1]["input"] = backwards;
  samplers[0]["output"] = samplers[1]["output"] = moves;
  const Scene scene = file.load();
  ASSERT_EQ(scene.animations.size(), 1u);
  EXPECT_EQ(scene.animations[0].name, "go");
  ASSERT_EQ(scene.animations[0].channels.size(), 1u);
  const auto& channel = scene.animations[0].channels[0];
  EXPECT_EQ(channel.times, (std::vector<float>{0, 1}));
  EXPECT_EQ(channel.values, (std::vector<float>{0, 0, 0, 1, 2, 3}));
  EXPECT_EQ(channel.interpolation, lumivec::Interpolation::step);
  EXPECT_TRUE(file.warns("/animations/0/channels/1"));
  file.root["animations"][0]["channels"][0]["sampler"] = 2;
  EXPECT_TRUE(contains(file.error(), "names sampler 2 of 2"));
}

TEST(GltfNode, ManyWarningsEndInACount) {
  GltfFile file;
  file.root["nodes"] = nlohmann::json::array();
  file.root["scenes"][0]["nodes"] = nlohmann::json::array();
  for (int i = 0; i < 1000; ++i) {
    file.root["nodes"].push_back({{"mesh", 0}, {"scale", {0, 1, 1}}});
    file.root["scenes"][0]["nodes"].push_back(i);
  }
  file.load();
  EXPECT_LT(file.report.warnings.size(), 200u);
  EXPECT_TRUE(file.warns("900 more warnings"));
}

}  // namespace
