// Macros: their definitions and calls.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// After #macro: reads name and parameters, and skips the body.
void define_macro(Parser& parser, std::uint32_t directive);

// After the macro's name: reads what the call gives, and makes the body's tokens come next. What is
// given as a single identifier or array element is shared with the caller: the macro can change it.
void call_macro(Parser& parser, const std::shared_ptr<const Macro>& macro);

}  // namespace lumivec::pov
