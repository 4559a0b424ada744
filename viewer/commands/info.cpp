#include "viewer/commands/info.h"

#include <iostream>

#include "viewer/errors.h"
#include "viewer/scene_report.h"

namespace lumivec {

int run_info(const InfoOptions& options) {
  LoadReport report;
  const Scene scene = load_scene(options.scene_file, options.load, report);
  const std::string file = options.scene_file.string();
  std::cout << (options.json ? scene_json(file, scene, report) : scene_text(file, scene, report));
  return exit_success;
}

}  // namespace lumivec
