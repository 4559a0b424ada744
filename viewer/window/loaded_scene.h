// A scene as the window holds it: never changed once it is there, so that threads can share it.
#pragma once

#include <ImathBox.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "viewer/scene_input.h"

namespace lumivec {

struct SceneSource {
  std::filesystem::path file;
  LoadOptions load;
  EnvironmentChoice environment;
  PoseChoice pose;
};

struct LoadedScene {
  SceneSource source;
  Scene scene;
  Imath::Box3d bounds;  // world space
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> files;  // read besides the scene file, LoadReport's
  double seconds = 0.0;                      // to load it
};

// Throws what loading throws.
std::shared_ptr<const LoadedScene> load_shared_scene(const SceneSource& source);

// What to call an instance, and its material; "nothing" and "" for -1.
std::string object_name(const Scene& scene, int instance);
std::string material_name(const Scene& scene, int instance);

}  // namespace lumivec
