// Strings and the functions that give them.
#pragma once

#include <string>
#include <string_view>

#include "loader/pov/parser.h"

namespace lumivec::pov {

// construct: what needs the string, for errors.
std::string parse_string(Parser& parser, std::string_view construct);
// The same of a file: backslashes separate folders, and escape nothing.
std::string parse_file_name(Parser& parser, std::string_view construct);
bool begins_string(Parser& parser);

// A message of a scene with its line ends made spaces, cut to a readable length.
std::string one_line(std::string text);

}  // namespace lumivec::pov
