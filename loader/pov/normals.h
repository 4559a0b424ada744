// Normals: bumps that are only seen in the shading.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// After the word "normal": { ... }.
Normal parse_normal_block(Parser& parser);
void parse_normal_items(Parser& parser, Normal& normal);

using NormalMap = std::vector<std::pair<double, std::shared_ptr<const Normal>>>;

// After the word "normal_map".
NormalMap parse_normal_map(Parser& parser);

}  // namespace lumivec::pov
