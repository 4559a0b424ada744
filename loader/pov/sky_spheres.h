// sky_sphere: pigments at infinity.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// After the word "sky_sphere": { ... }.
SkySphere parse_sky_sphere_block(Parser& parser);

}  // namespace lumivec::pov
