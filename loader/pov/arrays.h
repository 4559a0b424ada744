// Arrays of one to five dimensions.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

// After the word "array": sizes, and values in braces.
Value parse_array(Parser& parser);

// [i][j]... of an array, as an index of its elements. Fails where it is out of range, or where what
// stands in the brackets makes the array another one.
std::size_t parse_array_index(Parser& parser, const Slot& array);
// The element that [i][j]... names; fails if it was never set. An array is copied.
Value parse_array_element(Parser& parser, const Slot& array);
// The same as a place that can be changed.
Slot array_element_slot(Parser& parser, const Slot& array);
// Elements of an array share one kind.
void set_array_element(Parser& parser, Value& array, std::size_t index, Value value);

// Are the elements of this kind? An array of arrays holds what they hold.
bool array_holds(const Value& array, ValueKind kind);

// After "dimensions (" and "dimension_size (": the array.
std::shared_ptr<const Array> parse_array_name(Parser& parser);

}  // namespace lumivec::pov
