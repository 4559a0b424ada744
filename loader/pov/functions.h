// Functions of the scene: function (a, b) { a * sin (b) }, of pigments, patterns, splines and
// transforms.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "loader/pov/parser.h"
#include "loader/pov/splines.h"

namespace lumivec::pov {

enum class Operation : std::uint8_t {
  constant,   // value
  parameter,  // index
  add,
  subtract,
  multiply,
  divide,
  negate,
  invert,  // !
  less,
  less_or_equal,
  equal,
  unequal,
  both,
  either,
  choose,  // select: a, negative, zero, positive
  minimum,
  maximum,
  built_in,  // of float_function (keyword)
  call,      // functions[index], with arguments; component says which number of the result
  sum,       // of the third operand, with parameter `index` from the first to the second
  product
};

struct FunctionNode {
  Operation operation = Operation::constant;
  double value = 0.0;
  K keyword = K::keyword_count;
  std::uint32_t index = 0;
  int component = 0;
  std::vector<std::uint32_t> operands;  // indices into Function::nodes
};

enum class FunctionKind : std::uint8_t {
  expression,
  internal,
  pigment,
  pattern,
  spline,
  transform
};

struct Function {
  FunctionKind kind = FunctionKind::expression;
  std::vector<Word> parameters;
  std::vector<FunctionNode> nodes;  // operands come before their operators; the last is the result
  std::vector<std::shared_ptr<const Function>> functions;  // that it calls
  int internal = 0;                                        // the number of a built-in one
  std::shared_ptr<const Pigment> pigment;
  std::shared_ptr<const Pattern> pattern;
  std::shared_ptr<const Spline> spline;
  M44d transform;
  Measure measure;  // of its nodes, and of the functions that it calls
};

// What a component of a function's result may be besides the number of one.
constexpr int gray_component = -1;

// After the word "function".
std::shared_ptr<const Function> parse_function(Parser& parser);

// After a function's name: arguments in parentheses, and what the function makes of them.
Number call_function(Parser& parser, const std::shared_ptr<const Function>& function);

// Empty if the function, or one that it calls, can only be evaluated by rendering, or takes more
// nodes than are left, which are counted down. One number, or of pigments, splines and transforms
// several.
std::optional<Number> evaluate(const Function& function, std::span<const double> arguments,
                               std::uint64_t& nodes_left);

// Of functions that surfaces and patterns are made of.
constexpr std::uint64_t most_nodes_a_point = 20'000;

// The built-in functions that the language numbers, as far as they are simple surfaces.
std::optional<Number> internal_function(int number, std::span<const double> arguments);

}  // namespace lumivec::pov
