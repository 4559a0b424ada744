// `lumivec render`: a scene file to picture files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "integrator/settings.h"
#include "loader/load_scene.h"
#include "viewer/display_transform.h"
#include "viewer/exr_layers.h"
#include "viewer/option_values.h"
#include "viewer/scene_input.h"

namespace CLI {
class App;
}

namespace lumivec {

struct RenderOptions {
  std::filesystem::path scene_file;
  LoadOptions load;
  std::string camera;  // name or index; empty: the first
  std::vector<std::filesystem::path> outputs;
  std::optional<PictureSize> size;  // none: from the camera's aspect
  RenderSettings settings;
  RenderOptions() { settings.integrator = Integrator::light_vectors; }

  EnvironmentChoice environment;
  PoseChoice pose;

  bool automatic_exposure = false;
  double exposure = 0.0;  // stops
  DisplayOptions display;
  ExrPrecision precision = ExrPrecision::half;
  int png_bits = 8;

  std::filesystem::path statistics;  // empty: none
  bool quiet = false;
  std::string command;  // the options as given, for the files' headers
};

// The command's options, in the order of the help. options must outlive the parsing.
void add_render_options(CLI::App& app, RenderOptions& options);

// What parsing alone cannot see: what is missing, and what contradicts what. Throws UsageError.
void check_render_options(const CLI::App& app, const RenderOptions& options);

// Returns the exit status. Throws what the loader, the integrator and the writers throw.
int run_render(const RenderOptions& options);

}  // namespace lumivec
