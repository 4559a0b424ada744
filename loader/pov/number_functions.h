// The functions and constants of the language that give floats and vectors: sin, vrotate, pi,
// clock.
#pragma once

#include <optional>

#include "loader/pov/parser.h"

namespace lumivec::pov {

// Is it the word of a function or constant?
bool begins_function_word(K keyword);

// The value of the function or constant at hand, with what it is called with.
Number parse_function_word(Parser& parser);

// Functions of one to three floats, which functions of the scene may use too. count: of parameters.
struct FloatFunction {
  int count = 1;
  double (*value)(const double* x) = nullptr;
  // What x must not be; null: anything goes.
  bool (*undefined)(const double* x) = nullptr;
};
const FloatFunction* float_function(K keyword);
std::optional<double> float_constant(const Parser& parser, K keyword);

}  // namespace lumivec::pov
