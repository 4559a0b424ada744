// What tests of animations add to a small glTF file.
#pragma once

#include "tests/gltf_file.h"

// Adds a channel to an animation of the file, which is made if it is not there; linear unless said.
inline void animate(GltfFile& file, int node, const char* path, const std::vector<float>& times,
                    const std::vector<float>& values, const char* interpolation = "LINEAR",
                    std::size_t animation = 0) {
  const std::string target = path;
  const char* type = target == "rotation" ? "VEC4" : target == "weights" ? "SCALAR" : "VEC3";
  const int input = file.accessor("SCALAR", GltfFile::float32, times);
  const int output = file.accessor(type, GltfFile::float32, values);
  auto& animations = file.root["animations"];
  if (animations.size() <= animation) {
    animations[animation] = {{"channels", nlohmann::json::array()},
                             {"samplers", nlohmann::json::array()}};
  }
  auto& samplers = animations[animation]["samplers"];
  samplers.push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
  animations[animation]["channels"].push_back(
      {{"sampler", samplers.size() - 1}, {"target", {{"node", node}, {"path", path}}}});
}

// Node 0 shows the triangle, skinned to nodes 1 (at x = 10) and 2 (at y = 20, below 1). Vertex 2
// hangs on none.
inline void skin(GltfFile& file) {
  const std::vector<std::uint8_t> joints{0, 0, 0, 0, 0, 1, 0, 0, 9, 9, 9, 9};
  file.attribute("JOINTS_0", file.accessor("VEC4", GltfFile::uint8, joints));
  file.attribute("WEIGHTS_0", file.accessor<float>("VEC4", GltfFile::float32,
                                                   {1, 0, 0, 0, 1, 3, 0, 0, 0, 0, 0, 0}));
  file.attribute("NORMAL",
                 file.accessor<float>("VEC3", GltfFile::float32, {0, 0, 1, 0, 0, 1, 0, 0, 1}));
  const int binds = file.accessor<float>("MAT4", GltfFile::float32,
                                         {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -10, 0,   0, 1,  //
                                          1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -10, -20, 0, 1});
  file.patch(R"({"scenes": [{"nodes": [0, 1]}], "skins": [{"joints": [1, 2]}],
    "nodes": [{"mesh": 0, "skin": 0, "translation": [7, 7, 7]},
              {"children": [2], "translation": [10, 0, 0]}, {"translation": [0, 20, 0]}]})");
  file.root["skins"][0]["inverseBindMatrices"] = binds;
}
