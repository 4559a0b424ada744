// Scene files to Scene: picks the reader by content, and reports what a file asks for and does not
// get.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "loader/scene.h"

namespace lumivec {

// Bounds on what a POV-Ray scene, which is a program, may take.
struct LanguageLimits {
  std::uint64_t max_steps = 200'000'000;   // directives, macro calls and passes of loops: minutes
  std::uint32_t max_macro_depth = 10'000;  // macros and includes within each other
  std::uint32_t max_nesting = 400;         // blocks and brackets within each other; each takes some
                                           // kilobytes of the stack
  std::uint32_t max_depth = 2000;  // declared things that hold each other, which loops can chain
  std::uint64_t max_parts = 50'000'000;  // of one object, function or texture, each as often as it
                                         // is met
  std::uint64_t max_file_bytes = std::uint64_t{1} << 30;  // of one file that the scene reads
};

struct LoadOptions {
  std::string scene;  // name or index of the scene in a file of several; empty: the file's default
  bool allow_outside_files = false;  // may files outside the scene file's folder be read?
  std::vector<std::filesystem::path> include_paths;  // POV-Ray: folders searched for includes
  LanguageLimits language;
  std::uint64_t max_bytes = std::uint64_t{8}
                            << 30;  // bound on the sum of what is decoded: geometry, images
};

// One thing that a file holds and the picture will not show, or shows differently.
struct LoadWarning {
  std::string where;  // glTF path, or line and column
  std::string message;
};

struct LoadReport {
  std::string format;                    // "glTF 2.0", "glTF 2.0 binary", "POV-Ray 3.7"
  std::string generator;                 // as the file says
  std::vector<std::string> scene_names;  // all scenes of the file, in order
  int scene = 0;                         // which one was loaded
  std::vector<std::string> extensions_used;
  std::vector<std::string> extensions_ignored;  // used, not required, not supported
  std::vector<LoadWarning> warnings;            // each worth one line to the user
  // Read besides the scene file itself, absolute; POV-Ray: includes, pictures, height fields, data.
  std::vector<std::filesystem::path> files;
  bool default_camera = false;  // the file had none; Scene::cameras[0] was made to frame everything
};

// Reads a scene. Throws SceneError if the file cannot be read, is malformed, reaches outside its
// folder against options, or requires what is not supported. Whatever returns is consistent: every
// index in range, every number finite, every transform invertible.
Scene load_scene(const std::filesystem::path& file, const LoadOptions& options, LoadReport& report);

// Replaces the scene's environment by a latitude-longitude picture (.hdr, .exr, anything
// OpenImageIO reads; sRGB decoded if the file is 8 bit). strength multiplies its radiance; rotation
// in radians about +Y. Throws SceneError.
void load_environment(const std::filesystem::path& file, float strength, float rotation,
                      Scene& scene);

// Replaces it by a grey sky that shows shapes, of radiance 1 or so, for scenes that bring no light
// of their own; strength and rotation (finite, strength ≥ 0) likewise.
void set_built_in_sky(float strength, float rotation, Scene& scene);

}  // namespace lumivec
