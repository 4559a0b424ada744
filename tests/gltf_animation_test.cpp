// Animations, skins and morph targets of files that are wrong: what is left out, and what is
// refused.
#include <cmath>

#include "loader/animate.h"
#include "tests/animated_file.h"

namespace {

using lumivec::pose_scene;
using lumivec::Scene;

TEST(GltfAnimation, NodesWithMatricesCannotBeAnimated) {
  GltfFile file;
  file.root["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1};
  animate(file, 0, "translation", {0}, {1, 0, 0});
  Scene scene = file.load();
  EXPECT_TRUE(file.warns("/animations/0/channels/0: node 0 is placed by a matrix"));
  EXPECT_TRUE(pose_scene(scene, 0, 0.0).empty());
  EXPECT_EQ(scene.instances[0].object_to_world[3][0], 5.0);
}

TEST(GltfAnimation, PropertiesAreSetOnce) {
  GltfFile file;
  animate(file, 0, "translation", {0}, {1, 0, 0});
  animate(file, 0, "translation", {0}, {2, 0, 0});
  EXPECT_EQ(file.load().animations[0].channels.size(), 1u);
  EXPECT_TRUE(file.warns("/animations/0/channels/1: sets what a channel before it sets"));
}

TEST(GltfAnimation, PointersAreAWarning) {
  GltfFile file;
  file.patch(R"({"extensionsUsed": ["KHR_animation_pointer"]})");
  animate(file, 0, "translation", {0}, {1, 0, 0});
  auto& target = file.root["animations"][0]["channels"][0]["target"];
  target = {
      {"path", "pointer"},
      {"extensions", {{"KHR_animation_pointer", {{"pointer", "/materials/0/emissiveFactor"}}}}}};
  Scene scene = file.load();
  EXPECT_TRUE(file.warns("extension KHR_animation_pointer is not supported"));
  EXPECT_TRUE(pose_scene(scene, 0, 0.0).empty());
}

TEST(GltfAnimation, ChannelsThatContradictThemselvesAreLeftOut) {
  const float nan = std::nanf("");
  struct Case {
    const char* path;
    std::vector<float> times;
    std::vector<float> values;
    const char* interpolation;
    const char* problem;
  };
  const Case cases[] = {
      {"translation", {0, 1}, {0, 0, 0}, "LINEAR", "2 keys of 3 numbers do not fit 3 numbers"},
      {"scale", {0, 1}, {1, 1, 1, 1, 1, 1}, "CUBICSPLINE", "2 keys of 9 numbers do not fit 6"},
      {"scale", {0, 0}, {1, 1, 1, 1, 1, 1}, "LINEAR", "not finite or do not increase"},
      {"scale", {1, 0}, {1, 1, 1, 1, 1, 1}, "LINEAR", "not finite or do not increase"},
      {"scale", {0, nan}, {1, 1, 1, 1, 1, 1}, "LINEAR", "not finite or do not increase"},
      {"scale", {0, 1}, {1, 1, 1, 1, nan, 1}, "LINEAR", "its values are not finite"},
      {"rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0, 0}, "LINEAR", "key 1 is no quaternion"},
      {"weights", {0}, {1}, "LINEAR", "its node has no morph target"},
      {"scale", {0}, {1, 1, 1}, "SPLINE", "interpolation SPLINE is unknown"},
  };
  for (const Case& c : cases) {
    GltfFile file;
    animate(file, 0, c.path, c.times, c.values, c.interpolation);
    Scene scene = file.load();
    EXPECT_TRUE(file.warns(c.problem)) << c.problem;
    EXPECT_TRUE(file.warns("/animations/0/channels/0: ")) << c.problem;
    EXPECT_TRUE(scene.animations.at(0).channels.empty()) << c.problem;
    EXPECT_TRUE(pose_scene(scene, 0, 0.5).empty()) << c.problem;
  }
}

TEST(GltfAnimation, HostileFilesAreRefused) {
  using Change = void (*)(GltfFile&);
  const std::pair<Change, const char*> cases[] = {
      {[](GltfFile& f) { f.root["animations"][0]["channels"][0]["sampler"] = 1; },
       "/animations/0/channels/0: names sampler 1 of 1"},
      {[](GltfFile& f) { f.root["animations"][0]["channels"][0]["target"]["node"] = 9; },
       "/animations/0/channels/0/target/node"},
      {[](GltfFile& f) { f.root["animations"][0]["samplers"][0]["output"] = 99; },
       "/animations/0/samplers/0/output"},
      {[](GltfFile& f) { f.root["accessors"].back()["count"] = 1000000; }, "/accessors/"},
      {[](GltfFile& f) {
         f.root["skins"][0]["joints"] = {1, 9};
       },
       "/skins/0/joints"},
      {[](GltfFile& f) {
         f.root["skins"][0]["joints"] = {1, 2, 0};
       },
       "/skins/0/inverseBindMatrices: has fewer matrices than the skin has joints"},
      {[](GltfFile& f) { f.root["skins"][0]["joints"] = {1}; }, "hangs on joint 1 of 1"},
      {[](GltfFile& f) {
         f.attribute("WEIGHTS_0",
                     f.accessor<float>("VEC4", GltfFile::float32,
                                       {std::nanf(""), 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}));
       },
       "the weights of vertex 0 are negative or not finite"},
      {[](GltfFile& f) {
         f.attribute("JOINTS_0", f.accessor<std::uint8_t>("VEC4", GltfFile::uint8, {0, 0, 0, 0}));
       },
       "has joints or weights for 1 of 3 vertices"},
      {[](GltfFile& f) {
         const int deltas =
             f.accessor<float>("VEC3", GltfFile::float32, {0, 0, std::nanf(""), 0, 0, 0, 0, 0, 0});
         f.primitive()["targets"] = {{{"POSITION", deltas}}};
         animate(f, 0, "weights", {0}, {0});
       },
       "/meshes/0/primitives/0/targets/0/POSITION: is not finite"},
      {[](GltfFile& f) {
         f.primitive()["targets"] = {
             {{"NORMAL", f.accessor<float>("VEC3", GltfFile::float32, {0, 0, 2})}}};
         animate(f, 0, "weights", {0}, {0});
       },
       "/meshes/0/primitives/0/targets/0/NORMAL: has 1 elements for 3 vertices"},
  };
  for (const auto& [change, problem] : cases) {
    GltfFile file;
    skin(file);
    animate(file, 1, "translation", {0}, {11, 0, 0});
    change(file);
    EXPECT_TRUE(contains(file.error(), problem));
  }
}

}  // namespace
