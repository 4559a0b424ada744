// The values of options, from text. Each function takes the option's name for its message and
// throws UsageError, "OPTION: what is wrong; what to do".
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "integrator/settings.h"

namespace lumivec {

struct PictureSize {
  int width = 0;   // pixels, [1, max_picture_side]
  int height = 0;  // pixels, [1, max_picture_side]
};

// A finite number in [least, most].
double parse_number(const std::string& option, const std::string& text, double least, double most);
// The same without least itself.
double parse_number_above(const std::string& option, const std::string& text, double least,
                          double most);
// A whole number in [least, most], digits alone.
std::uint64_t parse_whole(const std::string& option, const std::string& text, std::uint64_t least,
                          std::uint64_t most);

// "WxH", or "N" for N×N.
PictureSize parse_size(const std::string& option, const std::string& text);

// "box", "tent", "gaussian", "blackman-harris".
PixelFilter parse_filter(const std::string& option, const std::string& text);
std::string filter_name(PixelFilter filter);

// A comma list of the five names, each at most once; bits as RenderSettings::terms.
std::uint32_t parse_terms(const std::string& option, const std::string& text);
std::string terms_text(std::uint32_t terms);

// One of the words in known.
std::string parse_word(const std::string& option, const std::string& text,
                       const std::vector<std::string>& known);

// "A=B", neither empty.
std::pair<std::string, std::string> parse_pair(const std::string& option, const std::string& text);

// The item that text names or, if none has that name, counts from 0. what: "camera". Names may be
// empty.
int find_by_name_or_index(const std::string& option, const std::string& text,
                          const std::vector<std::string>& names, const std::string& what);

}  // namespace lumivec
