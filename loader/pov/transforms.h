// translate, rotate, scale, matrix and transform.
#pragma once

#include <optional>

#include "loader/pov/parser.h"

namespace lumivec::pov {

// A transform, if one stands here.
std::optional<M44d> parse_transform(Parser& parser);
// After the word "transform" where a block is expected.
M44d parse_transform_block(Parser& parser);

}  // namespace lumivec::pov
