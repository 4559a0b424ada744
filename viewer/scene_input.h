// A scene as the commands take it: loaded, lit, and seen by one of its cameras.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "loader/load_scene.h"
#include "viewer/option_values.h"

namespace lumivec {

// What replaces the scene's environment.
struct EnvironmentChoice {
  // A file, "sky" (built in) or "none"; empty: the scene's own, or the sky where nothing shines.
  std::filesystem::path name;
  double strength = 1.0;  // multiplies its radiance
  double rotation = 0.0;  // degrees

  bool is_file() const { return !name.empty() && name != "sky" && name != "none"; }
};

// The moment of an animation that the scene is posed at.
struct PoseChoice {
  std::string animation;          // name or index; empty: the first
  std::optional<double> seconds;  // none: the file's rest pose
};

// wanted: a name or an index; empty: the first. option: that asks for one. Throws UsageError.
std::size_t choose_animation(const Scene& scene, const std::string& option,
                             const std::string& wanted);

// Throws UsageError.
void pose(Scene& scene, const PoseChoice& choice);

// warn is called with one line for each thing that the user should know. report: what loading
// tells. Throws SceneError.
Scene load_lit_scene(const std::filesystem::path& file, const LoadOptions& options,
                     const EnvironmentChoice& environment,
                     const std::function<void(const std::string&)>& warn, LoadReport& report);

// wanted: a name, an index or a view as camera_text.h has it, whose other properties are the first
// camera's; empty: the first. Throws UsageError.
Camera choose_camera(const Scene& scene, const std::string& wanted);

// For pictures that are pasted from one view to the next, which only flat ones can be: a
// perspective camera takes the place of each fisheye and other wide one, and warn is called.
void flatten_cameras(Scene& scene, const std::filesystem::path& file,
                     const std::function<void(const std::string&)>& warn);

// The picture's size where the user leaves it open.
PictureSize size_for(const Camera& camera);

}  // namespace lumivec
