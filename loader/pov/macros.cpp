#include "loader/pov/macros.h"

#include <algorithm>

#include "loader/pov/arrays.h"
#include "loader/pov/values.h"

namespace lumivec::pov {
namespace {

bool ends_argument(const Token& token) {
  return token.is(',') || token.is(')');
}

// After an array's name: is what follows an element and nothing else?
bool is_lone_element(const Parser& parser) {
  std::size_t ahead = 1;
  int depth = 0;
  for (;; ++ahead) {
    const Token& token = parser.raw_peek(ahead);
    if (token.is('[')) ++depth;
    if (token.is(']')) --depth;
    if (token.kind == TokenKind::end || token.kind == TokenKind::directive) return false;
    if (depth == 0 && !token.is(']')) return ahead > 1 && ends_argument(token);
  }
}

// The argument as the caller's own slot; null: it is an expression.
Slot shared_argument(Parser& parser) {
  if (parser.has_peeked()) return nullptr;  // the comma before it was left out
  const Token& token = parser.raw_peek();
  if (!token.is_identifier()) return nullptr;
  const Slot* slot = parser.symbols.find(token.word);
  if (!slot || (*slot)->kind == ValueKind::macro) return nullptr;
  if (ends_argument(parser.raw_peek(1))) {
    const Slot found = *slot;
    parser.raw_take();
    return found;
  }
  if ((*slot)->kind != ValueKind::array || !is_lone_element(parser)) return nullptr;
  const Slot array = *slot;
  parser.take();
  return array_element_slot(parser, array);
}

Slot read_argument(Parser& parser) {
  if (Slot shared = shared_argument(parser)) return shared;
  return std::make_shared<Value>(parse_value(parser));
}

}  // namespace

void define_macro(Parser& parser, std::uint32_t directive) {
  const Place begin = parser.place();
  const Token name = parser.raw_take();
  if (!name.is_identifier()) {
    parser.fail("#macro needs a name of its own, but " + parser.describe(name) + " is found");
  }
  auto macro = std::make_shared<Macro>();
  macro->name = name.word;
  macro->source = parser.frame().source;
  if (!parser.raw_take().is('(')) parser.fail("'(' is expected after the macro's name");
  Token token = parser.raw_take();
  while (!token.is(')')) {
    if (token.kind != TokenKind::word) {
      parser.fail("the name of a parameter is expected, but " + parser.describe(token) +
                  " is found");
    }
    if (!token.is_identifier()) {
      parser.fail("'" + parser.symbols.text(token.word) +
                  "' is a word of the language and cannot name a parameter");
    }
    macro->parameters.push_back(token.word);
    token = parser.raw_take();
    if (token.is(',')) token = parser.raw_take();
  }
  const std::vector<Token>& tokens = parser.sources[macro->source].text.tokens;
  macro->begin = parser.frame().position();
  macro->end = tokens[directive].jump;
  if (macro->end == 0) parser.fail_at(begin, "the macro has no #end");
  parser.frame().go_to(macro->end + 1);
  parser.symbols.declare(name.word, {ValueKind::macro, macro});
}

void call_macro(Parser& parser, const std::shared_ptr<const Macro>& macro) {
  parser.count_step();
  const Place called_at = parser.place();
  if (!parser.raw_peek().is('(')) {
    parser.fail("'(' is expected after the macro " + parser.symbols.text(macro->name));
  }
  parser.raw_take();
  // Calls within the arguments leave the list as they find it.
  const std::size_t first = parser.arguments.size(), wanted = macro->parameters.size();
  const auto given = [&] { return parser.arguments.size() - first; };
  if (parser.raw_peek().is(')')) {
    parser.raw_take();
  } else {
    while (given() == 0 || !parser.next_is(')')) {
      if (given() == wanted) {
        parser.fail("the macro " + parser.symbols.text(macro->name) + " takes " +
                    std::to_string(wanted) + " parameters, but more are given");
      }
      parser.arguments.push_back(read_argument(parser));
      // A name that comes next must not be looked at: it may be shared.
      if (!parser.next_is(',') && !parser.next_is(')')) parser.peek();
      if (parser.next_is(',')) parser.accept(',');
    }
    parser.accept(')');
  }
  if (given() < wanted) {
    parser.fail("the macro " + parser.symbols.text(macro->name) + " takes " +
                std::to_string(wanted) + " parameters, but only " + std::to_string(given()) +
                " are given");
  }
  parser.push(macro->source, macro->begin, macro->end, macro, called_at);
  parser.symbols.open_scope();
  for (std::size_t i = 0; i < wanted; ++i)
    parser.symbols.bind(macro->parameters[i], std::move(parser.arguments[first + i]));
  parser.arguments.resize(first);
}

}  // namespace lumivec::pov
