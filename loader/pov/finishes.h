// Finishes: how surfaces reflect and shine.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// After the word "finish": { ... }, which changes what finish holds.
void parse_finish_block(Parser& parser, Finish& finish);

}  // namespace lumivec::pov
