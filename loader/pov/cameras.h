// The camera.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// After the word "camera": { ... }.
PovCamera parse_camera_block(Parser& parser);

}  // namespace lumivec::pov
