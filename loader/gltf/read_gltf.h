// glTF 2.0 files, text and binary, to Scene.
#pragma once

#include "loader/byte_source.h"
#include "loader/load_scene.h"

namespace lumivec::gltf {

// Does the file begin as a .glb, or as JSON text?
bool looks_like_gltf(const ByteSource& bytes);

// Reads the file whose bytes are given; file names it and the folder of its resources. Costs one
// pass over the geometry that the scene uses, and no copy of it. Throws SceneError.
Scene read_gltf(const std::filesystem::path& file, const ByteSource& bytes,
                const LoadOptions& options, LoadReport& report);

}  // namespace lumivec::gltf
