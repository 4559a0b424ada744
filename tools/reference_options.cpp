#include "tools/reference_options.h"

#include <cstdio>

#include "loader/load_scene.h"

namespace fs = std::filesystem;

namespace lumivec {

void add_reference_options(CLI::App& app, ReferenceOptions& options) {
  app.add_option_function<std::string>(
         "--size", [&](const std::string& text) { options.size = parse_size("--size", text); },
         "pixels")
      ->type_name("WxH")
      ->default_str("512x512");
  app.add_option("--threads", options.threads, "0: all processors")
      ->capture_default_str()
      ->check(CLI::Range(0, 4096));
  app.add_option("--references", options.folder, "folder where references are kept")
      ->capture_default_str();
  app.add_option("--reference-samples", options.samples,
                 "samples a pixel of a reference, an even number")
      ->capture_default_str()
      ->check(CLI::Range(2, max_picture_samples));
}

RenderSettings picture_settings(const ReferenceOptions& options) {
  RenderSettings settings;
  settings.width = options.size.width;
  settings.height = options.size.height;
  settings.threads = options.threads;
  return settings;
}

fs::path find_scene(const std::string& name) {
  std::error_code error;
  const fs::path shipped = fs::path(LUMIVEC_SCENES) / (name + ".gltf");
  return !fs::exists(name, error) && fs::exists(shipped, error) ? shipped : fs::path(name);
}

Scene load_benchmark_scene(const fs::path& file) {
  LoadReport report;
  return load_scene(file, LoadOptions(), report);
}

Reference obtain_reference(const char* program, const Scene& scene, const fs::path& scene_file,
                           const ReferenceOptions& options) {
  const ReferenceRequest request = {scene_file,      options.size.width, options.size.height,
                                    options.samples, options.threads,    options.folder};
  const auto say_rendering = [&] {
    std::fprintf(stderr, "%s: %s: renders a reference of %d samples a pixel, and keeps it in %s\n",
                 program, scene_file.stem().c_str(), options.samples, options.folder.c_str());
  };
  return kept_reference(scene, request, say_rendering);
}

}  // namespace lumivec
