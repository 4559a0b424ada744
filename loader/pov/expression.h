// Floats, vectors and colors: the expressions of the scene language.
//
// A float meets a vector as a vector of equal components; the shorter of two vectors is filled up
// with zeros. Comparisons and the like stand in parentheses, as the language wants it.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// One operand, with its sign left to the caller: 3, V.x, sin (A), (A + B).
Number parse_number_operand(Parser& parser);
// The same as parse_number, where the first operand, a number, function or spline, was taken
// before.
Number parse_number_from(Parser& parser, const Value& first);
// A sum of products. Ends before the first token that cannot continue it.
Number parse_number(Parser& parser);
// The same with comparisons, & and |, and the choice A ? B : C.
Number parse_full_number(Parser& parser);
// The first component of the latter.
double parse_condition(Parser& parser);

// construct: what needs the number, for errors.
double parse_float(Parser& parser, std::string_view construct);
int parse_int(Parser& parser, std::string_view construct);
V3d parse_vector(Parser& parser);  // a float fills all components
std::array<double, 2> parse_pair(Parser& parser);
// on, off, a number; nothing of these: true, as a modifier alone means.
bool parse_switch(Parser& parser);

V3d to_vector(const Number& number);
Number to_number(const V3d& vector);

// Could an expression begin here?
bool begins_number(Parser& parser);

// After "defined (" and the like: an identifier, or an element of an array.
bool parse_defined(Parser& parser);

// A comma, if there is one: the language lets most be left out.
inline void skip_comma(Parser& parser) {
  parser.accept(',');
}

}  // namespace lumivec::pov
