// What stands in a scene besides directives: objects, camera, background, settings.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// Reads to the end of the scene.
void parse_scene_items(Parser& parser);

}  // namespace lumivec::pov
