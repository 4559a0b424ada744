#include <CLI/CLI.hpp>

#include "viewer/commands/common_options.h"
#include "viewer/commands/info.h"
#include "viewer/errors.h"

namespace lumivec {

void add_info_options(CLI::App& app, InfoOptions& options) {
  add_scene_options(app, options.scene_file, options.load);
  app.add_flag("--json", options.json, "Print JSON")->group("Output");
}

void check_info_options(const InfoOptions& options) {
  if (options.scene_file.empty()) {
    throw UsageError("info: no scene is given; write: lumivec info SCENE");
  }
}

}  // namespace lumivec
