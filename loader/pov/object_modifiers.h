// What stands in an object after its shape.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// Modifiers up to the closing brace, which is taken.
void parse_object_modifiers(Parser& parser, Object& object);

// One of them, if it stands here.
bool parse_object_modifier(Parser& parser, Object& object);

// Moves the object with its texture.
void transform_object(Object& object, const M44d& transform);

// Sets Object::measure from what the object holds. Called whenever it is complete.
void measure_object(Parser& parser, Object& object);

}  // namespace lumivec::pov
