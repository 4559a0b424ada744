// How a glTF file is found, opened, refused: .gltf and .glb, URIs, JSON errors, hostile sizes.
#include <filesystem>

#include "tests/gltf_file.h"

namespace {

namespace fs = std::filesystem;
using lumivec::Scene;

std::string little(std::uint32_t x) {
  return {static_cast<char>(x), static_cast<char>(x >> 8), static_cast<char>(x >> 16),
          static_cast<char>(x >> 24)};
}

std::string glb(GltfFile& file) {
  file.root["buffers"][0].erase("uri");
  file.root["buffers"][0]["byteLength"] = file.bytes.size();
  std::string json = file.root.dump();
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bin(file.bytes.begin(), file.bytes.end());
  bin.resize((bin.size() + 3) / 4 * 4, '\0');
  return "glTF" + little(2) + little(static_cast<std::uint32_t>(28 + json.size() + bin.size())) +
         little(static_cast<std::uint32_t>(json.size())) + "JSON" + json +
         little(static_cast<std::uint32_t>(bin.size())) + std::string("BIN\0", 4) + bin;
}

std::string error_of(GltfFile& file, const std::string& name, const std::string& content) {
  file.write(name, content);
  try {
    lumivec::load_scene(file.folder / name, file.options, file.report);
  } catch (const lumivec::SceneError& e) {
    return e.what();
  }
  return {};
}

TEST(GltfContainer, LoadsTextWithExternalBuffer) {
  GltfFile file;
  const Scene scene = file.load();
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 1u);
  EXPECT_EQ(file.report.format, "glTF 2.0");
  EXPECT_TRUE(file.report.warnings.empty());
}

TEST(GltfContainer, LoadsBinary) {
  GltfFile file;
  file.write("scene.glb", glb(file));
  const Scene scene = lumivec::load_scene(file.folder / "scene.glb", {}, file.report);
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].positions[1], lumivec::V3f(1, 0, 0));
  EXPECT_EQ(file.report.format, "glTF 2.0 binary");
}

TEST(GltfContainer, GoesByContentAndNotByName) {
  GltfFile file;
  file.write("scene.txt", glb(file));
  EXPECT_EQ(lumivec::load_scene(file.folder / "scene.txt", {}, file.report).meshes.size(), 1u);
}

TEST(GltfContainer, LoadsDataUri) {
  GltfFile file;
  file.root["buffers"][0]["uri"] =
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
  EXPECT_EQ(file.load().meshes[0].positions[2], lumivec::V3f(0, 1, 0));
}

TEST(GltfContainer, PercentEncodedNamesAreDecoded) {
  GltfFile file;
  file.root["buffers"][0]["uri"] = "with%20space.bin";
  file.write("with space.bin", std::string(36, '\1'));
  EXPECT_EQ(file.load().meshes.size(), 1u);
}

TEST(GltfContainer, EveryTruncationOfABinaryIsAnError) {
  GltfFile file;
  const std::string whole = glb(file);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(error_of(file, "cut.glb", whole.substr(0, size)).empty()) << size;
  }
}

TEST(GltfContainer, SyntaxErrorsHaveLineAndColumn) {
  GltfFile file;
  EXPECT_TRUE(contains(error_of(file, "bad.gltf", "{\n  \"asset\": {,}\n}"), "line 2 column 13"));
}

TEST(GltfContainer, UnknownFilesAreToldWhatIsUnderstood) {
  GltfFile file;
  EXPECT_TRUE(contains(error_of(file, "a.obj", "v 0 0 0\n"), ".gltf or .glb"));
  EXPECT_TRUE(contains(error_of(file, "empty.gltf", ""), ".gltf or .glb"));
}

TEST(GltfContainer, MissingFilesAndFoldersAreErrors) {
  GltfFile file;
  EXPECT_THROW(lumivec::load_scene(file.folder / "none.gltf", {}, file.report),
               lumivec::SceneError);
  EXPECT_THROW(lumivec::load_scene(file.folder.path(), {}, file.report), lumivec::SceneError);
}

TEST(GltfContainer, DeepNestingIsAnError) {
  GltfFile file;
  const std::string deep =
      "{\"asset\":" + std::string(100000, '[') + std::string(100000, ']') + "}";
  EXPECT_TRUE(contains(error_of(file, "deep.gltf", deep), "deeper than"));
}

TEST(GltfContainer, MissingBufferNamesTheFile) {
  GltfFile file;
  file.root["buffers"][0]["uri"] = "lost.bin";
  EXPECT_TRUE(contains(file.error(), "/buffers/0/uri: file lost.bin does not exist"));
}

TEST(GltfContainer, ShortBufferIsAnError) {
  GltfFile file;
  file.root["buffers"][0]["uri"] = "short.bin";
  file.write("short.bin", "1234");
  EXPECT_TRUE(contains(file.error(), "/buffers/0: needs 36 bytes, but only 4"));
}

TEST(GltfContainer, NothingOutsideTheFolderIsRead) {
  TemporaryFolder elsewhere;
  std::ofstream(elsewhere / "secret.bin", std::ios::binary) << std::string(36, '\0');
  const std::string outside = (elsewhere / "secret.bin").string();
  const std::string climbing = "../" + elsewhere.path().filename().string() + "/secret.bin";
  for (const std::string& uri :
       {outside, "file://" + outside, climbing, "a/../" + climbing,
        "..%2F" + elsewhere.path().filename().string() + "%2fsecret.bin"}) {
    GltfFile file;
    file.root["buffers"][0]["uri"] = uri;
    EXPECT_TRUE(contains(file.error(), "outside the scene's folder")) << uri;
  }
}

TEST(GltfContainer, SymbolicLinksOutOfTheFolderAreRefused) {
  TemporaryFolder elsewhere;
  std::ofstream(elsewhere / "secret.bin", std::ios::binary) << std::string(36, '\1');
  GltfFile file;
  fs::create_symlink(elsewhere / "secret.bin", file.folder / "link.bin");
  file.root["buffers"][0]["uri"] = "link.bin";
  EXPECT_TRUE(contains(file.error(), "outside the scene's folder"));
  file.options.allow_outside_files = true;
  EXPECT_EQ(file.error(), "");
}

TEST(GltfContainer, SymbolicLinksInsideTheFolderAreFollowed) {
  GltfFile file;
  file.write();
  fs::create_symlink("data.bin", file.folder / "link.bin");
  file.root["buffers"][0]["uri"] = "link.bin";
  EXPECT_EQ(file.error(), "");
}

TEST(GltfContainer, NetworkIsRefused) {
  GltfFile file;
  file.root["buffers"][0]["uri"] = "https://example.com/data.bin";
  EXPECT_TRUE(contains(file.error(), "network"));
}

TEST(GltfContainer, DevicesAreRefused) {
  GltfFile file;
  file.options.allow_outside_files = true;
  file.root["buffers"][0]["uri"] = "/dev/zero";
  EXPECT_TRUE(contains(file.error(), "not a regular file"));
}

TEST(GltfContainer, ManyEmptyObjectsStopAtTheLimit) {
  GltfFile file;
  file.root["materials"] = std::vector<nlohmann::json>(10000, nlohmann::json::object());
  file.options.max_bytes = 1 << 20;
  EXPECT_TRUE(contains(file.error(), "limit"));
}

TEST(GltfContainer, RequiredExtensionsMustBeKnown) {
  GltfFile file;
  file.patch(R"({"extensionsUsed": ["X_new"], "extensionsRequired": ["X_new"]})");
  EXPECT_TRUE(contains(file.error(), "X_new is not supported"));
}

TEST(GltfContainer, UsedExtensionsNeedNotBeKnown) {
  GltfFile file;
  file.patch(R"({"extensionsUsed": ["X_new", "KHR_materials_ior"]})");
  file.load();
  EXPECT_EQ(file.report.extensions_used.size(), 2u);
  EXPECT_EQ(file.report.extensions_ignored, std::vector<std::string>{"X_new"});
  EXPECT_TRUE(file.warns("X_new"));
}

TEST(GltfContainer, WrongTypesNameTheirPlace) {
  const std::pair<const char*, const char*> cases[] = {
      {R"({"nodes": [{"mesh": "0"}]})", "/nodes/0/mesh: must be"},
      {R"({"nodes": [{"mesh": 1}]})", "/nodes/0/mesh: names element 1 of /meshes, which has 1"},
      {R"({"nodes": [{"mesh": -1}]})", "/nodes/0/mesh: must be"},
      {R"({"nodes": [{"mesh": 4294967296}]})", "/nodes/0/mesh: must be"},
      {R"({"nodes": [{"translation": [1, 2]}]})", "/nodes/0/translation: must be 3 numbers"},
      {R"({"nodes": 7})", "/nodes: must be an array"},
      {R"({"accessors": [{}]})", "/accessors/0: has no"},
      {R"({"asset": {"version": "1.0"}})", "version 1.0"},
  };
  for (const auto& [patch, expected] : cases) {
    GltfFile file;
    file.patch(patch);
    EXPECT_TRUE(contains(file.error(), expected));
  }
}

TEST(GltfContainer, WholeNumbersMayBeWrittenAsReals) {
  GltfFile file;
  file.patch(R"({"nodes": [{"mesh": 0.0}]})");
  EXPECT_EQ(file.load().instances.size(), 1u);
}

TEST(GltfContainer, NothingAtAllIsAnEmptyScene) {
  GltfFile file;
  file.root = nlohmann::json::parse(R"({"asset": {"version": "2.0"}})");
  file.write("scene.gltf", file.root.dump());
  const Scene scene = lumivec::load_scene(file.folder / "scene.gltf", {}, file.report);
  EXPECT_TRUE(scene.instances.empty());
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_TRUE(file.report.default_camera);
}

}  // namespace
