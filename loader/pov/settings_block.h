// Blocks of words with numbers, of which a scene description keeps the numbers only.
#pragma once

#include <utility>
#include <vector>

#include "loader/pov/parser.h"

namespace lumivec::pov {

using Settings = std::vector<std::pair<K, double>>;

// { WORD NUMBER WORD NUMBER, NUMBER ... }: each number with the word before it; words alone count
// 1; of vectors and colors the first component. Fails at anything else, but reads over strings.
Settings parse_settings_block(Parser& parser, std::string_view construct);

// The last number that a word has, or otherwise.
double setting(const Settings& settings, K word, double otherwise);

}  // namespace lumivec::pov
