// Every POV-Ray scene of the handed corpora is parsed without an error.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "loader/error.h"
#include "loader/pov/read_pov.h"

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

TEST(PovCorpus, ScenesParse) {
  const fs::path folder = fs::path(LUMIVEC_CORPORA) / "pov";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " does not exist";
  lumivec::LoadOptions options;
  options.include_paths.push_back(folder / "include");
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".pov") continue;
    ++files;
    try {
      lumivec::LoadReport report;
      const auto scene =
          lumivec::pov::parse_pov(entry.path(), text_of(entry.path()), options, report);
      EXPECT_FALSE(scene.objects.empty()) << entry.path();
      EXPECT_TRUE(scene.camera.has_value()) << entry.path();
    } catch (const lumivec::SceneError& error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GE(files, 64u);
}

}  // namespace
