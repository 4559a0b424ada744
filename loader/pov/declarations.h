// #declare, #local and #undef.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

void declare(Parser& parser, bool local);
void undefine(Parser& parser);

}  // namespace lumivec::pov
