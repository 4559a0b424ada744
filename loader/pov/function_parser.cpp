#include <algorithm>

#include "loader/pov/arrays.h"
#include "loader/pov/expression.h"
#include "loader/pov/functions.h"
#include "loader/pov/number_functions.h"
#include "loader/pov/patterns.h"
#include "loader/pov/pigments.h"
#include "loader/pov/transforms.h"

namespace lumivec::pov {
namespace {

class FunctionParser {
 public:
  FunctionParser(Parser& parser, Function& function) : parser_(parser), function_(function) {}

  std::uint32_t choice() { return logic(); }

 private:
  using Node = FunctionNode;

  std::uint32_t add(Operation operation, std::vector<std::uint32_t> operands) {
    Node node;
    node.operation = operation;
    node.operands = std::move(operands);
    return add(std::move(node));
  }
  std::uint32_t add(Node node) {
    parser_.claim(sizeof(Node));
    function_.nodes.push_back(std::move(node));
    return static_cast<std::uint32_t>(function_.nodes.size() - 1);
  }
  std::uint32_t constant(double value) {
    Node node;
    node.value = value;
    return add(std::move(node));
  }

  std::uint32_t logic() {
    std::uint32_t left = comparison();
    for (;;) {
      if (parser_.accept('&')) {
        left = add(Operation::both, {left, comparison()});
      } else if (parser_.accept('|')) {
        left = add(Operation::either, {left, comparison()});
      } else {
        return left;
      }
    }
  }

  std::uint32_t comparison() {
    std::uint32_t left = sum();
    for (;;) {
      const Token token = parser_.peek();
      const auto right = [&] {
        parser_.take();
        return sum();
      };
      if (token.is('<')) {
        left = add(Operation::less, {left, right()});
      } else if (token.is('>')) {
        left = add(Operation::less, {right(), left});
      } else if (token.is('<', '=')) {
        left = add(Operation::less_or_equal, {left, right()});
      } else if (token.is('>', '=')) {
        left = add(Operation::less_or_equal, {right(), left});
      } else if (token.is('=')) {
        left = add(Operation::equal, {left, right()});
      } else if (token.is('!', '=')) {
        left = add(Operation::unequal, {left, right()});
      } else {
        return left;
      }
    }
  }

  std::uint32_t sum() {
    std::uint32_t left = product();
    for (;;) {
      if (parser_.accept('+')) {
        left = add(Operation::add, {left, product()});
      } else if (parser_.accept('-')) {
        left = add(Operation::subtract, {left, product()});
      } else {
        return left;
      }
    }
  }

  std::uint32_t product() {
    std::uint32_t left = unary();
    for (;;) {
      if (parser_.accept('*')) {
        left = add(Operation::multiply, {left, unary()});
      } else if (parser_.accept('/')) {
        left = add(Operation::divide, {left, unary()});
      } else {
        return left;
      }
    }
  }

  std::uint32_t unary() {
    bool negative = false;
    while (parser_.at('-') || parser_.at('+')) negative ^= parser_.take().is('-');
    std::uint32_t node = 0;
    if (parser_.accept('!')) {
      const Nesting nesting(parser_);
      node = add(Operation::invert, {unary()});
    } else {
      node = primary();
    }
    return negative ? add(Operation::negate, {node}) : node;
  }

  std::uint32_t primary() {
    const Token token = parser_.peek();
    if (token.kind == TokenKind::number) return constant(parser_.take().number);
    const Nesting nesting(parser_);
    if (parser_.accept('(')) {
      const std::uint32_t inner = logic();
      parser_.expect(')', "a function");
      return inner;
    }
    if (token.kind != TokenKind::word) parser_.fail_expected("a number, parameter or function");
    const auto& names = function_.parameters;
    // Inner sums come last.
    const auto parameter = std::find(names.rbegin(), names.rend(), token.word);
    if (parameter != names.rend()) {
      parser_.take();
      Node node;
      node.operation = Operation::parameter;
      node.index = static_cast<std::uint32_t>(names.rend() - parameter - 1);
      return add(std::move(node));
    }
    return token.is_identifier() ? identifier(token) : keyword(token.keyword());
  }

  std::vector<std::uint32_t> arguments(std::string_view name) {
    std::vector<std::uint32_t> nodes;
    parser_.expect('(', name);
    while (!parser_.accept(')')) {
      nodes.push_back(logic());
      parser_.accept(',');
    }
    return nodes;
  }

  int component_of_result() {
    if (!parser_.accept('.')) return 0;
    const K word = parser_.take().keyword();
    if (word == K::gray_ || word == K::hf_gray_16_) return gray_component;
    const std::optional<std::size_t> named = component_of(word);
    if (!named) parser_.fail("the name of a component is expected after '.' in a function");
    return static_cast<int>(*named);
  }

  std::uint32_t identifier(const Token& token) {
    const Slot* slot = parser_.symbols.find(token.word);
    if (!slot) parser_.fail_expected("a parameter or number");
    const Slot held = *slot;
    if (held->kind == ValueKind::function || held->kind == ValueKind::spline) {
      parser_.take();
      std::shared_ptr<const Function> called;
      if (held->kind == ValueKind::spline) {
        auto of_spline = std::make_shared<Function>();
        of_spline->kind = FunctionKind::spline;
        of_spline->spline = held->share<Spline>();
        of_spline->parameters = {static_cast<Word>(K::t_)};
        called = of_spline;
      } else {
        called = held->share<Function>();
      }
      Node node;
      node.operation = Operation::call;
      node.operands = arguments("a function's call");
      if (called->kind != FunctionKind::internal &&
          node.operands.size() != called->parameters.size()) {
        parser_.fail("the function takes " + std::to_string(called->parameters.size()) +
                     " arguments, but " + std::to_string(node.operands.size()) + " are given");
      }
      node.component = component_of_result();
      node.index = static_cast<std::uint32_t>(function_.functions.size());
      function_.functions.push_back(std::move(called));
      return add(std::move(node));
    }
    if (held->kind != ValueKind::number && held->kind != ValueKind::array)
      parser_.fail_expected("a parameter or number");
    const Number number = parse_number_operand(parser_);
    if (number.size != 1) parser_.fail("a function's body cannot hold a vector; take a component");
    return constant(number.n[0]);
  }

  std::uint32_t keyword(K word) {
    if (const auto value = float_constant(parser_, word)) {
      parser_.take();
      return constant(*value);
    }
    if (const FloatFunction* built_in = float_function(word)) {
      parser_.take();
      Node node;
      node.operation = Operation::built_in;
      node.keyword = word;
      node.operands = arguments(keyword_text(word));
      if (node.operands.size() != static_cast<std::size_t>(built_in->count)) {
        parser_.fail(std::string(keyword_text(word)) + " takes " + std::to_string(built_in->count) +
                     " arguments");
      }
      return add(std::move(node));
    }
    switch (word) {
      case K::min_:
      case K::max_: {
        parser_.take();
        auto given = arguments("min or max");
        if (given.empty()) parser_.fail("min and max need an argument");
        return add(word == K::min_ ? Operation::minimum : Operation::maximum, std::move(given));
      }
      case K::select_: {
        parser_.take();
        auto given = arguments("select");
        if (given.size() == 3) given.push_back(given[2]);
        if (given.size() != 4) parser_.fail("select takes 3 or 4 arguments");
        return add(Operation::choose, std::move(given));
      }
      case K::sum_:
      case K::prod_:
        return series(word == K::sum_ ? Operation::sum : Operation::product);
      default:
        // Everything else is a number that is known now: vlength (V), rand (R).
        return constant(parse_float_operand());
    }
  }

  double parse_float_operand() {
    const Number number = parse_number_operand(parser_);
    if (number.size != 1) parser_.fail("a function's body cannot hold a vector; take a component");
    return number.n[0];
  }

  // sum (i, FIRST, LAST, TERM): i is one more parameter while TERM is read.
  std::uint32_t series(Operation operation) {
    parser_.take();
    parser_.expect('(', "sum or prod");
    const Token variable = parser_.take();
    if (variable.kind != TokenKind::word) parser_.fail("sum and prod need the name of a variable");
    parser_.expect(',', "sum or prod");
    const std::uint32_t first = logic();
    parser_.expect(',', "sum or prod");
    const std::uint32_t last = logic();
    parser_.expect(',', "sum or prod");
    Node node;
    node.operation = operation;
    node.index = static_cast<std::uint32_t>(function_.parameters.size());
    const auto begin = static_cast<std::uint32_t>(function_.nodes.size());
    function_.parameters.push_back(variable.word);
    const std::uint32_t term = logic();
    function_.parameters.pop_back();
    parser_.expect(')', "sum or prod");
    node.operands = {first, last, term, begin};
    return add(std::move(node));
  }

  Parser& parser_;
  Function& function_;
};

void parse_parameters(Parser& parser, Function& function) {
  if (!parser.next_is('(')) {
    function.parameters = {static_cast<Word>(K::x_), static_cast<Word>(K::y_),
                           static_cast<Word>(K::z_)};
    return;
  }
  parser.raw_take();
  for (Token token = parser.raw_take(); !token.is(')'); token = parser.raw_take()) {
    if (token.is(',')) continue;
    if (token.kind != TokenKind::word) parser.fail("the name of a parameter is expected");
    function.parameters.push_back(token.word);
  }
}

}  // namespace

std::shared_ptr<const Function> parse_function(Parser& parser) {
  const Nesting nesting(parser);
  auto function = std::make_shared<Function>();
  parse_parameters(parser, *function);
  // Pictures of a given size are only of use to height fields.
  if (begins_number(parser)) {
    parse_float(parser, "function");
    skip_comma(parser);
    parse_float(parser, "function");
  }
  parser.expect('{', "a function");
  if (parser.accept(K::pigment_)) {
    function->kind = FunctionKind::pigment;
    function->pigment = std::make_shared<const Pigment>(parse_pigment_block(parser));
  } else if (parser.accept(K::pattern_)) {
    function->kind = FunctionKind::pattern;
    function->pattern = parse_pattern_block(parser);
  } else if (parser.accept(K::transform_)) {
    function->kind = FunctionKind::transform;
    function->transform = parse_transform_block(parser);
  } else if (parser.accept(K::spline_)) {
    function->kind = FunctionKind::spline;
    function->spline = parse_spline(parser);
    function->parameters.resize(1);
  } else if (parser.accept(K::internal_)) {
    function->kind = FunctionKind::internal;
    parser.expect('(', "internal");
    function->internal = parse_int(parser, "internal");
    parser.expect(')', "internal");
  } else {
    FunctionParser(parser, *function).choice();
  }
  parser.expect('}', "a function");
  parser.claim(sizeof(Function));
  function->measure.count = std::max<std::size_t>(function->nodes.size(), 1);
  for (const auto& called : function->functions) parser.contain(function->measure, called->measure);
  if (function->pigment) parser.contain(function->measure, function->pigment->measure);
  if (function->pattern) parser.contain(function->measure, function->pattern->measure);
  return function;
}

Number call_function(Parser& parser, const std::shared_ptr<const Function>& function) {
  const Nesting nesting(parser);
  parser.expect('(', "a function's call");
  std::vector<double> arguments;
  while (!parser.accept(')')) {
    arguments.push_back(parse_condition(parser));
    parser.accept(',');
  }
  // Built-in functions take a point and numbers of their own.
  if (function->kind != FunctionKind::internal && arguments.size() != function->parameters.size()) {
    parser.fail("the function takes " + std::to_string(function->parameters.size()) +
                " arguments, but " + std::to_string(arguments.size()) + " are given");
  }
  const std::uint64_t steps = parser.steps_left();
  std::uint64_t left = steps;
  const auto result = evaluate(*function, arguments, left);
  parser.count_steps(left == 0 ? steps + 1 : steps - left);
  if (!result) {
    parser.fail(
        "the value of a pigment, pattern or built-in function is not known while a scene is read",
        "replace it by numbers");
  }
  return *result;
}

}  // namespace lumivec::pov
