// How a picture was made, as text for its header: it has to suffice to make the same one again.
#pragma once

#include <string>

#include "viewer/window/loaded_scene.h"
#include "viewer/window/scene_patch.h"
#include "viewer/window/window_state.h"

namespace lumivec {

// A picture of the window, and what it is of.
struct ShownPicture {
  const LoadedScene& scene;
  const ScenePatch& patch;
  const WindowState& state;
  const DisplayOptions& display;
  PictureSize size;  // of the file
};

// Options of `lumivec render`, and after " # " what no option says: how pixels were displayed
// beyond the view, and what the user has changed of the scene.
std::string settings_text(const ShownPicture& shown);

// "material red: base 1,0,0, roughness 0.5; light lamp: 3,3,3": the values that count now.
std::string patch_text(const ScenePatch& patch, const Scene& scene);

}  // namespace lumivec
