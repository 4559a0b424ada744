// Patterns and what modifies them: turbulence, warps, waves, transforms.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// The pattern whose keyword stands here, with the numbers of its kind; false: there is none.
bool parse_pattern_kind(Parser& parser, Pattern& pattern);

// One modifier of a pattern, if it stands here: turbulence, warp, frequency, ramp_wave, translate.
bool parse_pattern_modifier(Parser& parser, Pattern& pattern);

// After the word "pattern": { KIND MODIFIERS }.
std::shared_ptr<const Pattern> parse_pattern_block(Parser& parser);

// After image_map, bump_map, image_pattern, height_field: format and file.
ImageUse parse_image_file(Parser& parser);
// In braces, with map_type and the like. bump_size: where one may stand among them, or null.
std::shared_ptr<const ImageUse> parse_image_block(Parser& parser, double* bump_size = nullptr);

}  // namespace lumivec::pov
