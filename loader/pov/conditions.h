// Blocks that are obeyed or skipped: #if and its kind, #switch, #while, #for. index: of the
// directive among its source's tokens.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

void begin_condition(Parser& parser, std::uint32_t index);  // #if, #ifdef, #ifndef
void end_branch(Parser& parser);                            // #else, #elseif
void begin_choice(Parser& parser, std::uint32_t index);     // #switch
void pass_case(Parser& parser, std::uint32_t index);        // #case, #range
void begin_while(Parser& parser, std::uint32_t index);
void begin_for(Parser& parser, std::uint32_t index);
void break_block(Parser& parser);
void end_block(Parser& parser);

}  // namespace lumivec::pov
