// The outer shell of a glTF 2.0 file: its JSON text, and the binary chunk of a .glb (glTF 2.0,
// section 4).
#pragma once

#include <optional>
#include <string>

#include "loader/byte_source.h"
#include "loader/gltf/context.h"

namespace lumivec::gltf {

struct Container {
  bool binary = false;              // a .glb
  std::string json;                 // not yet checked
  std::optional<ByteSource> chunk;  // BIN, if there is one
};

// Claims the size of the JSON. Throws SceneError where the header or a chunk contradicts the file's
// size, or the version is not 2.
Container read_container(Context& context, const ByteSource& file);

}  // namespace lumivec::gltf
