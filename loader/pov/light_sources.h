// Lamps, as objects.
#pragma once

#include "loader/pov/objects.h"

namespace lumivec::pov {

// After the words "light_source" and "light_group".
ObjectPtr parse_light_source(Parser& parser, const Place& place);
ObjectPtr parse_light_group(Parser& parser, const Place& place);

}  // namespace lumivec::pov
