#include "loader/gltf/document.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <utility>

#include "loader/gltf/extensions.h"
#include "loader/gltf/json_text.h"
#include "loader/gltf/schema.h"

namespace lumivec::gltf {
namespace {

using nlohmann::json;

std::uint64_t size_or_zero(const json& object, const char* name) {
  const auto it = object.find(name);
  return it == object.end() ? 0 : it->get<std::uint64_t>();
}

int index_or_none(const json& object, const char* name) {
  const auto it = object.find(name);
  return it == object.end() ? -1 : it->get<int>();
}

// Moves a string, which may be a data URI of any size, out of the tree.
std::optional<std::string> take_string(json& object, const char* name) {
  const auto it = object.find(name);
  if (it == object.end()) return std::nullopt;
  return std::move(it->get_ref<std::string&>());
}

std::vector<Buffer> take_buffers(json& array) {
  std::vector<Buffer> buffers;
  for (json& buffer : array) {
    buffers.push_back({take_string(buffer, "uri"), size_or_zero(buffer, "byteLength")});
  }
  return buffers;
}

std::vector<BufferView> take_views(const json& array) {
  std::vector<BufferView> views;
  for (const json& view : array) {
    views.push_back({index_or_none(view, "buffer"), size_or_zero(view, "byteOffset"),
                     size_or_zero(view, "byteLength"), size_or_zero(view, "byteStride")});
  }
  return views;
}

ComponentType component_type(const json& object) {
  // Every defined value fits; the rest becomes 0, which is none of them.
  const auto value = size_or_zero(object, "componentType");
  return static_cast<ComponentType>(value <= 0xffff ? value : 0);
}

SparseAccessor take_sparse(const json& sparse) {
  const json& indices = sparse["indices"];
  const json& values = sparse["values"];
  return {size_or_zero(sparse, "count"),       index_or_none(indices, "bufferView"),
          size_or_zero(indices, "byteOffset"), component_type(indices),
          index_or_none(values, "bufferView"), size_or_zero(values, "byteOffset")};
}

std::vector<Accessor> take_accessors(const json& array) {
  struct Type {
    std::string_view name;
    int components;
  };
  constexpr Type types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                            {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
  std::vector<Accessor> accessors;
  for (const json& object : array) {
    Accessor accessor;
    accessor.view = index_or_none(object, "bufferView");
    accessor.byte_offset = size_or_zero(object, "byteOffset");
    accessor.component_type = component_type(object);
    accessor.normalized = object.value("normalized", false);
    accessor.count = size_or_zero(object, "count");
    const std::string& name = object["type"].get_ref<const std::string&>();
    for (const Type& type : types) {
      if (name == type.name) accessor.components = type.components;
    }
    accessor.matrix = name.starts_with("MAT");
    if (object.contains("sparse")) accessor.sparse = take_sparse(object["sparse"]);
    accessors.push_back(accessor);
  }
  return accessors;
}

std::vector<Image> take_images(json& array) {
  std::vector<Image> images;
  for (json& object : array) {
    Image image;
    image.name = object.value("name", std::string());
    image.uri = take_string(object, "uri");
    image.view = index_or_none(object, "bufferView");
    images.push_back(std::move(image));
  }
  return images;
}

// tinygltf checks that indices have an accessor with a buffer view; both are read here, so it gets
// empty ones.
void put_placeholders(json& root, std::size_t accessors) {
  root.erase("buffers");
  root.erase("images");
  root["bufferViews"] = json::array({{{"buffer", 0}, {"byteLength", 1}}});
  const json accessor = {
      {"bufferView", 0}, {"componentType", 5126}, {"count", 1}, {"type", "SCALAR"}};
  root["accessors"] = json::array();
  for (std::size_t i = 0; i < accessors; ++i) root["accessors"].push_back(accessor);
}

// The minor part of "2.MINOR"; none for anything else.
std::optional<int> minor_version(const std::string& version) {
  int minor = 0;
  const char* end = version.data() + version.size();
  if (!version.starts_with("2.")) return std::nullopt;
  const auto [stop, error] = std::from_chars(version.data() + 2, end, minor);
  if (error != std::errc() || stop != end || minor < 0) return std::nullopt;
  return minor;
}

void check_version(Context& context, const json& asset) {
  const std::string version = asset["version"].get<std::string>();
  const std::string needed = asset.value("minVersion", std::string("2.0"));
  const auto minor = minor_version(version);
  const auto needed_minor = minor_version(needed);
  if (!minor || !needed_minor || *needed_minor > *minor) {
    context.fail("/asset",
                 "glTF version " + printable(version) + " with a minimum of " + printable(needed) +
                     " is not supported",
                 "convert the file to glTF 2.0");
  }
  if (*needed_minor > 0) {
    context.warn("/asset", "is made for glTF " + needed + " and read as 2.0");
  }
}

std::vector<std::string> take_names(json& root, const char* list) {
  std::vector<std::string> names;
  if (!root.contains(list)) return names;
  for (const json& name : root[list]) {
    const auto& text = name.get_ref<const std::string&>();
    if (std::find(names.begin(), names.end(), text) == names.end()) names.push_back(text);
  }
  root.erase(list);
  return names;
}

// Types that the schema leaves to the value of another property.
void check_kinds(const Context& context, const json& root) {
  const auto check = [&](const json& array, const std::string& where, const char* kind) {
    for (std::size_t i = 0; i < array.size(); ++i) {
      if (array[i]["type"] == kind && !array[i].contains(kind)) {
        context.fail(where + std::to_string(i), std::string("has no ") + kind);
      }
    }
  };
  if (root.contains("cameras")) {
    check(root["cameras"], "/cameras/", "perspective");
    check(root["cameras"], "/cameras/", "orthographic");
  }
  const json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
  if (root.contains(lights)) {
    check(root.at(lights), "/extensions/KHR_lights_punctual/lights/", "spot");
  }
}

// An empty object of three characters becomes a structure of up to kilobytes.
void claim_model(Context& context, const json& root) {
  const std::pair<const char*, std::size_t> arrays[] = {
      {"accessors", sizeof(tinygltf::Accessor)}, {"animations", sizeof(tinygltf::Animation)},
      {"cameras", sizeof(tinygltf::Camera)},     {"materials", sizeof(tinygltf::Material)},
      {"meshes", sizeof(tinygltf::Mesh)},        {"nodes", sizeof(tinygltf::Node)},
      {"samplers", sizeof(tinygltf::Sampler)},   {"scenes", sizeof(tinygltf::Scene)},
      {"skins", sizeof(tinygltf::Skin)},         {"textures", sizeof(tinygltf::Texture)},
  };
  for (const auto& [name, size] : arrays) {
    const auto it = root.find(name);
    if (it != root.end()) context.claim(it->size(), size, std::string("/") + name);
  }
}

tinygltf::Model read_model(const Context& context, json root) {
  std::string text = root.dump();
  root = nullptr;
  if (text.size() > std::numeric_limits<unsigned int>::max()) {
    context.fail("", "JSON of more than 4 GiB", "keep geometry in binary buffers");
  }
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  std::string errors;
  std::string warnings;
  if (!reader.LoadASCIIFromString(&model, &errors, &warnings, text.c_str(),
                                  static_cast<unsigned int>(text.size()), "")) {
    context.fail("", "not readable as glTF: " + printable(errors));
  }
  return model;
}

}  // namespace

Document parse_document(Context& context, Container container) {
  Document document;
  json root = parse_json(context, std::move(container.json));
  apply_schema(context, root);
  check_version(context, root["asset"]);
  check_kinds(context, root);
  context.report.format = container.binary ? "glTF 2.0 binary" : "glTF 2.0";
  context.report.generator = root["asset"].value("generator", std::string());
  const auto used = take_names(root, "extensionsUsed");
  check_extensions(context, used, take_names(root, "extensionsRequired"));

  document.chunk = std::move(container.chunk);
  document.buffers = take_buffers(root["buffers"]);
  document.views = take_views(root["bufferViews"]);
  document.accessors = take_accessors(root["accessors"]);
  document.images = take_images(root["images"]);
  claim_model(context, root);
  put_placeholders(root, document.accessors.size());
  document.model = read_model(context, std::move(root));
  return document;
}

}  // namespace lumivec::gltf
