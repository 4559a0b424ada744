// Every file of the glTF corpus loads and renders: no pixel that is not a number, no sample left
// out; what asks for an extension that lumivec does not have is refused by name.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "integrator/render.h"
#include "loader/error.h"
#include "loader/load_scene.h"

namespace lumivec {
namespace {

namespace fs = std::filesystem;

fs::path corpus() {
  return fs::path(LUMIVEC_CORPORA) / "gltf";
}

std::vector<std::string> files() {
  std::vector<std::string> found;
  if (!fs::exists(corpus())) return found;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(corpus())) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".gltf" || extension == ".glb") {
      found.push_back(fs::relative(entry.path(), corpus()).string());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

void render_file(const fs::path& file, Scene& scene) {
  // A sky for the files that bring no light.
  if (scene.environment.radiance == Color(0.0f)) scene.environment.radiance = Color(0.5f);
  RenderSettings settings;
  settings.width = settings.height = 64;
  settings.samples = 4;
  for (const Camera& camera : scene.cameras) {
    RenderStatistics statistics;
    const Framebuffer picture = render(scene, camera, settings, statistics);
    for (std::size_t t = 0; t < term_count; ++t) {
      EXPECT_EQ(statistics.dropped[t], 0u) << file << ' ' << term_names[t];
    }
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
      const Color c = picture.beauty(i);
      ASSERT_TRUE(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z)) << file;
      ASSERT_TRUE(c.x >= 0.0f && c.y >= 0.0f && c.z >= 0.0f) << file;
      ASSERT_TRUE(std::isfinite(picture.normal[i].length())) << file;
    }
    EXPECT_EQ(picture.samples[0], 4u) << file;
  }
}

TEST(corpus_render, every_file_renders_or_says_why_not) {
  const std::vector<std::string> all = files();
  if (all.empty()) GTEST_SKIP() << corpus() << " does not exist";
  int rendered = 0;
  for (const std::string& name : all) {
    SCOPED_TRACE(name);
    Scene scene;
    LoadReport report;
    try {
      scene = load_scene(corpus() / name, {}, report);
    } catch (const SceneError& error) {
      // Only for what a file requires and lumivec has not, and the name is said.
      EXPECT_NE(std::string(error.what()).find("required extension"), std::string::npos)
          << error.what();
      continue;
    }
    render_file(name, scene);
    ++rendered;
  }
  EXPECT_GT(rendered, 80);
}

}  // namespace
}  // namespace lumivec
