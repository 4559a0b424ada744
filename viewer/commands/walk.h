// lumivec walk: the interactive engine without a window, along a camera path.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "integrator/settings.h"
#include "loader/load_scene.h"
#include "viewer/display_transform.h"
#include "viewer/scene_input.h"
#include "viewer/walk/camera_path.h"
#include "viewer/walk/walk_engine.h"

namespace CLI {
class App;
}

namespace lumivec {

struct WalkOptions {
  std::filesystem::path scene_file;
  LoadOptions load;
  EnvironmentChoice environment;
  std::string camera;  // name or index; empty: the first
  std::optional<PictureSize> size;
  CameraPathChoice path;
  int frames = 60;
  std::optional<std::string>
      animation;                    // that is played: name or index; none: the file's rest pose
  double frames_per_second = 30.0;  // of that
  std::string mode = "rc+lv";
  Reuse reuse = Reuse::shading;     // in the modes that keep anything
  double frame_time = 0.033;        // seconds
  RenderSettings settings;          // terms, seed, threads
  std::filesystem::path output;     // folder for the frames, or a movie (.mp4); empty: none
  std::filesystem::path reference;  // folder of path-traced frames; empty: none
  int reference_samples = 256;      // a pixel
  bool automatic_exposure = false;
  double exposure = 0.0;  // stops
  DisplayOptions display;
  std::filesystem::path statistics;  // empty: none
  bool quiet = false;
  std::string command;

  WalkMode walk_mode() const {
    return {mode.starts_with("rc") ? reuse : Reuse::nothing, mode.ends_with("lv")};
  }
};

void add_walk_options(CLI::App& app, WalkOptions& options);
// Throws UsageError.
void check_walk_options(const CLI::App& app, const WalkOptions& options);
// Returns the exit status. Throws what the loader, the integrator and the writers throw.
int run_walk(const WalkOptions& options);

}  // namespace lumivec
