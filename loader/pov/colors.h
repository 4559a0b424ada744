// Colors: color red 1, rgb <1, 0.5, 0>, White * 0.8 filter 0.5.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// Is it a word that only colors begin with?
bool begins_color_word(K keyword);
// Could a color begin here, as a word of color or a number?
bool begins_color(Parser& parser);

ColorFT parse_color(Parser& parser);
Number parse_color_number(Parser& parser);  // the same with five components

ColorFT to_color(const Number& number);  // a float makes a grey
std::array<double, 3> parse_rgb(Parser& parser);

}  // namespace lumivec::pov
