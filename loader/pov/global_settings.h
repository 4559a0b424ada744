// global_settings: what holds for the whole scene.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// After the word "global_settings": { ... }.
void parse_global_settings(Parser& parser);

}  // namespace lumivec::pov
