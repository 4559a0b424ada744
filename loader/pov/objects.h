// Objects: primitives, combinations, and what modifies them.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

using ObjectPtr = std::shared_ptr<const Object>;

// Does an object begin with this word?
bool begins_object(K keyword);

// The object that stands here, with its modifiers, if one does; null otherwise.
ObjectPtr parse_object(Parser& parser);
// The same where nothing else can stand. construct: what needs it.
ObjectPtr parse_object_in(Parser& parser, std::string_view construct);
// An object, or the name of one without "object { }" around it.
ObjectPtr parse_object_reference(Parser& parser);

}  // namespace lumivec::pov
