// Primitives as meshes: modes, indices, normals, tangents, colours, shared vertices, and exact
// spheres.
#include <cmath>
#include <numbers>

#include "tests/gltf_file.h"

namespace {

using lumivec::Mesh;
using lumivec::Scene;
using lumivec::V2f;
using lumivec::V3f;
using lumivec::V4f;
using Triangle = Imath::Vec3<std::uint32_t>;

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

// Five points in a convex row, zigzag: every mode makes sense of them.
GltfFile& five_points(GltfFile& file, int mode) {
  file.attribute("POSITION", file.accessor<float>("VEC3", GltfFile::float32,
                                                  {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0, 2, 0, 0}));
  file.primitive()["mode"] = mode;
  return file;
}

TEST(GltfPrimitive, StripsKeepTheirWinding) {
  GltfFile file;
  EXPECT_EQ(five_points(file, 5).load().meshes[0].triangles,
            (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}));
}

TEST(GltfPrimitive, FansTurnAroundTheirFirstVertex) {
  GltfFile file;
  EXPECT_EQ(five_points(file, 6).load().meshes[0].triangles,
            (std::vector<Triangle>{{1, 2, 0}, {2, 3, 0}, {3, 4, 0}}));
}

TEST(GltfPrimitive, ListsDropAnUnfinishedTriangle) {
  GltfFile file;
  const Scene scene = five_points(file, 4).load();
  EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
  EXPECT_TRUE(file.warns("whole triangles"));
}

TEST(GltfPrimitive, PointsAndLinesAreLeftOutWithAWarning) {
  for (const int mode : {0, 1, 2, 3}) {
    GltfFile file;
    EXPECT_TRUE(five_points(file, mode).load().instances.empty());
    EXPECT_TRUE(file.warns("points and lines")) << mode;
  }
}

TEST(GltfPrimitive, UnknownModesAreErrors) {
  GltfFile file;
  EXPECT_TRUE(contains(five_points(file, 7).error(), "mode 7"));
}

TEST(GltfPrimitive, IndicesOutOfRangeAreErrors) {
  GltfFile file;
  file.primitive()["indices"] = file.accessor<std::uint8_t>("SCALAR", GltfFile::uint8, {0, 1, 3});
  EXPECT_TRUE(contains(file.error(), "index 3, but there are 3 vertices"));
}

TEST(GltfPrimitive, RestartValuesAreErrors) {
  GltfFile file;
  file.primitive()["indices"] =
      file.accessor<std::uint16_t>("SCALAR", GltfFile::uint16, {0, 1, 65535});
  EXPECT_TRUE(contains(file.error(), "restart"));
}

TEST(GltfPrimitive, TrianglesWithARepeatedVertexAreDropped) {
  GltfFile file;
  file.primitive()["indices"] =
      file.accessor<std::uint8_t>("SCALAR", GltfFile::uint8, {0, 1, 1, 0, 1, 2, 2, 1, 2});
  EXPECT_EQ(file.load().meshes[0].triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(GltfPrimitive, OnlyTheVerticesInUseAreKept) {
  GltfFile file;
  std::vector<float> positions(3 * 1000, 7.0f);
  for (int i = 0; i < 3; ++i) positions[static_cast<std::size_t>(3 * 400 * i)] = float(i);
  positions[1] = 8;
  file.attribute("POSITION", file.accessor<float>("VEC3", GltfFile::float32, positions));
  file.primitive()["indices"] =
      file.accessor<std::uint16_t>("SCALAR", GltfFile::uint16, {800, 0, 400});
  const Scene scene = file.load();
  ASSERT_EQ(scene.meshes[0].positions.size(), 3u);
  EXPECT_EQ(scene.meshes[0].triangles[0], Triangle(2, 0, 1));
  EXPECT_EQ(scene.meshes[0].positions[2].x, 2.0f);
  EXPECT_EQ(scene.meshes[0].positions[0], V3f(0, 8, 7));
}

TEST(GltfPrimitive, PositionsMustBeFinite) {
  for (const float bad : {inf, -inf, nan}) {
    GltfFile file;
    file.attribute("POSITION",
                   file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 0, 1, bad, 0, 0, 1, 0}));
    EXPECT_TRUE(contains(file.error(), "vertex 1 is not finite"));
  }
}

TEST(GltfPrimitive, MissingNormalsMeanFlat) {
  GltfFile file;
  EXPECT_TRUE(file.load().meshes[0].normals.empty());
}

TEST(GltfPrimitive, UselessNormalsBecomeGeometric) {
  GltfFile file;
  file.attribute("NORMAL",
                 file.accessor<float>("VEC3", GltfFile::float32, {0, 3, 4, 0, 0, 0, nan, 0, inf}));
  const Scene scene = file.load();
  ASSERT_EQ(scene.meshes[0].normals.size(), 3u);
  EXPECT_NEAR((scene.meshes[0].normals[0] - V3f(0, 0.6f, 0.8f)).length(), 0.0f, 1e-6f);
  EXPECT_EQ(scene.meshes[0].normals[1], V3f(0, 0, 1));
  EXPECT_EQ(scene.meshes[0].normals[2], V3f(0, 0, 1));
  EXPECT_TRUE(file.warns("2 normals"));
}

TEST(GltfPrimitive, OnlyZeroNormalsMeanFlat) {
  GltfFile file;
  file.attribute("NORMAL",
                 file.accessor<float>("VEC3", GltfFile::float32, std::vector<float>(9, 0.0f)));
  EXPECT_TRUE(file.load().meshes[0].normals.empty());
}

TEST(GltfPrimitive, ColorsOfThreeAndFourComponents) {
  GltfFile file;
  file.attribute("COLOR_0", file.accessor<std::uint8_t>("VEC3", GltfFile::uint8,
                                                        {255, 0, 51, 0, 0, 0, 0, 0, 0}, true));
  EXPECT_EQ(file.load().meshes[0].colors[0], V4f(1, 0, 0.2f, 1));
  GltfFile other;
  other.attribute("COLOR_0", other.accessor<float>("VEC4", GltfFile::float32,
                                                   {1, .5f, 2, .25f, 0, 0, 0, 0, nan, 0, 0, -1}));
  const Scene scene = other.load();
  EXPECT_EQ(scene.meshes[0].colors[0], V4f(1, .5f, 1, .25f));
  EXPECT_EQ(scene.meshes[0].colors[2], V4f(1, 0, 0, 0));
  EXPECT_TRUE(other.warns("2 vertex colors"));
}

TEST(GltfPrimitive, SeveralUvSets) {
  GltfFile file;
  for (const char* set : {"TEXCOORD_0", "TEXCOORD_1"}) {
    file.attribute(set, file.accessor<float>("VEC2", GltfFile::float32, {0, 0, 1, nan, 0, 1}));
  }
  const Scene scene = file.load();
  ASSERT_EQ(scene.meshes[0].uvs.size(), 2u);
  EXPECT_EQ(scene.meshes[0].uvs[1][1], V2f(0));
  EXPECT_TRUE(file.warns("texture coordinates"));
}

TEST(GltfPrimitive, AttributesMustBeAsLongAsPositions) {
  GltfFile file;
  file.attribute("TEXCOORD_0", file.accessor<float>("VEC2", GltfFile::float32, {0, 0, 1, 0}));
  EXPECT_TRUE(contains(file.error(), "TEXCOORD_0: has 2 elements for 3 vertices"));
}

TEST(GltfPrimitive, NodesShareTheMeshOfAPrimitive) {
  GltfFile file;
  file.patch(R"({"scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 0}]})");
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.instances.size(), 2u);
}

TEST(GltfPrimitive, MeshesThatDifferByMaterialShareVertices) {
  GltfFile file;
  file.patch(R"({"materials": [{"name": "a"}, {"name": "b"}],
                 "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 1}]})");
  file.root["meshes"].push_back(file.root["meshes"][0]);
  file.primitive()["material"] = 0;
  file.root["meshes"][1]["primitives"][0]["material"] = 1;
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes.size(), 1u);
  EXPECT_NE(scene.instances[0].material, scene.instances[1].material);
}

// An upright unit square towards +Z whose picture stands upright too (v grows downwards), or is
// mirrored.
void square(GltfFile& file, bool mirrored) {
  const float left = mirrored ? 1 : 0;
  const float right = 1 - left;
  file.attribute("POSITION", file.accessor<float>("VEC3", GltfFile::float32,
                                                  {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  file.attribute("NORMAL", file.accessor<float>("VEC3", GltfFile::float32,
                                                {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}));
  file.attribute("TEXCOORD_0", file.accessor<float>("VEC2", GltfFile::float32,
                                                    {left, 1, right, 1, right, 0, left, 0}));
  file.primitive()["indices"] =
      file.accessor<std::uint8_t>("SCALAR", GltfFile::uint8, {0, 1, 2, 0, 2, 3});
  file.material(R"({"normalTexture": {"index": 0}})");
  file.patch(R"({"textures": [{"source": 0}], "images": [{"uri": "none.png"}]})");
}

TEST(GltfPrimitive, TangentsFollowTheNormalMap) {
  GltfFile file;
  square(file, false);
  const Scene scene = file.load();
  for (const V4f& t : scene.meshes[0].tangents) {
    EXPECT_NEAR((t - V4f(1, 0, 0, 1)).length(), 0.0f, 1e-6f);
  }
  GltfFile mirror;
  square(mirror, true);
  const Scene mirrored = mirror.load();
  ASSERT_EQ(mirrored.meshes[0].tangents.size(), 4u);
  for (const V4f& t : mirrored.meshes[0].tangents) {
    EXPECT_NEAR((t - V4f(-1, 0, 0, -1)).length(), 0.0f, 1e-6f);
  }
}

TEST(GltfPrimitive, TangentsFollowARotatedMap) {
  GltfFile file;
  square(file, false);
  file.root["materials"][0]["normalTexture"]["extensions"]["KHR_texture_transform"] = {
      {"rotation", std::numbers::pi / 2}};
  const Scene scene = file.load();
  for (const V4f& t : scene.meshes[0].tangents) {  // u grows where v grew: downwards
    EXPECT_NEAR((t - V4f(0, -1, 0, 1)).length(), 0.0f, 1e-5f);
  }
}

TEST(GltfPrimitive, MirroredSeamsGetTheirOwnVertices) {
  GltfFile file;
  file.attribute("POSITION", file.accessor<float>("VEC3", GltfFile::float32,
                                                  {0, 0, 0, 1, 0, 0, 0, 1, 0, -1, 0, 0}));
  file.attribute("NORMAL", file.accessor<float>("VEC3", GltfFile::float32,
                                                {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}));
  file.attribute("TEXCOORD_0",
                 file.accessor<float>("VEC2", GltfFile::float32, {0, 1, 1, 1, 0, 0, 1, 1}));
  file.primitive()["indices"] =
      file.accessor<std::uint8_t>("SCALAR", GltfFile::uint8, {0, 1, 2, 0, 2, 3});
  file.material(R"({"normalTexture": {"index": 0}})");
  file.patch(R"({"textures": [{"source": 0}], "images": [{"uri": "none.png"}]})");
  const Mesh mesh = file.load().meshes[0];
  ASSERT_EQ(mesh.positions.size(), 6u);
  EXPECT_EQ(mesh.normals.size(), 6u);
  EXPECT_EQ(mesh.uvs[0].size(), 6u);
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(mesh.tangents[mesh.triangles[0][c]], V4f(1, 0, 0, 1));
    EXPECT_EQ(mesh.tangents[mesh.triangles[1][c]], V4f(-1, 0, 0, -1));
  }
}

TEST(GltfPrimitive, EqualVerticesShareTheirTangent) {
  GltfFile file;  // two triangles without indices, whose textures are sheared against each other
  file.attribute("POSITION",
                 file.accessor<float>("VEC3", GltfFile::float32,
                                      {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0}));
  file.attribute("NORMAL", file.accessor<float>("VEC3", GltfFile::float32,
                                                {0, 0, 1, 0, 0, 1, 0, 0, 1,  //
                                                 0, 0, 1, 0, 0, 1, 0, 0, 1}));
  file.attribute("TEXCOORD_0", file.accessor<float>("VEC2", GltfFile::float32,
                                                    {0, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, -1}));
  file.material(R"({"normalTexture": {"index": 0}})");
  file.patch(R"({"textures": [{"source": 0}], "images": [{"uri": "none.png"}]})");
  const Scene scene = file.load();
  const Mesh& mesh = scene.meshes[0];
  ASSERT_EQ(mesh.tangents.size(), 6u);
  EXPECT_EQ(mesh.tangents[1], mesh.tangents[4]);
  EXPECT_EQ(mesh.tangents[2], mesh.tangents[3]);
  EXPECT_NE(mesh.tangents[0], mesh.tangents[5]);
}

TEST(GltfPrimitive, GivenTangentsAreKept) {
  GltfFile file;
  square(file, false);
  file.attribute("TANGENT",
                 file.accessor<float>("VEC4", GltfFile::float32,
                                      {0, 2, 0, -1, 0, 1, 0, -1, 0, 1, 0, -1, 0, 0, 0, 1}));
  const Mesh mesh = file.load().meshes[0];
  EXPECT_EQ(mesh.tangents[0], V4f(0, 1, 0, -1));
  EXPECT_EQ(mesh.tangents[3].z, 0.0f);
  EXPECT_TRUE(file.warns("1 tangents"));
}

// Four corners of a tetrahedron on the sphere.
void tetrahedron(GltfFile& file, float radius) {
  const float a = radius / std::sqrt(3.0f);
  file.attribute("POSITION", file.accessor<float>("VEC3", GltfFile::float32,
                                                  {a, a, a, -a, -a, a, -a, a, -a, a, -a, -a}));
  file.primitive()["indices"] =
      file.accessor<std::uint8_t>("SCALAR", GltfFile::uint8, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3});
}

TEST(GltfPrimitive, DeclaredSpheresBecomeExact) {
  GltfFile file;
  tetrahedron(file, 2.0f);
  file.primitive()["extras"] = {{"sphere", {{"radius", 2.0}}}, {"note", "kept out"}};
  file.patch(R"({"scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0}, {"mesh": 0}]})");
  const Scene scene = file.load();
  ASSERT_EQ(scene.spheres.size(), 1u);
  EXPECT_EQ(scene.spheres[0].radius, 2.0f);
  EXPECT_TRUE(scene.meshes.empty());
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[1].sphere, 0);
  EXPECT_EQ(scene.instances[1].mesh, -1);
  EXPECT_TRUE(file.report.warnings.empty());
}

TEST(GltfPrimitive, FalseSpheresStayMeshesWithAWarning) {
  for (const char* extras : {R"({"sphere": {"radius": 2.1}})", R"({"sphere": {"radius": -2}})",
                             R"({"sphere": {"radius": "2"}})", R"({"sphere": 2})"}) {
    GltfFile file;
    tetrahedron(file, 2.0f);
    file.root["meshes"][0]["name"] = "egg";
    file.primitive()["extras"] = nlohmann::json::parse(extras);
    const Scene scene = file.load();
    EXPECT_EQ(scene.meshes.size(), 1u) << extras;
    EXPECT_TRUE(scene.spheres.empty());
    EXPECT_TRUE(file.warns("egg")) << extras;
  }
}

TEST(GltfPrimitive, OtherExtrasMeanNothing) {
  for (const char* extras : {"1", "\"sphere\"", "[]", "{}", R"({"cube": 1})"}) {
    GltfFile file;
    file.primitive()["extras"] = nlohmann::json::parse(extras);
    EXPECT_EQ(file.load().meshes.size(), 1u);
    EXPECT_TRUE(file.report.warnings.empty());
  }
}

TEST(GltfPrimitive, WithoutDataItIsLeftOut) {
  GltfFile file;
  file.root["accessors"][0].erase("bufferView");
  EXPECT_TRUE(file.load().instances.empty());
  GltfFile other;
  other.primitive()["attributes"] = nlohmann::json::object();
  EXPECT_TRUE(other.load().instances.empty());
}

}  // namespace
