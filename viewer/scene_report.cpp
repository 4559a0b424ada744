#include "viewer/scene_report.h"

#include <algorithm>
#include <numbers>

#include "integrator/wide_lens.h"
#include "loader/animate.h"
#include "viewer/json_text.h"
#include "viewer/scene_summary.h"
#include "viewer/text_format.h"

namespace lumivec {
namespace {

double degrees(double radians) {
  return radians * 180.0 / std::numbers::pi;
}

std::string name_or(const std::string& name, const std::string& otherwise) {
  return name.empty() ? otherwise : "'" + name + "'";
}

std::string kind_name(LightKind kind) {
  switch (kind) {
    case LightKind::point:
      return "point";
    case LightKind::spot:
      return "spot";
    case LightKind::beam:
      return "beam";
    case LightKind::directional:
      break;
  }
  return "directional";
}

std::string camera_view(const Camera& camera) {
  if (camera.kind == CameraKind::orthographic) {
    return "orthographic, " + format_number(2.0 * camera.xmag) + " x " +
           format_number(2.0 * camera.ymag) + " units";
  }
  if (is_wide(camera)) {
    std::string text = std::string(camera_kind_name(camera.kind));
    if (camera.aspect > 0.0f) text += ", aspect " + format_number(camera.aspect);
    return text;
  }
  std::string text = "perspective, " + format_number(degrees(camera.yfov)) + " degrees high";
  if (camera.aspect > 0.0f) text += ", aspect " + format_number(camera.aspect);
  return text;
}

std::string image_size(const Image& image) {
  return std::to_string(image.width) + "x" + std::to_string(image.height) +
         (image.rgba32f.empty() ? ", 8 bit" : ", float");
}

std::string vector_text(const V3d& v) {
  return "(" + format_number(v.x) + ", " + format_number(v.y) + ", " + format_number(v.z) + ")";
}

// "moves 3 shapes, 1 camera; deforms 2 meshes".
std::string animation_effect(const AnimationCounts& counts) {
  std::string carried;
  const auto add = [](std::string& text, std::uint64_t count, const char* one, const char* many) {
    if (count == 0) return;
    text += (text.empty() ? "" : ", ") + format_count(count) + " " + (count == 1 ? one : many);
  };
  add(carried, counts.instances, "shape", "shapes");
  add(carried, counts.lights, "light", "lights");
  add(carried, counts.cameras, "camera", "cameras");
  std::string deformed;
  add(deformed, counts.meshes, "mesh", "meshes");
  if (carried.empty() && deformed.empty()) return "changes nothing that is seen";
  if (carried.empty()) return "deforms " + deformed;
  return "moves " + carried + (deformed.empty() ? "" : "; deforms " + deformed);
}

// "cameras: 2" and a line for each of the first few.
template <typename Items, typename Describe>
void list(std::string& text, const std::string& title, const Items& items,
          const Describe& describe) {
  constexpr std::size_t listed = 20;
  text += title + ": " + format_count(items.size()) + "\n";
  for (std::size_t i = 0; i < std::min<std::size_t>(items.size(), listed); ++i) {
    text += "  " + std::to_string(i) + ": " + describe(items[i]) + "\n";
  }
  if (items.size() > listed) {
    text += "  and " + format_count(items.size() - listed) + " more (--json lists all)\n";
  }
}

std::string environment_text(const Scene& scene) {
  const Environment& environment = scene.environment;
  if (environment.image >= 0) {
    const Image& image = scene.images[std::size_t(environment.image)];
    return name_or(image.name, "picture") + ", " + image_size(image);
  }
  const Color& c = environment.radiance;
  if (c.x == 0.0f && c.y == 0.0f && c.z == 0.0f) return "none";
  return "constant " + vector_text(V3d(c.x, c.y, c.z));
}

nlohmann::json triple(const V3d& v) {
  return {v.x, v.y, v.z};
}
nlohmann::json triple(const Color& c) {
  return {c.x, c.y, c.z};
}

nlohmann::json camera_json(const Camera& camera) {
  nlohmann::json json = {{"name", camera.name}, {"aspect", camera.aspect}};
  if (camera.kind == CameraKind::orthographic) {
    json["kind"] = "orthographic";
    json["xmag"] = camera.xmag;
    json["ymag"] = camera.ymag;
  } else {
    json["kind"] = camera_kind_name(camera.kind);
    json["yfov_degrees"] = degrees(camera.yfov);
  }
  return json;
}

}  // namespace

std::string scene_text(const std::string& file, const Scene& scene, const LoadReport& report) {
  const SceneCounts counts = count_scene(scene);
  const Imath::Box3d bounds = world_bounds(scene);
  std::string text = file + ": " + report.format;
  if (!report.generator.empty()) text += ", made by " + report.generator;
  text += "\n";
  list(text, "scenes", report.scene_names, [&](const std::string& name) {
    const bool loaded = &name == &report.scene_names[std::size_t(report.scene)];
    return name_or(name, "unnamed") + (loaded ? " (loaded)" : "");
  });
  if (bounds.isEmpty()) {
    text += "bounds: nothing is placed\n";
  } else {
    text += "bounds: " + vector_text(bounds.min) + " to " + vector_text(bounds.max) + "\n";
  }
  text += "meshes: " + format_count(scene.meshes.size()) + ", " + format_count(counts.triangles) +
          " triangles; placed " + format_count(scene.instances.size()) + " times, " +
          format_count(counts.triangles_instanced) + " triangles in the world\n";
  text += "exact spheres: " + format_count(counts.spheres) + "\n";
  text += "materials: " + format_count(scene.materials.size()) + "; " +
          format_count(counts.emissive_instances) + " shapes emit light\n";
  list(text, "textures", scene.images, [](const Image& image) {
    return name_or(image.name, "unnamed") + ", " + image_size(image);
  });
  list(text, "lights", scene.lights, [](const Light& light) {
    return name_or(light.name, "unnamed") + ", " + kind_name(light.kind);
  });
  text += "environment: " + environment_text(scene) + "\n";
  list(text, "cameras", scene.cameras, [&](const Camera& camera) {
    return name_or(camera.name, "unnamed") + ", " + camera_view(camera) +
           (report.default_camera ? " (made up: the file has none)" : "");
  });
  list(text, "animations", scene.animations, [&](const Animation& animation) {
    return name_or(animation.name, "unnamed") + ", " +
           format_duration(animation_length(animation)) + ", " +
           animation_effect(count_animation(scene, animation));
  });
  text += "memory: " + format_bytes(counts.bytes_geometry) + " geometry, " +
          format_bytes(counts.bytes_images) + " textures\n";
  for (const std::string& extension : report.extensions_ignored) {
    text += "not supported: " + extension + "\n";
  }
  for (const LoadWarning& warning : report.warnings) {
    text +=
        "warning: " + (warning.where.empty() ? "" : warning.where + ": ") + warning.message + "\n";
  }
  return text;
}

std::string scene_json(const std::string& file, const Scene& scene, const LoadReport& report) {
  const SceneCounts counts = count_scene(scene);
  const Imath::Box3d bounds = world_bounds(scene);
  nlohmann::json json = {
      {"file", file},
      {"format", report.format},
      {"generator", report.generator},
      {"scenes", report.scene_names},
      {"scene", report.scene},
      {"bounds", nullptr},
      {"meshes", scene.meshes.size()},
      {"instances", scene.instances.size()},
      {"triangles", counts.triangles},
      {"triangles_instanced", counts.triangles_instanced},
      {"spheres", counts.spheres},
      {"emissive_instances", counts.emissive_instances},
      {"materials", nlohmann::json::array()},
      {"textures", nlohmann::json::array()},
      {"lights", nlohmann::json::array()},
      {"cameras", nlohmann::json::array()},
      {"default_camera", report.default_camera},
      {"animations", nlohmann::json::array()},
      {"bytes", {{"geometry", counts.bytes_geometry}, {"textures", counts.bytes_images}}},
      {"extensions_used", report.extensions_used},
      {"extensions_ignored", report.extensions_ignored},
      {"warnings", nlohmann::json::array()}};
  if (!bounds.isEmpty()) {
    json["bounds"] = {{"min", triple(bounds.min)}, {"max", triple(bounds.max)}};
  }
  for (const Material& material : scene.materials) json["materials"].push_back(material.name);
  for (const Image& image : scene.images) {
    json["textures"].push_back({{"name", image.name},
                                {"width", image.width},
                                {"height", image.height},
                                {"float", !image.rgba32f.empty()}});
  }
  for (const Light& light : scene.lights) {
    json["lights"].push_back({{"name", light.name},
                              {"kind", kind_name(light.kind)},
                              {"intensity", triple(light.intensity)}});
  }
  for (const Camera& camera : scene.cameras) json["cameras"].push_back(camera_json(camera));
  const Environment& environment = scene.environment;
  json["environment"] = {{"image", nullptr}, {"radiance", triple(environment.radiance)}};
  if (environment.image >= 0) json["environment"]["image"] = environment.image;
  for (const Animation& animation : scene.animations) {
    const AnimationCounts moved = count_animation(scene, animation);
    json["animations"].push_back({{"name", animation.name},
                                  {"channels", animation.channels.size()},
                                  {"seconds", animation_length(animation)},
                                  {"nodes", moved.nodes},
                                  {"instances", moved.instances},
                                  {"deformed_meshes", moved.meshes},
                                  {"lights", moved.lights},
                                  {"cameras", moved.cameras}});
  }
  for (const LoadWarning& warning : report.warnings) {
    json["warnings"].push_back({{"where", warning.where}, {"message", warning.message}});
  }
  return json_text(json);
}

}  // namespace lumivec
