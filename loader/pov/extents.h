// min_extent and max_extent.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// After the opening parenthesis: a declared object.
Number extent_function(Parser& parser, bool largest);

}  // namespace lumivec::pov
