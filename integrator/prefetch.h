// Memory that is asked for before it is needed.
#pragma once

#include <cstddef>

namespace lumivec {

constexpr std::size_t cache_line = 64;

// All lines that an object is in.
template <typename T>
inline void prefetch(const T& object) {
  const char* bytes = reinterpret_cast<const char*>(&object);
  for (std::size_t i = 0; i < sizeof(T); i += cache_line) __builtin_prefetch(bytes + i);
  if constexpr (alignof(T) < cache_line && sizeof(T) > 1) __builtin_prefetch(bytes + sizeof(T) - 1);
}

}  // namespace lumivec
