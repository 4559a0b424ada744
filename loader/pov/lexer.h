// Scene text to tokens, all at once, so that loops and macros run over tokens.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "loader/pov/symbols.h"
#include "loader/pov/token.h"

namespace lumivec::pov {

struct TokenText {
  std::vector<Token> tokens;         // the last one is of kind end
  std::vector<std::string> strings;  // without quotes; escapes as written
};

// Costs one pass. Never fails: what is no token becomes one of kind invalid, which says why, and
// harms only if it is reached. Directives of blocks are linked by Token::jump. most_bytes: of
// tokens, strings and names; what would pass it becomes an invalid token, and the end.
TokenText lex(std::string_view text, Symbols& symbols, std::uint64_t most_bytes);

}  // namespace lumivec::pov
