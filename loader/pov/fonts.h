// Outlines of letters, by FreeType: what a text is made of.
#pragma once

#include <string>
#include <string_view>

#include "loader/pov/parser.h"

namespace lumivec::pov {

// The font's name as the scene has it, looked up from the source that names it, as includes are.
struct FontName {
  std::string file;
  std::uint32_t named_in = 0;
  Place place;
};

// The glyphs of a text one after another from the origin along x, an em being 1; offset is added
// from each to the next. The text is UTF-8, or else Latin-1. thickness, which stays as it is, and
// bounds are along z too. Fails with one line where there is no such font, or it is none; the
// four that come with POV-Ray are a warning where it is not installed.
TextShape text_of(Parser& parser, const FontName& font, std::string_view text, double thickness,
                  const V3d& offset);

}  // namespace lumivec::pov
