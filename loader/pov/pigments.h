// Pigments: colors in space.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// After the word "pigment": { ... }.
Pigment parse_pigment_block(Parser& parser);
// The same between given brackets: items of one pigment up to what cannot be one.
void parse_pigment_items(Parser& parser, Pigment& pigment);

using PigmentMap = std::vector<std::pair<double, std::shared_ptr<const Pigment>>>;

// After the word "pigment_map".
PigmentMap parse_pigment_map(Parser& parser);

}  // namespace lumivec::pov
