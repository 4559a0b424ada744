// Meshes whose vertices animations move: morph targets, joints, and both.
#include "loader/deform.h"

#include <cmath>
#include <numbers>

#include "loader/animate.h"
#include "tests/animated_file.h"
#include "tests/scene_bits.h"

namespace {

using lumivec::M44d;
using lumivec::Mesh;
using lumivec::pose_scene;
using lumivec::PoseChanges;
using lumivec::Scene;
using lumivec::V3d;
using lumivec::V3f;
using lumivec::V4f;
using Indices = std::vector<int>;

PoseChanges rest(Scene& scene) {
  return pose_scene(scene, std::span<const lumivec::PlayedAnimation>());
}

void expect_near(const V3d& a, const V3d& b, double tolerance = 1e-6) {
  EXPECT_NEAR((a - b).length(), 0.0, tolerance) << a << " " << b;
}

const float half_turn_sine = std::numbers::sqrt2_v<float> / 2.0f;  // of a quaternion of 90 degrees

// Two targets that move vertex 0 to z = 2 and vertex 1 to y = 1, and turn the first normal.
void morph(GltfFile& file) {
  file.attribute("NORMAL",
                 file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 1, 0, 0, 1, 0, 0, 1}));
  const int up = file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 2, 0, 0, 0, 0, 0, 0});
  const int turn = file.accessor<float>("VEC3", GltfFile::float32, {1, 0, 0, 0, 0, 0, 0, 0, 0});
  const int side = file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 0, 0, 1, 0, 0, 0, 0});
  file.primitive()["targets"] = {{{"POSITION", up}, {"NORMAL", turn}}, {{"POSITION", side}}};
}

TEST(Deform, WeightsMorphVertices) {
  GltfFile file;
  morph(file);
  file.root["meshes"][0]["weights"] = {0, 1};
  animate(file, 0, "weights", {0, 1}, {0, 0, 1, 0.5f});
  Scene scene = file.load();
  EXPECT_EQ(scene.meshes[0].positions[1], V3f(1, 1, 0));  // at rest, by the mesh
  const PoseChanges changes = pose_scene(scene, 0, 0.5);
  EXPECT_EQ(changes.meshes, Indices{0});
  EXPECT_TRUE(changes.instances.empty());
  const Mesh& mesh = scene.meshes[0];
  EXPECT_EQ(mesh.positions, (std::vector<V3f>{{0, 0, 1}, {1, 0.25f, 0}, {0, 1, 0}}));
  EXPECT_NEAR((mesh.normals[0] - V3f(0.5f, 0, 1).normalized()).length(), 0.0f, 1e-6f);
  EXPECT_TRUE(pose_scene(scene, 0, 0.5).empty());
  rest(scene);
  EXPECT_EQ(difference(scene, file.load()), "");
}

TEST(Deform, EachNodeMorphsItsOwnMesh) {
  GltfFile file;
  morph(file);
  file.patch(R"({"scenes": [{"nodes": [0, 1, 2, 3]}],
    "nodes": [{"mesh": 0}, {"mesh": 0}, {"mesh": 0}, {"mesh": 0}]})");
  animate(file, 1, "weights", {0}, {1, 0});
  animate(file, 2, "weights", {0}, {0, 1}, "LINEAR", 1);
  Scene scene = file.load();
  ASSERT_EQ(scene.meshes.size(), 3u);
  EXPECT_EQ(scene.instances[0].mesh, scene.instances[3].mesh);
  EXPECT_EQ(pose_scene(scene, 0, 0.0).meshes, Indices{scene.instances[1].mesh});
  EXPECT_EQ(scene.meshes[0].positions[0], V3f(0));
  EXPECT_EQ(scene.meshes[1].positions[0], V3f(0, 0, 2));
  EXPECT_EQ(scene.meshes[2].positions[0], V3f(0));
}

TEST(Deform, TangentsFollowMorphedNormals) {
  GltfFile file;
  morph(file);
  file.attribute("TANGENT", file.accessor<float>("VEC4", GltfFile::float32,
                                                 {1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, -1}));
  animate(file, 0, "weights", {0, 1}, {0, 0, 1, 0});
  Scene scene = file.load();
  pose_scene(scene, 0, 1.0);
  const Mesh& mesh = scene.meshes[0];
  const V4f& t = mesh.tangents[0];
  EXPECT_NEAR(V3f(t.x, t.y, t.z).dot(mesh.normals[0]), 0.0f, 1e-6f);
  EXPECT_NEAR(V3f(t.x, t.y, t.z).length(), 1.0f, 1e-6f);
  EXPECT_EQ(mesh.tangents[2], V4f(1, 0, 0, -1));
}

TEST(Deform, JointsMoveVertices) {
  GltfFile file;
  skin(file);
  // A quarter turn about y, which is +Z to +X.
  animate(file, 1, "rotation", {0, 1}, {0, 0, 0, 1, 0, half_turn_sine, 0, half_turn_sine});
  animate(file, 2, "translation", {0, 1}, {0, 20, 0, 0, 24, 0});
  Scene scene = file.load();
  EXPECT_EQ(scene.meshes[0].positions[1], V3f(1, 0, 0));
  const PoseChanges changes = pose_scene(scene, 0, 1.0);
  EXPECT_EQ(changes.meshes, Indices{0});
  EXPECT_TRUE(changes.instances.empty());
  const Mesh& mesh = scene.meshes[0];
  expect_near(V3d(mesh.positions[0]), V3d(10, 0, 10));
  // Both joints turn about x = 10, the second one lifts by 4 and has three quarters of the weight.
  expect_near(V3d(mesh.positions[1]), V3d(10, 3, 9));
  EXPECT_EQ(mesh.positions[2], V3f(0, 1, 0));
  expect_near(V3d(mesh.normals[0]), V3d(1, 0, 0));
  EXPECT_EQ(scene.instances[0].object_to_world, M44d());
  EXPECT_TRUE(pose_scene(scene, 0, 1.0).empty());
  rest(scene);
  EXPECT_EQ(difference(scene, file.load()), "");
}

TEST(Deform, SkinsAgreeWithTheirClosedForm) {
  GltfFile file;
  skin(file);
  animate(file, 1, "rotation", {0, 1}, {0, 0, 0, 1, 0.6f, 0, 0, 0.8f});
  animate(file, 1, "scale", {0, 1}, {1, 1, 1, 1, 2, 0.5f});
  animate(file, 2, "rotation", {0, 1}, {0, 0, 0, 1, 0, 0, 0.28f, 0.96f});
  Scene scene = file.load();
  pose_scene(scene, 0, 1.0);
  const auto turn = [](const V3d& axis, double sine, double cosine) {
    M44d m;
    m.setAxisAngle(axis, 2.0 * std::atan2(sine, cosine));
    return m;
  };
  const auto shift = [](const V3d& by) { return M44d().setTranslation(by); };
  const M44d joint0 =
      M44d().setScale(V3d(1, 2, 0.5)) * turn({1, 0, 0}, 0.6, 0.8) * shift({10, 0, 0});
  const M44d joint1 = turn({0, 0, 1}, 0.28, 0.96) * shift({0, 20, 0}) * joint0;
  const M44d blend = shift({-10, 0, 0}) * joint0 * 0.25 + shift({-10, -20, 0}) * joint1 * 0.75;
  V3d position;
  blend.multVecMatrix(V3d(1, 0, 0), position);
  expect_near(V3d(scene.meshes[0].positions[1]), position, 1e-5);
  V3d normal;
  blend.inverse().transposed().multDirMatrix(V3d(0, 0, 1), normal);
  expect_near(V3d(scene.meshes[0].normals[1]), normal.normalized(), 1e-6);
}

TEST(Deform, JointsOutsideTheSceneMoveVerticesToo) {
  GltfFile file;
  skin(file);
  file.root["scenes"][0]["nodes"] = {0};
  animate(file, 1, "translation", {0}, {11, 0, 0});
  Scene scene = file.load();
  EXPECT_EQ(pose_scene(scene, 0, 0.0).meshes, Indices{0});
  EXPECT_EQ(scene.meshes[0].positions[0], V3f(1, 0, 0));
}

TEST(Deform, SkinnedMeshesAreSharedAndPosedOnce) {
  GltfFile file;
  skin(file);
  file.root["nodes"].push_back({{"mesh", 0}, {"skin", 0}});
  file.root["scenes"][0]["nodes"] = {0, 1, 3};
  animate(file, 1, "translation", {0}, {11, 0, 0});
  Scene scene = file.load();
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.motion.deformations.size(), 1u);
  EXPECT_EQ(pose_scene(scene, 0, 0.0).meshes, Indices{0});
}

TEST(Deform, MirroringJointsTurnTheTriangles) {
  GltfFile file;
  skin(file);
  animate(file, 1, "scale", {0, 1}, {1, 1, 1, -1, 1, 1}, "STEP");
  Scene scene = file.load();
  const Scene loaded = scene;
  pose_scene(scene, 0, 1.0);
  const Mesh& mesh = scene.meshes[0];
  const auto& t = mesh.triangles[0];
  const V3f n =
      (mesh.positions[t.y] - mesh.positions[t.x]).cross(mesh.positions[t.z] - mesh.positions[t.x]);
  EXPECT_GT(n.dot(mesh.normals[0]), 0.0f);
  EXPECT_NE(mesh.triangles, loaded.meshes[0].triangles);
  rest(scene);
  EXPECT_EQ(difference(scene, loaded), "");
}

TEST(Deform, JointsThatScaleToNothingAreHarmless) {
  GltfFile file;
  skin(file);
  animate(file, 1, "scale", {0, 1}, {1, 1, 1, 0, 0, 0});
  Scene scene = file.load();
  pose_scene(scene, 0, 1.0);
  for (const V3f& n : scene.meshes[0].normals) EXPECT_NEAR(n.length(), 1.0f, 1e-6f);
  EXPECT_EQ(scene.meshes[0].positions[0], V3f(10, 0, 0));
}

TEST(Deform, MorphsAndSkinsTogether) {
  GltfFile file;
  skin(file);
  const int up = file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 2, 0, 0, 0, 0, 0, 0});
  file.primitive()["targets"] = {{{"POSITION", up}}};
  file.root["meshes"][0]["weights"] = {0.5};
  animate(file, 1, "translation", {0}, {11, 0, 0});    // the weight stays at rest
  animate(file, 0, "weights", {0}, {1}, "LINEAR", 1);  // the joints do
  Scene scene = file.load();
  EXPECT_EQ(scene.meshes[0].positions[0], V3f(0, 0, 1));
  pose_scene(scene, 0, 0.0);
  EXPECT_EQ(scene.meshes[0].positions[0], V3f(1, 0, 1));
  pose_scene(scene, 1, 0.0);
  EXPECT_EQ(scene.meshes[0].positions[0], V3f(0, 0, 2));
  rest(scene);
  EXPECT_EQ(difference(scene, file.load()), "");
}

// Neither of which anything changes.
TEST(Deform, MeshesThatStayAreNotKept) {
  GltfFile file;
  skin(file);
  EXPECT_TRUE(file.load().motion.deformations.empty());
  animate(file, 0, "translation", {0}, {1, 0, 0});  // joints place the mesh, its node does not
  Scene scene = file.load();
  EXPECT_TRUE(scene.motion.deformations.empty());
  EXPECT_TRUE(pose_scene(scene, 0, 0.0).empty());
}

TEST(Deform, VerticesThatFlyTooFarHideTheirInstances) {
  GltfFile file;
  morph(file);
  const int far = file.accessor<float>("VEC3", GltfFile::float32, {3e38f, 0, 0, 0, 0, 0, 0, 0, 0});
  file.primitive()["targets"] = {{{"POSITION", far}}};
  animate(file, 0, "weights", {0, 1}, {0, 1e9f});
  Scene scene = file.load();
  const PoseChanges changes = pose_scene(scene, 0, 1.0);
  EXPECT_EQ(changes.instances, Indices{0});
  EXPECT_EQ(changes.meshes, Indices{0});
  EXPECT_FALSE(scene.instances[0].visible);
  for (const V3f& p : scene.meshes[0].positions) EXPECT_TRUE(std::isfinite(p.length()));
  rest(scene);
  EXPECT_EQ(difference(scene, file.load()), "");
}

TEST(Deform, TangentsOfTheFileAreMadeBeforeItMoves) {
  GltfFile file;
  skin(file);
  // The second triangle mirrors the texture, and shares an edge.
  file.attribute("TEXCOORD_0", file.accessor<float>("VEC2", GltfFile::float32, {0, 0, 1, 0, 0, 1}));
  file.primitive()["indices"] =
      file.accessor<std::uint8_t>("SCALAR", GltfFile::uint8, {0, 1, 2, 0, 2, 1});
  file.root["images"] = {
      {{"uri",
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADU"
        "lEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=="}}};
  file.root["textures"] = {{{"source", 0}}};
  file.material(R"({"normalTexture": {"index": 0}})");
  animate(file, 1, "rotation", {0, 1}, {0, 0, 0, 1, 0, half_turn_sine, 0, half_turn_sine});
  Scene scene = file.load();
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.positions.size(), 6u);
  ASSERT_EQ(mesh.tangents.size(), 6u);
  EXPECT_EQ(scene.motion.deformations[0].joint_sets[0].weights.size(), 6u);
  pose_scene(scene, 0, 1.0);
  EXPECT_NEAR((mesh.tangents[0] - V4f(0, 0, -1, mesh.tangents[0].w)).length(), 0.0f, 1e-6f);
  rest(scene);
  EXPECT_EQ(difference(scene, file.load()), "");
}

TEST(Deform, SpheresThatMorphAreMeshes) {
  GltfFile file;
  morph(file);
  file.primitive()["extras"] = {{"sphere", {{"radius", 1}}}};
  animate(file, 0, "weights", {0}, {0, 0});
  const Scene scene = file.load();
  EXPECT_TRUE(scene.spheres.empty());
  EXPECT_EQ(scene.meshes.size(), 1u);
}

}  // namespace
