// The OpenColorIO configuration that the program carries: ACES 1.0 and un-tone-mapped views on
// sRGB, Display P3 and Rec. 1886 displays, made of OpenColorIO 2.1's built-in transforms alone,
// without a table file.
#pragma once

#include <string_view>

namespace lumivec {

std::string_view builtin_config();  // in OpenColorIO's YAML

}  // namespace lumivec
