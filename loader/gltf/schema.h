// Checks a glTF tree against the properties that this reader knows, and takes everything else out
// of it.
//
// After it, every known property has its JSON type, every reference names an element that exists,
// every required property is there, integers fit where they are stored, and numbers are floating
// point. What remains is small, whatever an author has put into extras. Ranges and meaning are
// checked where the values are used.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "loader/gltf/context.h"

namespace lumivec::gltf {

enum class Kind : std::uint8_t {
  boolean,
  string,
  strings,  // array of
  number,
  numbers,       // array of, length of them (0: any)
  small,         // integer in [0, 2^31)
  size,          // integer in [0, 2^53]
  index,         // into the top-level array target
  indices,       // array of them
  index_map,     // object of them, any names
  index_maps,    // array of those
  object,        // of schema
  objects,       // array of them
  sphere_extras  // extras of a primitive, of which {"sphere": {"radius": number}} is kept and
                 // nothing else
};

struct Schema;

struct Property {
  std::string_view name;
  Kind kind;
  bool required = false;
  std::string_view target = {};
  const Schema* schema = nullptr;
  std::size_t length = 0;
};

struct Schema {
  std::span<const Property> properties;
};

// The whole file.
extern const Schema root_schema;

// Throws SceneError at the first property that breaks its rule.
void apply_schema(const Context& context, nlohmann::json& root);

}  // namespace lumivec::gltf
