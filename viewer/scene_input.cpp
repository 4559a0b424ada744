#include "viewer/scene_input.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "integrator/wide_lens.h"
#include "loader/animate.h"
#include "viewer/camera_text.h"
#include "viewer/errors.h"

namespace lumivec {
namespace {

// Whether anything lights the scene, or it needs no light. Unlit surfaces show themselves and light
// nothing else.
bool has_light(const Scene& scene) {
  const auto shines = [](const Color& c) { return c != Color(0.0f); };
  const Material usual;
  const auto material_of = [&](const Instance& i) -> const Material& {
    return i.material < 0 ? usual : scene.materials[std::size_t(i.material)];
  };
  const bool all_unlit = !scene.instances.empty() &&
                         std::all_of(scene.instances.begin(), scene.instances.end(),
                                     [&](const Instance& i) { return material_of(i).unlit; });
  return shines(scene.environment.radiance) ||
         std::any_of(scene.lights.begin(), scene.lights.end(),
                     [&](const Light& light) { return shines(light.intensity); }) ||
         std::any_of(
             scene.instances.begin(), scene.instances.end(),
             [&](const Instance& i) { return i.visible && shines(material_of(i).emission); }) ||
         all_unlit;
}

}  // namespace

Scene load_lit_scene(const std::filesystem::path& file, const LoadOptions& options,
                     const EnvironmentChoice& environment,
                     const std::function<void(const std::string&)>& warn, LoadReport& report) {
  Scene scene = load_scene(file, options, report);
  for (const LoadWarning& warning : report.warnings)
    warn(warning.where.empty() ? warning.message : warning.where + ": " + warning.message);
  if (report.default_camera)
    warn(file.string() + ": has no camera; one that frames everything is used");
  const auto strength = float(environment.strength);
  const auto rotation = float(environment.rotation * std::numbers::pi / 180.0);
  if (environment.is_file()) {
    load_environment(environment.name, strength, rotation, scene);
  } else if (environment.name == "sky") {
    set_built_in_sky(strength, rotation, scene);
  } else if (environment.name == "none") {
    scene.environment = Environment();
  } else if (!has_light(scene)) {
    warn(file.string() +
         ": holds no light; a plain sky lights it, or what --environment FILE says");
    set_built_in_sky(strength, rotation, scene);
  }
  if (!has_light(scene)) {
    warn(file.string() +
         ": holds no light, so that the picture is black; light it with --environment");
  }
  return scene;
}

std::size_t choose_animation(const Scene& scene, const std::string& option,
                             const std::string& wanted) {
  if (scene.animations.empty())
    throw UsageError(option + ": the scene holds no animation; leave it out");
  if (wanted.empty()) return 0;
  std::vector<std::string> names;
  for (const Animation& animation : scene.animations) names.push_back(animation.name);
  return std::size_t(find_by_name_or_index("--animation", wanted, names, "animation"));
}

void pose(Scene& scene, const PoseChoice& choice) {
  if (!choice.seconds) return;
  pose_scene(scene, choose_animation(scene, "--at", choice.animation), *choice.seconds);
}

Camera choose_camera(const Scene& scene, const std::string& wanted) {
  if (wanted.empty()) return scene.cameras.front();
  if (is_camera_text(wanted)) return parse_camera_text("--camera", wanted, scene.cameras.front());
  std::vector<std::string> names;
  for (const Camera& camera : scene.cameras) names.push_back(camera.name);
  return scene.cameras[std::size_t(find_by_name_or_index("--camera", wanted, names, "camera"))];
}

void flatten_cameras(Scene& scene, const std::filesystem::path& file,
                     const std::function<void(const std::string&)>& warn) {
  for (Camera& camera : scene.cameras) {
    if (!is_wide(camera)) continue;
    warn(file.string() + ": the " + camera_kind_name(camera.kind) +
         " camera is shown as a perspective one; lumivec render shows all of its picture");
    camera = flat_camera(camera);
  }
}

// The picture's size where the user leaves it open.
PictureSize size_for(const Camera& camera) {
  constexpr int usual_height = 512;
  double aspect = camera.aspect;
  if (camera.kind == CameraKind::orthographic && !(aspect > 0.0)) {
    aspect = double(camera.xmag) / double(camera.ymag);
  }
  if (!(aspect > 0.0) || !std::isfinite(aspect)) aspect = 1.0;
  const double width = std::clamp(std::round(usual_height * aspect), 1.0, double(max_picture_side));
  return {int(width), usual_height};
}

}  // namespace lumivec
