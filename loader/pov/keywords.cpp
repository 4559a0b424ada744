#include "loader/pov/keywords.h"

#include <algorithm>
#include <array>
#include <utility>

namespace lumivec::pov {
namespace {

constexpr std::array keyword_texts = {
#define LUMIVEC_POV_TEXT(word) std::string_view(#word),
    LUMIVEC_POV_KEYWORDS(LUMIVEC_POV_TEXT)
#undef LUMIVEC_POV_TEXT
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 6> spellings = {{
    {"colour", "color"},
    {"colour_map", "color_map"},
    {"fade_colour", "fade_color"},
    {"grey", "gray"},
    {"quick_colour", "quick_color"},
    {"use_colour", "use_color"},
}};

}  // namespace

std::string_view keyword_text(K keyword) {
  return keyword_texts[static_cast<std::size_t>(keyword)];
}

std::optional<std::size_t> component_of(K word) {
  switch (word) {
    case K::x_:
    case K::u_:
    case K::red_:
      return 0;
    case K::y_:
    case K::v_:
    case K::green_:
      return 1;
    case K::z_:
    case K::blue_:
      return 2;
    case K::t_:
    case K::filter_:
      return 3;
    case K::transmit_:
      return 4;
    default:
      return std::nullopt;
  }
}

std::string_view usual_spelling(std::string_view word) {
  const auto known = std::find_if(spellings.begin(), spellings.end(),
                                  [&](const auto& s) { return s.first == word; });
  return known == spellings.end() ? word : known->second;
}

}  // namespace lumivec::pov
