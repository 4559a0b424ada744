// Every file of the handed corpora: what is valid loads, what is not fails in one line, and nothing
// is inconsistent.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "loader/animate.h"
#include "loader/error.h"
#include "loader/load_scene.h"
#include "tests/scene_bits.h"

namespace {

namespace fs = std::filesystem;
using lumivec::AnimationChannel;
using lumivec::AnimationTarget;
using lumivec::M44d;
using lumivec::Mesh;
using lumivec::Scene;
using lumivec::V3d;

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

bool finite(const lumivec::M44d& m) {
  for (int i = 0; i < 16; ++i) {
    if (!std::isfinite(m[i / 4][i % 4])) return false;
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
  for (const auto& light : scene.lights) EXPECT_TRUE(finite(light.object_to_world));
  for (const auto& camera : scene.cameras) EXPECT_TRUE(finite(camera.camera_to_world));
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

// Is the animated property, as the scene holds it now, that of a key?
void expect_key(const Scene& scene, const AnimationChannel& channel, std::size_t key) {
  const bool spline = channel.interpolation == lumivec::Interpolation::cubic_spline;
  const std::size_t width = channel.values.size() / channel.times.size() / (spline ? 3 : 1);
  const float* value = channel.values.data() + width * (spline ? 3 * key + 1 : key);
  const M44d& m = scene.nodes.at(static_cast<std::size_t>(channel.node)).local_to_parent;
  if (channel.target == AnimationTarget::translation) {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(m[3][i], value[i]);
  } else if (channel.target == AnimationTarget::scale) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(V3d(m[i][0], m[i][1], m[i][2]).length(), std::abs(value[i]),
                  1e-9 * std::abs(value[i]));
    }
  } else if (channel.target == AnimationTarget::rotation) {
    // What a quaternion leaves in place is its axis.
    const V3d axis(value[0], value[1], value[2]);
    M44d rotation;
    for (int i = 0; i < 3; ++i) {
      const V3d row = V3d(m[i][0], m[i][1], m[i][2]).normalized();
      for (int j = 0; j < 3; ++j) rotation[i][j] = row[j];
    }
    V3d turned;
    rotation.multDirMatrix(axis, turned);
    EXPECT_NEAR((turned - axis).length(), 0.0, 1e-6);
    // The trace says by how much it turns; files round their quaternions.
    const double w2 = double(value[3]) * value[3];
    EXPECT_NEAR(rotation[0][0] + rotation[1][1] + rotation[2][2],
                4.0 * w2 / (w2 + axis.dot(axis)) - 1.0, 1e-6);
  } else {
    for (const auto& deformation : scene.motion.deformations) {
      if (deformation.weights_node != channel.node) continue;
      EXPECT_TRUE(std::equal(deformation.weights.begin(), deformation.weights.end(), value));
    }
  }
}

// World transforms by the chain of parents.
void expect_in_place(const Scene& scene) {
  for (const auto& instance : scene.motion.instances) {
    M44d m = instance.object_to_node;
    for (int node = instance.node; node >= 0;) {
      const auto& link = scene.nodes.at(static_cast<std::size_t>(node));
      m *= link.local_to_parent;
      node = link.parent;
    }
    const auto& placed = scene.instances.at(static_cast<std::size_t>(instance.instance));
    EXPECT_TRUE(!placed.visible || placed.object_to_world.equalWithAbsError(m, 1e-9));
  }
}

// Skinned vertices by the sum of their joints, written out.
void expect_skinned(const Scene& scene) {
  for (const auto& deformation : scene.motion.deformations) {
    if (deformation.skin < 0 || !deformation.targets.empty()) continue;
    const auto& skin = scene.motion.skins.at(static_cast<std::size_t>(deformation.skin));
    const Mesh& mesh = scene.meshes.at(static_cast<std::size_t>(deformation.mesh));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      V3d sum(0.0);
      double total = 0.0;
      for (const auto& set : deformation.joint_sets) {
        for (int i = 0; i < 4; ++i) {
          const std::size_t joint = set.joints[v][i];
          V3d p;
          V3d q;
          skin.inverse_binds.at(joint).multVecMatrix(V3d(deformation.positions[v]), p);
          scene.nodes.at(static_cast<std::size_t>(skin.joints.at(joint)))
              .local_to_world.multVecMatrix(p, q);
          sum += q * double(set.weights[v][i]);
          total += set.weights[v][i];
        }
      }
      if (total == 0.0) continue;
      EXPECT_NEAR((V3d(mesh.positions[v]) - sum / total).length(), 0.0, 1e-4);
    }
  }
}

// Poses the scene at some keys of every channel, between them and outside, and brings it to rest.
// Returns the number of poses.
std::size_t expect_poses(Scene& scene) {
  constexpr std::size_t keys = 8;  // of a channel, evenly chosen
  std::size_t poses = 0;
  const Scene loaded = scene;
  const auto pose = [&](std::size_t animation, double seconds) {
    pose_scene(scene, animation, seconds);
    expect_consistent(scene);
    expect_in_place(scene);
    expect_skinned(scene);
    EXPECT_TRUE(pose_scene(scene, animation, seconds).empty());
    ++poses;
  };
  for (std::size_t a = 0; a < scene.animations.size(); ++a) {
    const double length = lumivec::animation_length(scene.animations[a]);
    for (const double t : {-1.0, 0.0, 0.37 * length, 0.71 * length, length + 1.0}) pose(a, t);
    for (const AnimationChannel& channel : scene.animations[a].channels) {
      const std::size_t count = channel.times.size();
      for (std::size_t i = 0; i < std::min(keys, count); ++i) {
        const std::size_t key = count <= keys ? i : i * (count - 1) / (keys - 1);
        pose(a, channel.times[key]);
        expect_key(scene, channel, key);
      }
    }
  }
  pose_scene(scene, {});
  EXPECT_EQ(difference(scene, loaded), "");
  EXPECT_EQ(difference(loaded, scene), "");
  return poses;
}

TEST(GltfCorpus, AnimatedModelsPose) {
  const fs::path folder = fs::path(LUMIVEC_CORPORA) / "gltf";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " does not exist";
  std::size_t files = 0;
  std::size_t poses = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".gltf" && extension != ".glb") continue;
    SCOPED_TRACE(entry.path());
    try {
      lumivec::LoadReport report;
      Scene scene = lumivec::load_scene(entry.path(), {}, report);
      if (scene.animations.empty()) {
        EXPECT_TRUE(scene.motion.nodes.empty() && scene.motion.deformations.empty());
        continue;
      }
      ++files;
      poses += expect_poses(scene);
    } catch (const lumivec::SceneError&) {  // the test of loading says which may
    }
  }
  EXPECT_GT(files, 10u);
  EXPECT_GT(poses, 200u);
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
