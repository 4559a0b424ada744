// `lumivec info`: what a scene file holds, and what of it a picture will not show.
#pragma once

#include <filesystem>

#include "loader/load_scene.h"

namespace CLI {
class App;
}

namespace lumivec {

struct InfoOptions {
  std::filesystem::path scene_file;
  LoadOptions load;
  bool json = false;
};

void add_info_options(CLI::App& app, InfoOptions& options);
void check_info_options(const InfoOptions& options);  // throws UsageError
int run_info(const InfoOptions& options);             // returns the exit status

}  // namespace lumivec
