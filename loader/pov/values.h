// What can stand on the right of #declare, in an array, and in a macro's call.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

Value parse_value(Parser& parser);

}  // namespace lumivec::pov
