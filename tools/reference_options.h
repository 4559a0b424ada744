// Options of benchmarks that compare pictures with references, and the scenes that they name.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "tools/kept_reference.h"
#include "viewer/option_values.h"

namespace lumivec {

struct ReferenceOptions {
  PictureSize size = {512, 512};
  int threads = 0;  // 0: all processors
  std::string folder = "references";
  int samples = 1024;
};

// --size, --threads, --references, --reference-samples.
void add_reference_options(CLI::App& app, ReferenceOptions& options);

// What all renders of a benchmark share: size and threads, and a seed that no reference has.
RenderSettings picture_settings(const ReferenceOptions& options);

// A file, or the name of a shipped scene.
std::filesystem::path find_scene(const std::string& name);
Scene load_benchmark_scene(const std::filesystem::path& file);

// kept_reference; says on stderr, after the program's name, if rendering it takes a while.
Reference obtain_reference(const char* program, const Scene& scene,
                           const std::filesystem::path& scene_file,
                           const ReferenceOptions& options);

}  // namespace lumivec
