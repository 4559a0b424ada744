// Accessors: component types, normalisation, strides, sparse storage, and ranges that would leave
// their buffer.
#include "tests/gltf_file.h"

namespace {

using lumivec::Scene;
using lumivec::V2f;
using lumivec::V3f;

TEST(GltfAccessor, IndicesOfEveryType) {
  const auto check = [](auto value, int component) {
    GltfFile file;
    using T = decltype(value);
    file.primitive()["indices"] = file.accessor<T>("SCALAR", component, {T{2}, T{0}, T{1}});
    const Scene scene = file.load();
    EXPECT_EQ(scene.meshes[0].triangles[0], (Imath::Vec3<std::uint32_t>(2, 0, 1)));
  };
  check(std::uint8_t{}, GltfFile::uint8);
  check(std::uint16_t{}, GltfFile::uint16);
  check(std::uint32_t{}, GltfFile::uint32);
}

TEST(GltfAccessor, NormalizedTextureCoordinates) {
  GltfFile file;
  file.attribute("TEXCOORD_0", file.accessor<std::uint16_t>("VEC2", GltfFile::uint16,
                                                            {0, 65535, 0, 0, 0, 0}, true));
  EXPECT_EQ(file.load().meshes[0].uvs[0][0], V2f(0, 1));
}

TEST(GltfAccessor, QuantizedPositionsKeepTheirScale) {
  GltfFile file;
  file.attribute("POSITION", file.accessor<std::int16_t>("VEC3", GltfFile::int16,
                                                         {-300, 0, 0, 300, 0, 0, 0, 200, 0}));
  EXPECT_EQ(file.load().meshes[0].positions[0], V3f(-300, 0, 0));
}

TEST(GltfAccessor, NormalizedSignedBytesReachMinusOne) {
  GltfFile file;
  const int accessor =
      file.accessor<std::int8_t>("VEC3", GltfFile::int8, {-128, 0, 0, -127, 0, 0, 0, 127, 0}, true);
  file.attribute("POSITION", accessor);
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes[0].positions[0], V3f(-1, 0, 0));
  EXPECT_EQ(scene.meshes[0].positions[1], V3f(-1, 0, 0));
  EXPECT_EQ(scene.meshes[0].positions[2], V3f(0, 1, 0));
}

TEST(GltfAccessor, InterleavedAttributes) {
  GltfFile file;
  file.attribute("POSITION", file.accessor<float>("VEC3", GltfFile::float32,
                                                  {0, 0, 0, 9, 9, 1, 0, 0, 9, 9, 0, 1, 0, 9, 9}));
  file.root["bufferViews"].back()["byteStride"] = 20;
  file.root["accessors"].back()["count"] = 3;
  file.root["accessors"].push_back(file.root["accessors"].back());
  file.root["accessors"].back()["type"] = "VEC2";
  file.root["accessors"].back()["byteOffset"] = 12;
  file.attribute("TEXCOORD_0", static_cast<int>(file.root["accessors"].size()) - 1);
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes[0].positions[1], V3f(1, 0, 0));
  EXPECT_EQ(scene.meshes[0].uvs[0][2], V2f(9, 9));
}

nlohmann::json sparse(int indices, int values, int count) {
  return {{"count", count},
          {"indices", {{"bufferView", indices}, {"componentType", GltfFile::uint8}}},
          {"values", {{"bufferView", values}}}};
}

TEST(GltfAccessor, SparseReplacesElements) {
  GltfFile file;
  file.root["accessors"][0]["sparse"] =
      sparse(file.view<std::uint8_t>({1}), file.view<float>({5, 6, 7}), 1);
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes[0].positions[1], V3f(5, 6, 7));
  EXPECT_EQ(scene.meshes[0].positions[2], V3f(0, 1, 0));
}

TEST(GltfAccessor, SparseWithoutViewStartsFromZeros) {
  GltfFile file;
  file.root["accessors"][0].erase("bufferView");
  file.root["accessors"][0]["sparse"] =
      sparse(file.view<std::uint8_t>({0, 2}), file.view<float>({1, 0, 0, 0, 1, 0}), 2);
  const Scene scene = file.load();
  EXPECT_EQ(scene.meshes[0].positions[0], V3f(1, 0, 0));
  EXPECT_EQ(scene.meshes[0].positions[1], V3f(0, 0, 0));
  EXPECT_EQ(scene.meshes[0].positions[2], V3f(0, 1, 0));
}

TEST(GltfAccessor, SparseIndicesMustFitAndIncrease) {
  for (const std::vector<std::uint8_t>& indices :
       {std::vector<std::uint8_t>{0, 3}, {2, 1}, {1, 1}}) {
    GltfFile file;
    file.root["accessors"][0]["sparse"] =
        sparse(file.view(indices), file.view<float>({1, 0, 0, 0, 1, 0}), 2);
    EXPECT_TRUE(contains(file.error(), "/accessors/0/sparse/indices"));
  }
}

TEST(GltfAccessor, HostileNumbersAreRefused) {
  const std::pair<const char*, const char*> cases[] = {
      {"/accessors/0/count", "4000000000"},
      {"/accessors/0/count", "9007199254740992"},
      {"/accessors/0/count", "18446744073709551615"},
      {"/accessors/0/count", "1e300"},
      {"/accessors/0/byteOffset", "9007199254740992"},
      {"/accessors/0/byteOffset", "4"},
      {"/accessors/0/componentType", "5130"},
      {"/accessors/0/componentType", "5124"},
      {"/accessors/0/type", "\"VEC5\""},
      {"/accessors/0/type", "\"MAT4\""},
      {"/bufferViews/0/byteOffset", "9007199254740992"},
      {"/bufferViews/0/byteLength", "9007199254740992"},
      {"/bufferViews/0/byteStride", "9007199254740992"},
      {"/bufferViews/0/byteStride", "4"},
      {"/bufferViews/0/buffer", "1"},
  };
  for (const auto& [where, value] : cases) {
    GltfFile file;
    file.root[nlohmann::json::json_pointer(where)] = nlohmann::json::parse(value);
    EXPECT_NE(file.error(), "") << where << " = " << value;
  }
}

TEST(GltfAccessor, HugeSparseAccessorsStopAtTheLimit) {
  GltfFile file;
  file.root["accessors"][0].erase("bufferView");
  file.root["accessors"][0]["count"] = 4000000000u;
  file.root["accessors"][0]["sparse"] =
      sparse(file.view<std::uint8_t>({1}), file.view<float>({5, 6, 7}), 1);
  EXPECT_TRUE(contains(file.error(), "limit"));
}

TEST(GltfAccessor, MaxBytesBoundsGeometry) {
  GltfFile file;
  file.options.max_bytes = 40000;
  file.attribute("POSITION", file.accessor("VEC3", GltfFile::float32, std::vector<float>(9000)));
  EXPECT_TRUE(contains(file.error(), "limit"));
}

}  // namespace
