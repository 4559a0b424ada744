// Escape sequences of strings: \n, \", \\, \u00e9 and the like.
#pragma once

#include <string>
#include <string_view>

namespace lumivec::pov {

// text: what stands between the quotes. A backslash before any other character stays, as file
// names of DOS need it.
std::string replace_escapes(std::string_view text);

// The character as UTF-8.
std::string utf8(unsigned code);

}  // namespace lumivec::pov
