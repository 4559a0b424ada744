// Every file of the handed corpora: what is valid loads, what is not fails in one line, and nothing
// is inconsistent.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "loader/error.h"
#include "loader/load_scene.h"

namespace {

namespace fs = std::filesystem;
using lumivec::Mesh;
using lumivec::Scene;

template <class T>
bool in_range(int index, const std::vector<T>& array) {
  return index >= 0 && static_cast<std::size_t>(index) < array.size();
}

template <class Vector>
bool finite(const std::vector<Vector>& array) {
  for (const Vector& v : array) {
    for (unsigned i = 0; i < Vector::dimensions(); ++i) {
      if (!std::isfinite(v[static_cast<int>(i)])) return false;
    }
  }
  return true;
}

void expect_consistent(const Mesh& mesh) {
  const std::size_t count = mesh.positions.size();
  EXPECT_TRUE(finite(mesh.positions) && finite(mesh.normals));
  EXPECT_TRUE(mesh.normals.empty() || mesh.normals.size() == count);
  EXPECT_TRUE(mesh.tangents.empty() || mesh.tangents.size() == count);
  EXPECT_TRUE(mesh.colors.empty() || mesh.colors.size() == count);
  for (const auto& uvs : mesh.uvs) EXPECT_EQ(uvs.size(), count);
  for (const auto& n : mesh.normals) EXPECT_NEAR(n.length(), 1.0f, 1e-4f);
  for (const auto& t : mesh.triangles) EXPECT_TRUE(t.x < count && t.y < count && t.z < count);
  EXPECT_FALSE(mesh.triangles.empty());
}

void expect_consistent(const Scene& scene) {
  for (const Mesh& mesh : scene.meshes) expect_consistent(mesh);
  for (const auto& image : scene.images) {
    const auto samples =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4;
    EXPECT_EQ(image.rgba8.size() + image.rgba32f.size(), samples);
  }
  for (const auto& instance : scene.instances) {
    EXPECT_NE(in_range(instance.mesh, scene.meshes), in_range(instance.sphere, scene.spheres));
    EXPECT_TRUE(in_range(instance.material, scene.materials));
    EXPECT_TRUE(in_range(instance.node, scene.nodes));
    EXPECT_TRUE(std::isfinite(1.0 / instance.object_to_world.determinant()));
  }
  for (const auto& m : scene.materials) {
    for (const auto* map : {&m.base_color_map, &m.normal_map, &m.emission_map, &m.clearcoat_map}) {
      EXPECT_TRUE(map->image == -1 || in_range(map->image, scene.images));
    }
  }
  ASSERT_FALSE(scene.cameras.empty());
}

// Empty if the file loads, and then into a consistent scene.
std::string error_of(const fs::path& file) {
  SCOPED_TRACE(file);
  try {
    lumivec::LoadReport report;
    expect_consistent(lumivec::load_scene(file, {}, report));
  } catch (const lumivec::SceneError& e) {
    const std::string line = e.what();
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_NE(line.find(';'), std::string::npos) << line;
    return line;
  }
  return {};
}

TEST(GltfCorpus, SampleModelsLoad) {
  const fs::path folder = fs::path(LUMIVEC_CORPORA) / "gltf";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " does not exist";
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".gltf" && extension != ".glb") continue;
    ++files;
    const std::string error = error_of(entry.path());
    const bool needs_more =
        error.find("required extension KHR_draco_mesh_compression") != error.npos ||
        error.find("required extension FAKE_") != error.npos;
    EXPECT_TRUE(error.empty() || needs_more) << error;
  }
  EXPECT_GT(files, 100u);
}

TEST(GltfCorpus, InvalidFilesAreHarmless) {
  const fs::path folder = fs::path(LUMIVEC_CORPORA) / "negative";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " does not exist";
  std::ifstream table(folder / "EXPECTED.csv");
  std::string line;
  std::getline(table, line);
  std::size_t files = 0;
  while (std::getline(table, line)) {
    std::istringstream row(line);
    std::string path;
    std::string errors;
    std::getline(row, path, ',');
    std::getline(row, errors, ',');
    const std::string error = error_of(folder / path);
    EXPECT_TRUE(errors != "0" || error.empty()) << error;
    ++files;
  }
  EXPECT_GT(files, 100u);
}

TEST(GltfCorpus, WrongPicturesAreRefused) {
  const fs::path folder = fs::path(LUMIVEC_CORPORA) / "negative";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " does not exist";
  const std::map<std::string, std::string> expected = {
      {"assimp/BoxWithInfinites-glTF-Binary/BoxWithInfinites.glb", "not finite"},
      {"assimp/IndexOutOfRange/IndexOutOfRange.gltf", "index 255"},
      {"assimp/MissingBin/BoxTextured.gltf", "does not exist"},
      {"assimp/RecursiveNodes/RecursiveNodes.gltf", "its own ancestor"},
      {"asset-generator/Mesh_PrimitiveRestart/Mesh_PrimitiveRestart_08.gltf", "restart value 255"},
      {"gltf-validator/base/data/glb/truncated_chunk_data.glb", "bytes"},
      {"gltf-validator/base/data/json/invalid_syntax.gltf", "line "},
      {"gltf-validator/base/data/node/node_loop.gltf", "its own ancestor"},
  };
  for (const auto& [path, problem] : expected) {
    const std::string error = error_of(folder / path);
    EXPECT_NE(error.find(problem), std::string::npos) << path << ": " << error;
  }
}

}  // namespace
