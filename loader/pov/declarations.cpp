#include "loader/pov/declarations.h"

#include "loader/pov/arrays.h"
#include "loader/pov/values.h"

namespace lumivec::pov {
namespace {

// Numbers need the semicolon: where it is missing, the directives that follow have been obeyed
// before the number was complete.
void end_declaration(Parser& parser, const Place& place, bool numeric) {
  if (!numeric) {
    if (parser.next_is(';')) parser.accept(';');
    return;
  }
  constexpr double first_strict_version = 3.1;
  if (!parser.accept(';') && parser.scene.version >= first_strict_version) {
    parser.fail_at(place, "the declaration of a number, vector or color does not end with ';'",
                   "add it");
  }
}

}  // namespace

void declare(Parser& parser, bool local) {
  Token name = parser.raw_take();
  // #declare deprecated once "why" NAME = ...
  if (name.is_identifier() && parser.symbols.text(name.word) == "deprecated") {
    while (parser.raw_peek().is(K::once_) || parser.raw_peek().kind == TokenKind::string)
      parser.raw_take();
    name = parser.raw_take();
  }
  const Place place = parser.place();
  if (!name.is_identifier()) {
    parser.fail("an identifier is expected to declare, but " + parser.describe(name) + " is found",
                name.is_keyword() ? "choose a name that is no word of the language" : "");
  }
  const Slot* known = parser.symbols.find(name.word);
  if (known && (*known)->kind == ValueKind::array && parser.raw_peek().is('[')) {
    const Slot array = *known;
    const std::size_t index = parse_array_index(parser, array);
    parser.expect('=', "#declare");
    Value value = parse_value(parser);
    const bool numeric = value.kind == ValueKind::number;
    set_array_element(parser, *array, index, std::move(value));
    return end_declaration(parser, place, numeric);
  }
  if (!parser.raw_take().is('=')) parser.fail("'=' is expected after the name that is declared");
  Value value = parse_value(parser);
  const bool numeric = value.kind == ValueKind::number;
  if (local) {
    parser.symbols.declare_local(name.word, std::move(value));
  } else {
    parser.symbols.declare(name.word, std::move(value));
  }
  end_declaration(parser, place, numeric);
}

void undefine(Parser& parser) {
  const Token name = parser.raw_take();
  if (name.is_identifier() && parser.symbols.undefine(name.word)) return;
  if (!name.is_identifier()) {
    parser.fail("#undef needs an identifier, but " + parser.describe(name) + " is found");
  }
}

}  // namespace lumivec::pov
