#include "loader/pov/expression.h"

#include <cmath>
#include <numbers>

#include "loader/pov/arithmetic.h"
#include "loader/pov/arrays.h"
#include "loader/pov/functions.h"
#include "loader/pov/number_functions.h"
#include "loader/pov/splines.h"

namespace lumivec::pov {
namespace {

constexpr double equal_within = 1e-10;  // floats that = and its kind take for equal

Number unit(int axis, std::uint8_t size) {
  Number number;
  number.size = size;
  number.n[static_cast<std::size_t>(axis)] = 1.0;
  return number;
}

Number parse_vector_literal(Parser& parser) {
  const Nesting nesting(parser);
  Number vector;
  vector.size = 0;
  while (!parser.accept('>')) {
    if (vector.size == vector.n.size()) parser.fail("a vector has more than 5 components");
    vector.n[vector.size++] = parse_float(parser, "a vector");
    if (!parser.accept(',') && !parser.at('>') && !begins_number(parser))
      parser.fail_expected("'>' of a vector");
  }
  if (vector.size < 2) parser.fail("a vector has fewer than 2 components");
  return vector;
}

void parse_components(Parser& parser, Number& number) {
  while (parser.accept('.')) {
    if (parser.accept(K::gray_)) {
      number = Number(0.297 * number.n[0] + 0.589 * number.n[1] + 0.114 * number.n[2]);
      continue;
    }
    const std::optional<std::size_t> named = component_of(parser.peek().keyword());
    if (!named) parser.fail_expected("the name of a component, such as x or red,");
    const std::size_t index = *named;
    parser.take();
    if (number.size == 1) number.n.fill(number.n[0]);
    if (number.size > 1 && index >= number.size) number.n[index] = 0.0;
    number = Number(number.n[index]);
  }
}

Number operand_of(Parser& parser, const Value& value) {
  switch (value.kind) {
    case ValueKind::number:
      return value.number;
    case ValueKind::function:
      return call_function(parser, value.share<Function>());
    case ValueKind::spline:
      return call_spline(parser, value.as<Spline>());
    default:
      parser.fail(std::string("a number is expected, but ") + kind_name(value.kind) + " is found");
  }
}

Number parse_word(Parser& parser) {
  const Token& token = parser.peek();
  if (token.is_identifier()) {
    const Slot* slot = parser.symbols.find(token.word);
    if (!slot) parser.fail_expected("a number");
    const Slot held = *slot;
    parser.take();
    if (held->kind == ValueKind::array)
      return operand_of(parser, parse_array_element(parser, held));
    return operand_of(parser, *held);
  }
  switch (token.keyword()) {
    case K::x_:
      return parser.take(), unit(0, 3);
    case K::y_:
      return parser.take(), unit(1, 3);
    case K::z_:
      return parser.take(), unit(2, 3);
    case K::u_:
      return parser.take(), unit(0, 2);
    case K::v_:
      return parser.take(), unit(1, 2);
    case K::t_:
      return parser.take(), unit(3, 4);
    default:
      return parse_function_word(parser);
  }
}

// Expressions are read into their place: a Number is too large to be handed on at each level.
void read_primary(Parser& parser, Number& number) {
  const Token& token = parser.peek();
  if (token.kind == TokenKind::number) {
    number = Number(parser.take().number);
    return;
  }
  if (token.kind == TokenKind::word) {
    // Most words name a number.
    const Slot* slot = parser.meaning(token);
    if (slot && (*slot)->kind == ValueKind::number) {
      number = (*slot)->number;
      parser.take();
    } else {
      number = parse_word(parser);
    }
  } else if (parser.accept('<')) {
    number = parse_vector_literal(parser);
  } else if (parser.accept('(')) {
    const Nesting nesting(parser);
    number = parse_full_number(parser);
    parser.expect(')', "an expression");
  } else {
    parser.fail_expected("a number");
  }
  parse_components(parser, number);
}

void read_unary(Parser& parser, Number& number) {
  if (parser.peek().kind != TokenKind::punctuation) return read_primary(parser, number);
  bool negative = false;
  while (parser.at('-') || parser.at('+')) negative ^= parser.take().is('-');
  if (parser.accept('!')) {
    const Nesting nesting(parser);
    read_unary(parser, number);
    number = Number(number.n[0] == 0.0 ? 1.0 : 0.0);
  } else {
    read_primary(parser, number);
  }
  if (negative) {
    for (double& n : number.n) n = -n;
  }
}

double divide(Parser& parser, double a, double b) {
  if (b != 0.0) return a / b;
  constexpr double instead_of_infinity = 1e300;
  parser.mention(parser.place(), "a division by zero");
  return a < 0.0 ? -instead_of_infinity : instead_of_infinity;
}

void continue_product(Parser& parser, Number& left) {
  while (parser.peek().kind == TokenKind::punctuation) {
    const bool times = parser.at('*');
    if (!times && !parser.at('/')) return;
    parser.take();
    Number right;
    read_unary(parser, right);
    if (times) {
      combine(left, right, [](double a, double b) { return a * b; });
    } else {
      combine(left, right, [&](double a, double b) { return divide(parser, a, b); });
    }
  }
}

void read_product(Parser& parser, Number& number) {
  read_unary(parser, number);
  continue_product(parser, number);
}

void continue_sum(Parser& parser, Number& left) {
  while (parser.peek().kind == TokenKind::punctuation) {
    const bool plus = parser.at('+');
    if (!plus && !parser.at('-')) return;
    parser.take();
    Number right;
    read_product(parser, right);
    if (plus) {
      combine(left, right, [](double a, double b) { return a + b; });
    } else {
      combine(left, right, [](double a, double b) { return a - b; });
    }
  }
}

bool equal(const Number& a, const Number& b) {
  return std::abs(a.n[0] - b.n[0]) < equal_within;
}

Number parse_comparison(Parser& parser) {
  Number left = parse_number(parser);
  for (;;) {
    const Token& token = parser.peek();
    if (token.kind != TokenKind::punctuation) return left;
    bool holds = false;
    const auto right = [&] {
      parser.take();
      return parse_number(parser);
    };
    if (token.is('=')) {
      holds = equal(left, right());
    } else if (token.is('!', '=')) {
      holds = !equal(left, right());
    } else if (token.is('<')) {
      const Number other = right();
      holds = left.n[0] < other.n[0] && !equal(left, other);
    } else if (token.is('>')) {
      const Number other = right();
      holds = left.n[0] > other.n[0] && !equal(left, other);
    } else if (token.is('<', '=')) {
      const Number other = right();
      holds = left.n[0] <= other.n[0] || equal(left, other);
    } else if (token.is('>', '=')) {
      const Number other = right();
      holds = left.n[0] >= other.n[0] || equal(left, other);
    } else {
      return left;
    }
    left = Number(holds ? 1.0 : 0.0);
  }
}

Number parse_logic(Parser& parser) {
  Number left = parse_comparison(parser);
  for (;;) {
    const bool conjunction = parser.at('&');
    if (!conjunction && !parser.at('|')) return left;
    parser.take();
    const Number right = parse_comparison(parser);
    const bool a = left.n[0] != 0.0, b = right.n[0] != 0.0;
    left = Number((conjunction ? a && b : a || b) ? 1.0 : 0.0);
  }
}

}  // namespace

Number parse_number_operand(Parser& parser) {
  Number number;
  read_primary(parser, number);
  return number;
}

Number parse_number(Parser& parser) {
  Number number;
  read_product(parser, number);
  continue_sum(parser, number);
  return number;
}

Number parse_number_from(Parser& parser, const Value& first) {
  Number number = operand_of(parser, first);
  parse_components(parser, number);
  continue_product(parser, number);
  continue_sum(parser, number);
  return number;
}

Number parse_full_number(Parser& parser) {
  const Number condition = parse_logic(parser);
  if (!parser.accept('?')) return condition;
  const Nesting nesting(parser);
  const Number first = parse_full_number(parser);
  parser.expect(':', "a choice");
  const Number second = parse_full_number(parser);
  return condition.n[0] != 0.0 ? first : second;
}

double parse_condition(Parser& parser) {
  return parse_full_number(parser).n[0];
}

double parse_float(Parser& parser, std::string_view construct) {
  const Number number = parse_number(parser);
  if (number.size != 1) {
    parser.fail("a float is expected for " + std::string(construct) + ", but a vector of " +
                std::to_string(number.size) + " components is found");
  }
  return number.n[0];
}

int parse_int(Parser& parser, std::string_view construct) {
  const double value = parse_float(parser, construct);
  constexpr double limit = 2147483647.0;
  if (!(value >= -limit && value <= limit)) {
    parser.fail("the number for " + std::string(construct) + " is out of range");
  }
  return static_cast<int>(value);
}

V3d to_vector(const Number& number) {
  if (number.size == 1) return V3d(number.n[0]);
  return V3d(number.n[0], number.n[1], number.size > 2 ? number.n[2] : 0.0);
}

Number to_number(const V3d& vector) {
  Number number;
  number.size = 3;
  for (int i = 0; i < 3; ++i) number.n[static_cast<std::size_t>(i)] = vector[i];
  return number;
}

V3d parse_vector(Parser& parser) {
  return to_vector(parse_number(parser));
}

std::array<double, 2> parse_pair(Parser& parser) {
  const Number number = parse_number(parser);
  return {number.n[0], number.size == 1 ? number.n[0] : number.n[1]};
}

bool parse_switch(Parser& parser) {
  return !begins_number(parser) || parse_condition(parser) != 0.0;
}

bool begins_number(Parser& parser) {
  const Token& token = parser.peek();
  if (token.kind == TokenKind::number || token.is('<') || token.is('(') || token.is('-') ||
      token.is('+') || token.is('!')) {
    return true;
  }
  if (token.is_keyword()) {
    switch (token.keyword()) {
      case K::x_:
      case K::y_:
      case K::z_:
      case K::u_:
      case K::v_:
      case K::t_:
        return true;
      default:
        return begins_function_word(token.keyword());
    }
  }
  const Slot* slot = parser.meaning(token);
  if (!slot) return false;
  const ValueKind kind = (*slot)->kind;
  if (kind == ValueKind::array) return array_holds(**slot, ValueKind::number);
  return kind == ValueKind::number || kind == ValueKind::function || kind == ValueKind::spline;
}

bool parse_defined(Parser& parser) {
  const Token& name = parser.raw_take();
  if (!name.is_identifier()) {
    if (name.is_keyword()) return true;
    parser.fail("an identifier is expected, but " + parser.describe(name) + " is found");
  }
  const Slot* slot = parser.symbols.find(name.word);
  if (!slot || (*slot)->kind != ValueKind::array || !parser.raw_peek().is('[')) return slot;
  const Slot array = *slot;
  const std::size_t index = parse_array_index(parser, array);
  return array->as<Array>().elements[index].kind != ValueKind::none;
}

}  // namespace lumivec::pov
