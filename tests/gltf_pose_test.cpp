// Morph targets and skins in the default pose.
#include "tests/gltf_file.h"

namespace {

using lumivec::M44d;
using lumivec::Scene;
using lumivec::V3f;

void morph(GltfFile& file) {
  const int deltas = file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 2, 0, 0, 0, 0, 0, 0});
  file.primitive()["targets"] = {{{"POSITION", deltas}}};
}

TEST(GltfPose, MorphTargetsByTheMeshsWeights) {
  GltfFile file;
  morph(file);
  file.root["meshes"][0]["weights"] = {0.5};
  EXPECT_EQ(file.load().meshes[0].positions[0], V3f(0, 0, 1));
}

TEST(GltfPose, MorphTargetsRestWithoutWeights) {
  GltfFile file;
  morph(file);
  EXPECT_EQ(file.load().meshes[0].positions[0], V3f(0));
}

TEST(GltfPose, NodesHaveTheirOwnWeights) {
  GltfFile file;
  morph(file);
  file.patch(R"({"scenes": [{"nodes": [0, 1, 2]}],
    "nodes": [{"mesh": 0, "weights": [1]}, {"mesh": 0}, {"mesh": 0, "weights": [1]}]})");
  const Scene scene = file.load();
  ASSERT_EQ(scene.meshes.size(), 2u);
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[2].mesh);
  EXPECT_EQ(scene.meshes[static_cast<std::size_t>(scene.instances[0].mesh)].positions[0],
            V3f(0, 0, 2));
  EXPECT_EQ(scene.meshes[static_cast<std::size_t>(scene.instances[1].mesh)].positions[0], V3f(0));
}

TEST(GltfPose, TooFewOrTooManyWeightsAreFine) {
  for (const char* weights : {"[]", "[1, 2, 3]"}) {
    GltfFile file;
    morph(file);
    file.root["meshes"][0]["weights"] = nlohmann::json::parse(weights);
    EXPECT_EQ(file.error(), "");
  }
}

TEST(GltfPose, TargetsMustFitTheMesh) {
  GltfFile file;
  const int deltas = file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 2});
  file.primitive()["targets"] = {{{"POSITION", deltas}}};
  file.root["meshes"][0]["weights"] = {1};
  EXPECT_TRUE(contains(file.error(), "/meshes/0/primitives/0/targets/0/POSITION"));
}

TEST(GltfPose, NormalsMorphAndStayUnit) {
  GltfFile file;
  file.attribute("NORMAL",
                 file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 1, 0, 0, 1, 0, 0, 1}));
  const int deltas = file.accessor<float>("VEC3", GltfFile::float32, {1, 0, 0, 0, 0, -1, 0, 0, 0});
  file.primitive()["targets"] = {{{"NORMAL", deltas}}};
  file.root["meshes"][0]["weights"] = {1};
  const Scene scene = file.load();
  EXPECT_NEAR((scene.meshes[0].normals[0] - V3f(1, 0, 1).normalized()).length(), 0.0f, 1e-6f);
  EXPECT_EQ(scene.meshes[0].normals[1], V3f(0, 0, 1));
}

// Node 0 shows the triangle, skinned to nodes 1 (at x = 10) and 2 (at y = 20, below 1).
void skin(GltfFile& file, const std::vector<std::uint8_t>& joints,
          const std::vector<float>& weights) {
  file.attribute("JOINTS_0", file.accessor("VEC4", GltfFile::uint8, joints));
  file.attribute("WEIGHTS_0", file.accessor("VEC4", GltfFile::float32, weights));
  file.patch(R"({"scenes": [{"nodes": [0, 1]}], "skins": [{"joints": [1, 2]}],
    "nodes": [{"mesh": 0, "skin": 0, "translation": [7, 7, 7]},
              {"children": [2], "translation": [10, 0, 0]}, {"translation": [0, 20, 0]}]})");
}

TEST(GltfPose, SkinsPlaceTheirVerticesInTheWorld) {
  GltfFile file;
  skin(file, {0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, {1, 0, 0, 0, .5f, .5f, 0, 0, 0, 2, 0, 0});
  const Scene scene = file.load();
  EXPECT_EQ(scene.instances[0].object_to_world, M44d());  // not the node's
  EXPECT_EQ(scene.meshes[0].positions[0], V3f(10, 0, 0));
  EXPECT_EQ(scene.meshes[0].positions[1], V3f(11, 10, 0));
  EXPECT_EQ(scene.meshes[0].positions[2], V3f(10, 21, 0));  // weights need not sum to 1
}

TEST(GltfPose, InverseBindMatricesComeFirst) {
  GltfFile file;
  const std::vector<std::uint8_t> joints(12, 0);
  skin(file, joints, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  file.root["skins"][0]["inverseBindMatrices"] = file.accessor<float>(
      "MAT4", GltfFile::float32, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -10, 5, 0, 1,  //
                                  1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0,   0, 0, 1});
  EXPECT_EQ(file.load().meshes[0].positions[1], V3f(1, 5, 0));
}

TEST(GltfPose, SkinnedNormalsTurnWithTheirJoints) {
  GltfFile file;
  const std::vector<std::uint8_t> joints(12, 0);
  skin(file, joints, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  file.attribute("NORMAL",
                 file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 1, 0, 0, 1, 0, 0, 1}));
  file.root["nodes"][1]["rotation"] = {0, 0.7071067811865476, 0, 0.7071067811865476};
  EXPECT_NEAR((file.load().meshes[0].normals[0] - V3f(1, 0, 0)).length(), 0.0f, 1e-6f);
}

TEST(GltfPose, JointsOutOfRangeAreErrors) {
  GltfFile file;
  const std::vector<std::uint8_t> joints(12, 2);
  skin(file, joints, {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  EXPECT_TRUE(contains(file.error(), "hangs on joint 2 of 2"));
}

TEST(GltfPose, NegativeWeightsAreErrors) {
  GltfFile file;
  const std::vector<std::uint8_t> joints(12, 0);
  skin(file, joints, {-1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  EXPECT_TRUE(contains(file.error(), "weights of vertex 0"));
}

TEST(GltfPose, SkinsWithoutJointsAreAWarning) {
  GltfFile file;
  skin(file, std::vector<std::uint8_t>(12, 0), std::vector<float>(12, 1.0f));
  file.primitive()["attributes"].erase("JOINTS_0");
  const Scene scene = file.load();
  EXPECT_EQ(scene.instances[0].object_to_world[3][0], 7.0);
  EXPECT_TRUE(file.warns("no joints"));
}

TEST(GltfPose, MirroringSkeletonsKeepTheFrontInFront) {
  GltfFile file;
  skin(file, std::vector<std::uint8_t>(12, 0), {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0});
  file.attribute("NORMAL",
                 file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 1, 0, 0, 1, 0, 0, 1}));
  file.root["nodes"][1]["scale"] = {-1, 1, 1};
  const Scene scene = file.load();
  const auto& mesh = scene.meshes[0];
  const auto& t = mesh.triangles[0];
  const V3f n =
      (mesh.positions[t.y] - mesh.positions[t.x]).cross(mesh.positions[t.z] - mesh.positions[t.x]);
  EXPECT_GT(n.dot(mesh.normals[0]), 0.0f);
}

}  // namespace
