// JSON text to a tree, with errors by line and column, and with a bounded depth so that walking it
// may recurse.
#pragma once

#include <nlohmann/json.hpp>

#include "loader/gltf/context.h"

namespace lumivec::gltf {

// Deeper than any file in use (an extension's texture transform is at 9), far from what a stack
// holds.
constexpr int max_json_depth = 128;

// Throws SceneError on a syntax error. Trailing zero bytes, which some exporters pad with, are no
// error.
nlohmann::json parse_json(const Context& context, std::string text);

}  // namespace lumivec::gltf
