#include "loader/gltf/read_gltf.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "loader/gltf/animations.h"
#include "loader/gltf/images.h"
#include "loader/gltf/instances.h"
#include "loader/gltf/lights.h"
#include "loader/gltf/views.h"
#include "loader/moving_nodes.h"

namespace lumivec::gltf {
namespace {

// The scene that the options name, or the file's default one; -1 if the file has no scenes at all.
int select_scene(Context& context, const tinygltf::Model& model) {
  const std::string& wanted = context.options.scene;
  const auto& scenes = model.scenes;
  for (const auto& scene : scenes) context.report.scene_names.push_back(scene.name);
  if (wanted.empty()) {
    if (scenes.empty() && !model.nodes.empty()) {
      context.warn("", "the file has no scene, all of its nodes are shown");
    }
    return scenes.empty() ? -1 : std::max(model.defaultScene, 0);
  }
  const auto named = std::find_if(scenes.begin(), scenes.end(),
                                  [&](const auto& scene) { return scene.name == wanted; });
  if (named != scenes.end()) return static_cast<int>(named - scenes.begin());
  int index = -1;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), index);
  const bool number = error == std::errc() && end == wanted.data() + wanted.size();
  if (number && index >= 0 && static_cast<std::size_t>(index) < scenes.size()) return index;
  std::string known;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    known += (i > 0 ? ", " : "") + std::to_string(i);
    if (!scenes[i].name.empty()) known += " (" + scenes[i].name + ")";
  }
  context.fail("/scenes", "has no scene " + printable(wanted),
               scenes.empty() ? "the file has none" : "choose one of " + printable(known));
}

// Fills the nodes of the scene's motion and says which they are.
std::vector<bool> find_moving_nodes(const tinygltf::Model& model, Scene& scene) {
  const std::vector<int> animated = animated_nodes(scene.animations);
  for (const int node : animated) {
    scene.motion.rest.push_back(rest_transform(model.nodes[static_cast<std::size_t>(node)], node));
  }
  scene.motion.nodes = nodes_below(animated, scene.nodes);
  std::vector<bool> moving(scene.nodes.size());
  for (const int node : scene.motion.nodes) moving[static_cast<std::size_t>(node)] = true;
  return moving;
}

}  // namespace

bool looks_like_gltf(const ByteSource& bytes) {
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  std::array<char, 256> head{};
  const auto size = std::min<std::uint64_t>(bytes.size(), head.size());
  bytes.read(0, head.data(), size);
  std::string_view text(head.data(), size);
  if (text.starts_with("glTF")) return true;
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{';
}

Scene read_gltf(const std::filesystem::path& file, const ByteSource& bytes,
                const LoadOptions& options, LoadReport& report) {
  Context context(file, options, report);
  Document document = parse_document(context, read_container(context, bytes));
  const int selected = select_scene(context, document.model);
  report.scene = std::max(selected, 0);

  Scene scene;
  if (selected >= 0) scene.name = document.model.scenes[static_cast<std::size_t>(selected)].name;
  scene.nodes = read_nodes(context, document.model);
  const std::vector<int> nodes = nodes_of_scene(context, document.model, scene.nodes, selected);
  Buffers buffers(context, document);
  Accessors accessors(context, document, buffers);
  scene.animations = read_animations(context, document, accessors);
  const std::vector<bool> moving = find_moving_nodes(document.model, scene);
  const Imath::Box3d bounds = read_instances(context, document, accessors, nodes, moving, scene);
  load_images(context, document, buffers, scene);
  read_cameras(context, document.model, nodes, moving, scene);
  read_lights(context, document.model, nodes, moving, scene);
  if (scene.cameras.empty()) {
    scene.cameras.push_back(default_camera(bounds));
    report.default_camera = true;
  }
  context.finish_warnings();
  return scene;
}

}  // namespace lumivec::gltf
