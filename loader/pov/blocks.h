// Which directive ends or divides which block.
#pragma once

#include <vector>

#include "loader/pov/token.h"

namespace lumivec::pov {

// Sets Token::jump of #if, #ifdef, #ifndef, #switch, #while, #for, #macro, #elseif, #else, #case
// and #range. Blocks begin and end in one source.
void link_blocks(std::vector<Token>& tokens);

}  // namespace lumivec::pov
