#include "viewer/window/loaded_scene.h"

#include <chrono>

#include "viewer/scene_summary.h"

namespace lumivec {

std::shared_ptr<const LoadedScene> load_shared_scene(const SceneSource& source) {
  const auto start = std::chrono::steady_clock::now();
  auto loaded = std::make_shared<LoadedScene>();
  loaded->source = source;
  LoadReport report;
  const auto warn = [&](const std::string& warning) { loaded->warnings.push_back(warning); };
  loaded->scene = load_lit_scene(source.file, source.load, source.environment, warn, report);
  flatten_cameras(loaded->scene, source.file, warn);
  loaded->files = std::move(report.files);
  pose(loaded->scene, source.pose);
  loaded->bounds = world_bounds(loaded->scene);
  loaded->seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return loaded;
}

std::string object_name(const Scene& scene, int instance) {
  if (instance < 0 || std::size_t(instance) >= scene.instances.size()) return "nothing";
  const std::string& name = scene.instances[std::size_t(instance)].name;
  return name.empty() ? "object " + std::to_string(instance) : name;
}

std::string material_name(const Scene& scene, int instance) {
  if (instance < 0 || std::size_t(instance) >= scene.instances.size()) return {};
  const int material = scene.instances[std::size_t(instance)].material;
  if (material < 0) return "the usual";
  const std::string& name = scene.materials[std::size_t(material)].name;
  return name.empty() ? "material " + std::to_string(material) : name;
}

}  // namespace lumivec
