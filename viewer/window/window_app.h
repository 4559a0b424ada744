// The window: GLFW, Dear ImGui and OpenGL in front of the engine's thread.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "viewer/display_transform.h"
#include "viewer/option_values.h"
#include "viewer/window/loaded_scene.h"

namespace lumivec {

struct WindowOptions {
  // Without a file one is dropped on the window. What is said of a file and of no other (which of
  // its scenes, its pose, that it may read others outside its folder) is for the first one that is
  // opened; the environment, where to look for includes and all bounds are for later ones too.
  SceneSource scene;
  std::string camera;               // as choose_camera takes it
  std::optional<PictureSize> size;  // of the window, on a usual display
  DisplayOptions display;
  double exposure = 0.0;            // stops
  bool automatic_exposure = false;  // of each file that is opened, by its first picture
  std::uint32_t terms = 0;          // 0: all
  int pixel_size = 0;               // 0: as remembered
  int threads = 0;                  // 0: all
  std::uint64_t seed = 0;
  std::filesystem::path folder = ".";  // where pictures and camera paths are written
  std::filesystem::path script;        // events to replay; empty: none
  bool remember = true;                // read and write the settings file
};

// Until the window is closed. Returns the exit status. Throws CommandError if there is no display,
// and what the script and the display options throw.
int run_window(const WindowOptions& options);

}  // namespace lumivec
