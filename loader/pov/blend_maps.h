// Maps from the value of a pattern to colors, pigments, normals and the like:
// { [0.0 A] [0.5 B] }, or the name of a declared one in braces.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "loader/pov/colors.h"
#include "loader/pov/expression.h"
#include "loader/pov/parser.h"

namespace lumivec::pov {

// read_entry (): what stands behind the value, up to ']'. kind: of a declared map.
template <class T, class Read>
std::vector<std::pair<double, T>> parse_map(Parser& parser, ValueKind kind, Read read_entry) {
  using Map = std::vector<std::pair<double, T>>;
  const Nesting nesting(parser);
  Map map;
  if (const Slot* slot = parser.meaning(parser.peek()); slot && (*slot)->kind == kind) {
    map = (*slot)->as<Map>();
    parser.claim(map.size() * sizeof(map[0]));
    parser.take();
    return map;
  }
  parser.expect('{', "a map");
  while (!parser.accept('}')) {
    if (const Slot* slot = parser.meaning(parser.peek()); slot && (*slot)->kind == kind) {
      map = (*slot)->as<Map>();
      parser.take();
      continue;
    }
    parser.expect('[', "a map's entry");
    const double value = parse_float(parser, "a map's entry");
    skip_comma(parser);
    parser.claim(sizeof(T));
    map.emplace_back(value, read_entry());
    parser.expect(']', "a map's entry");
    skip_comma(parser);
  }
  std::stable_sort(map.begin(), map.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return map;
}

// Also of the old form [0.0, 0.5 color A color B].
ColorMap parse_color_map(Parser& parser, ValueKind kind);

}  // namespace lumivec::pov
