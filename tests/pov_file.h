// A POV-Ray scene in a folder of its own, for tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "loader/error.h"
#include "loader/load_scene.h"

struct PovFile {
  explicit PovFile(const std::string& scene) : text(scene) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder = std::filesystem::path(testing::TempDir()) /
             (std::string(test->test_suite_name()) + "." + test->name());
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  ~PovFile() { std::filesystem::remove_all(folder); }
  PovFile(const PovFile&) = delete;
  PovFile& operator=(const PovFile&) = delete;

  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder / name, std::ios::binary) << content;
  }

  lumivec::Scene load() {
    write("scene.pov", text);
    report = {};
    return lumivec::load_scene(folder / "scene.pov", options, report);
  }

  // What loading says when it fails; empty: it does not.
  std::string error() {
    try {
      load();
    } catch (const lumivec::SceneError& failure) {
      const std::string message = failure.what();
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
      EXPECT_NE(message.find("scene.pov"), std::string::npos) << message;
      return message;
    }
    return {};
  }

  bool warns(const std::string& words) const {
    for (const auto& warning : report.warnings) {
      if (warning.message.find(words) != std::string::npos) return true;
    }
    return false;
  }

  std::string text;
  std::filesystem::path folder;
  lumivec::LoadOptions options;
  lumivec::LoadReport report;
};

inline void expect_error(const std::string& scene, const std::string& words) {
  const std::string error = PovFile(scene).error();
  EXPECT_NE(error.find(words), std::string::npos) << scene << "\n-> " << error;
}
