// A small glTF file built by a test: one triangle to begin with, changed by accessors and JSON
// patches.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "loader/error.h"
#include "loader/load_scene.h"
#include "tests/temporary_folder.h"

struct GltfFile {
  static constexpr int int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125,
                       float32 = 5126;

  TemporaryFolder folder;
  nlohmann::json root = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {}}]}],
    "accessors": [], "bufferViews": [], "buffers": [{"uri": "data.bin", "byteLength": 0}]})");
  std::vector<std::uint8_t> bytes;
  lumivec::LoadOptions options;
  lumivec::LoadReport report;

  // With the triangle (0,0,0) (1,0,0) (0,1,0) as accessor 0.
  GltfFile() {
    attribute("POSITION", accessor<float>("VEC3", float32, {0, 0, 0, 1, 0, 0, 0, 1, 0}));
  }

  nlohmann::json& primitive() { return root["meshes"][0]["primitives"][0]; }
  void attribute(const std::string& semantic, int accessor) {
    primitive()["attributes"][semantic] = accessor;
  }

  // A JSON merge patch (RFC 7396): objects are merged, everything else replaced.
  void patch(const char* text) { root.merge_patch(nlohmann::json::parse(text)); }
  void material(const char* text) {
    root["materials"] = nlohmann::json::array({nlohmann::json::parse(text)});
    primitive()["material"] = 0;
  }

  template <class T>
  int view(const std::vector<T>& values) {
    while (bytes.size() % 4 != 0) bytes.push_back(0);
    const std::size_t offset = bytes.size();
    bytes.resize(offset + values.size() * sizeof(T));
    std::memcpy(bytes.data() + offset, values.data(), values.size() * sizeof(T));
    root["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
    return static_cast<int>(root["bufferViews"].size()) - 1;
  }

  template <class T>
  int accessor(const std::string& type, int component, const std::vector<T>& values,
               bool normalized = false) {
    const std::size_t width = type == "SCALAR" ? 1 : type == "MAT4" ? 16 : type.back() - '0';
    root["accessors"].push_back({{"bufferView", view(values)},
                                 {"componentType", component},
                                 {"count", values.size() / width},
                                 {"type", type}});
    if (normalized) root["accessors"].back()["normalized"] = true;
    return static_cast<int>(root["accessors"].size()) - 1;
  }

  std::filesystem::path write() {
    root["buffers"][0]["byteLength"] = bytes.size();
    write("data.bin", std::string(bytes.begin(), bytes.end()));
    write("scene.gltf", root.dump(1));
    return folder / "scene.gltf";
  }
  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder / name, std::ios::binary) << content;
  }

  lumivec::Scene load() {
    lumivec::Scene scene = lumivec::load_scene(write(), options, report);
    EXPECT_FALSE(scene.cameras.empty());
    return scene;
  }

  // The message of the SceneError that loading ends with; empty if it does not.
  std::string error() {
    try {
      load();
    } catch (const lumivec::SceneError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      return e.what();
    }
    return {};
  }

  bool warns(std::string_view text) const {
    for (const auto& warning : report.warnings) {
      if ((warning.where + ": " + warning.message).find(text) != std::string::npos) return true;
    }
    return false;
  }
};

inline testing::AssertionResult contains(const std::string& text, std::string_view part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << '"' << text << "\" does not contain \"" << part << '"';
}
