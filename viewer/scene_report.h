// What `lumivec info` tells of a scene.
#pragma once

#include <string>

#include "loader/load_scene.h"
#include "loader/scene.h"

namespace lumivec {

// file: as the user named it. As lines for a person, or as JSON with every item.
std::string scene_text(const std::string& file, const Scene& scene, const LoadReport& report);
std::string scene_json(const std::string& file, const Scene& scene, const LoadReport& report);

}  // namespace lumivec
