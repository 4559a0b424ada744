// Operations on floats, vectors and colors, and how operands of different sizes meet.
#pragma once

#include "loader/pov/value.h"

namespace lumivec::pov {

// Both become as long as the longer one.
inline void promote(Number& a, Number& b) {
  const auto widen = [](Number& from, std::uint8_t size) {
    if (from.size == 1) {
      for (std::uint8_t i = 1; i < size; ++i) from.n[i] = from.n[0];
    }
    from.size = size;
  };
  if (a.size < b.size) widen(a, b.size);
  if (b.size < a.size) widen(b, a.size);
  a.color = b.color = a.color || b.color;
}

// a becomes the result.
template <class Operation>
void combine(Number& a, Number& b, Operation operation) {
  if (a.size != b.size) promote(a, b);
  for (std::uint8_t i = 0; i < a.size; ++i) a.n[i] = operation(a.n[i], b.n[i]);
  a.color = a.color || b.color;
}

}  // namespace lumivec::pov
