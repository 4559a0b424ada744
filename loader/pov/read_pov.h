// POV-Ray scenes to Scene.
#pragma once

#include <string_view>

#include "loader/byte_source.h"
#include "loader/load_scene.h"
#include "loader/pov/pov_scene.h"

namespace lumivec::pov {

// Is it called as POV-Ray's scenes are, .pov or .inc? The language has no mark of its own.
bool looks_like_pov(const std::filesystem::path& file);

// What the scene's text describes. Costs time in proportion to what its loops and macros do, within
// LoadOptions::language. Throws SceneError.
PovScene parse_pov(const std::filesystem::path& file, std::string_view text,
                   const LoadOptions& options, LoadReport& report);

// The same as a Scene. Throws SceneError.
Scene read_pov(const std::filesystem::path& file, const ByteSource& bytes,
               const LoadOptions& options, LoadReport& report);

}  // namespace lumivec::pov
