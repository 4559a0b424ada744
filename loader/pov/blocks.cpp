#include "loader/pov/blocks.h"

namespace lumivec::pov {
namespace {

bool opens(const Token& token) {
  return token.is_directive(K::if_) || token.is_directive(K::ifdef_) ||
         token.is_directive(K::ifndef_) || token.is_directive(K::switch_) ||
         token.is_directive(K::while_) || token.is_directive(K::for_) ||
         token.is_directive(K::macro_);
}

bool divides(const Token& token) {
  return token.is_directive(K::elseif_) || token.is_directive(K::else_) ||
         token.is_directive(K::case_) || token.is_directive(K::range_);
}

}  // namespace

void link_blocks(std::vector<Token>& tokens) {
  std::vector<std::uint32_t> open;  // the directive of each open block that is to be linked next
  for (std::uint32_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    if (token.kind != TokenKind::directive) continue;
    if (opens(token)) {
      open.push_back(i);
    } else if (!open.empty() && divides(token)) {
      tokens[open.back()].jump = i;
      open.back() = i;
    } else if (!open.empty() && token.is_directive(K::end_)) {
      tokens[open.back()].jump = i;
      open.pop_back();
    }
  }
}

}  // namespace lumivec::pov
