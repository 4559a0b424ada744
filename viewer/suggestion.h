// "did you mean …?": the nearest known word to a misspelled one.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lumivec {

// Damerau-Levenshtein distance in its restricted form (optimal string alignment): the least number
// of insertions, deletions, substitutions and swaps of neighbours, no part edited twice. O(|a|·|b|)
// time.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The candidate nearest to word, ignoring case, if it is near enough to be what was meant: at most
// one edit per three letters, or word is its beginning (at least three letters). The first of
// several equally near ones.
std::optional<std::string> closest(std::string_view word,
                                   const std::vector<std::string>& candidates);

// The end of an error line: "did you mean 'x'?", else "known are a, b, c" (the first twelve).
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace lumivec
