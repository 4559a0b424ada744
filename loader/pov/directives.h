// What begins with #.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// The token at hand is the directive: does what it says, and leaves the stream after it.
void obey_directive(Parser& parser);

}  // namespace lumivec::pov
