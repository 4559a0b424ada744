// Which glTF extensions are understood, and how to read the properties of one.
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <string_view>

#include "loader/gltf/context.h"
#include "loader/scene.h"
#include "loader/to_float.h"

namespace lumivec::gltf {

// Fails for a required extension that is not supported; warns of one that is only used.
void check_extensions(Context& context, const std::vector<std::string>& used,
                      const std::vector<std::string>& required);

// The properties of an extension, or null where the element does not have it.
const tinygltf::Value* find_extension(const tinygltf::ExtensionMap& extensions,
                                      const std::string& name);

// One property of an extension; the schema has checked its type.
double number_or(const tinygltf::Value& extension, const std::string& name, double fallback);
Color color_or(const tinygltf::Value& extension, const std::string& name, Color fallback);
V2f vector_or(const tinygltf::Value& extension, const std::string& name, V2f fallback);
int index_or(const tinygltf::Value& extension, const std::string& name, int fallback);

}  // namespace lumivec::gltf
