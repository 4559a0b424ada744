// Interiors: refraction, absorption and media.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// After the words "interior" and "media": { ... }.
std::shared_ptr<const Interior> parse_interior_block(Parser& parser);
Media parse_media_block(Parser& parser);

}  // namespace lumivec::pov
