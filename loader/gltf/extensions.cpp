#include "loader/gltf/extensions.h"

#include <algorithm>
#include <array>

namespace lumivec::gltf {
namespace {

constexpr std::array<std::string_view, 12> supported{
    "EXT_mesh_gpu_instancing",
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_clearcoat",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_volume",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
};

bool is_supported(std::string_view name) {
  return std::find(supported.begin(), supported.end(), name) != supported.end();
}

std::string_view remedy(std::string_view name) {
  if (name == "KHR_draco_mesh_compression" || name == "EXT_meshopt_compression") {
    return "export the file without mesh compression";
  }
  if (name == "KHR_texture_basisu") return "export the textures as PNG, JPEG or WebP";
  return "export the file without this extension";
}

double element(const tinygltf::Value& array, std::size_t i) {
  return array.Get(static_cast<int>(i)).GetNumberAsDouble();
}

}  // namespace

void check_extensions(Context& context, const std::vector<std::string>& used,
                      const std::vector<std::string>& required) {
  context.report.extensions_used = used;
  for (std::size_t i = 0; i < required.size(); ++i) {
    if (is_supported(required[i])) continue;
    context.fail(pointer({"extensionsRequired", i}),
                 "required extension " + printable(required[i]) + " is not supported",
                 remedy(required[i]));
  }
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (is_supported(used[i])) continue;
    context.report.extensions_ignored.push_back(used[i]);
    context.warn(pointer({"extensionsUsed", i}),
                 "extension " + printable(used[i]) + " is not supported and left out");
  }
}

const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions,
                                      const std::string& name) {
  const auto it = extensions.find(name);
  return it == extensions.end() ? nullptr : &it->second;
}

double number_or(const tinygltf::Value& extension, const std::string& name, double fallback) {
  return extension.Has(name) ? extension.Get(name).GetNumberAsDouble() : fallback;
}

Color color_or(const tinygltf::Value& extension, const std::string& name, Color fallback) {
  if (!extension.Has(name)) return fallback;
  const tinygltf::Value& array = extension.Get(name);
  return {to_float(element(array, 0)), to_float(element(array, 1)), to_float(element(array, 2))};
}

V2f vector_or(const tinygltf::Value& extension, const std::string& name, V2f fallback) {
  if (!extension.Has(name)) return fallback;
  const tinygltf::Value& array = extension.Get(name);
  return {to_float(element(array, 0)), to_float(element(array, 1))};
}

int index_or(const tinygltf::Value& extension, const std::string& name, int fallback) {
  return extension.Has(name) ? extension.Get(name).GetNumberAsInt() : fallback;
}

}  // namespace lumivec::gltf
