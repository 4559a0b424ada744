#include "loader/pov/pigments.h"

#include "loader/pov/blend_maps.h"
#include "loader/pov/colors.h"
#include "loader/pov/expression.h"
#include "loader/pov/image_maps.h"
#include "loader/pov/patterns.h"

namespace lumivec::pov {
namespace {

bool is_list_pattern(K kind) {
  return kind == K::checker_ || kind == K::brick_ || kind == K::hexagon_ || kind == K::object_;
}

// The colors or pigments that checker and its kind choose from.
void parse_list(Parser& parser, Pigment& pigment) {
  pigment.colors.clear();
  pigment.pigments.clear();
  for (;;) {
    skip_comma(parser);
    if (parser.accept(K::pigment_)) {
      pigment.pigments.push_back(std::make_shared<const Pigment>(parse_pigment_block(parser)));
    } else if (pigment.pigments.empty() && begins_color(parser)) {
      pigment.colors.push_back(parse_color(parser));
    } else {
      return;
    }
  }
}

bool parse_item(Parser& parser, Pigment& pigment) {
  if (const Slot* slot = parser.meaning(parser.peek());
      slot && (*slot)->kind == ValueKind::pigment) {
    pigment = (*slot)->as<Pigment>();
    parser.claim(pigment.color_map.size() * sizeof(pigment.color_map[0]));
    parser.take();
    return true;
  }
  if (const Slot* slot = parser.meaning(parser.peek());
      slot && (*slot)->kind == ValueKind::color_map) {
    pigment.color_map = (*slot)->as<ColorMap>();
    pigment.pigment_map.clear();
    parser.take();
    return true;
  }
  pigment.black = false;
  if (parse_pattern_kind(parser, pigment.pattern)) {
    pigment.image = nullptr;
    if (is_list_pattern(pigment.pattern.kind)) parse_list(parser, pigment);
    return true;
  }
  if (parser.accept(K::color_map_) || parser.accept(K::density_map_)) {
    pigment.color_map = parse_color_map(parser, ValueKind::color_map);
    pigment.pigment_map.clear();
    return true;
  }
  if (parser.accept(K::pigment_map_)) {
    pigment.pigment_map = parse_pigment_map(parser);
    return true;
  }
  if (parser.accept(K::image_map_)) {
    pigment.image = parse_image_map(parser);
    return true;
  }
  if (parser.accept(K::quick_color_)) {
    parse_color(parser);
    return true;
  }
  if (parser.accept(K::uv_mapping_)) {
    pigment.uv_mapping = parse_switch(parser);
    return true;
  }
  if (parse_pattern_modifier(parser, pigment.pattern)) return true;
  if (!begins_color(parser)) return false;
  pigment.color = parse_color(parser);
  pigment.pattern.kind = K::keyword_count;
  pigment.image = nullptr;
  return true;
}

}  // namespace

ColorMap parse_color_map(Parser& parser, ValueKind kind) {
  const Nesting nesting(parser);
  ColorMap map;
  const auto declared = [&] {
    const Slot* slot = parser.meaning(parser.peek());
    if (!slot || (*slot)->kind != kind) return false;
    map = (*slot)->as<ColorMap>();
    parser.take();
    return true;
  };
  if (declared()) return map;
  parser.expect('{', "a color map");
  while (!parser.accept('}')) {
    if (declared()) continue;
    parser.expect('[', "a color map's entry");
    const double first = parse_float(parser, "a color map's entry");
    skip_comma(parser);
    const Token next = parser.peek();
    const Slot* slot = parser.meaning(next);
    const bool second_value =
        next.kind == TokenKind::number || next.is('(') || next.is('-') ||
        (slot && (*slot)->kind == ValueKind::number && (*slot)->number.size == 1);
    if (second_value) {
      const double second = parse_float(parser, "a color map's entry");
      skip_comma(parser);
      map.emplace_back(first, parse_color(parser));
      skip_comma(parser);
      map.emplace_back(second, parse_color(parser));
    } else {
      map.emplace_back(first, parse_color(parser));
    }
    parser.claim(sizeof(map[0]));
    parser.expect(']', "a color map's entry");
    skip_comma(parser);
  }
  std::stable_sort(map.begin(), map.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  return map;
}

PigmentMap parse_pigment_map(Parser& parser) {
  return parse_map<std::shared_ptr<const Pigment>>(parser, ValueKind::pigment_map, [&] {
    parser.claim(sizeof(Pigment));
    auto entry = std::make_shared<Pigment>();
    parse_pigment_items(parser, *entry);
    return entry;
  });
}

void parse_pigment_items(Parser& parser, Pigment& pigment) {
  const Nesting nesting(parser);
  while (!parser.at('}') && !parser.at(']')) {
    if (!parse_item(parser, pigment) && !parser.accept(','))
      parser.fail_expected("a color, pattern or other part of a pigment");
  }
  parser.claim(sizeof(Pigment));
  pigment.measure = {};
  parser.contain(pigment.measure, pigment.pattern.measure, most_pigments);
  for (const auto& [value, part] : pigment.pigment_map)
    parser.contain(pigment.measure, part->measure, most_pigments);
  for (const auto& part : pigment.pigments)
    parser.contain(pigment.measure, part->measure, most_pigments);
}

Pigment parse_pigment_block(Parser& parser) {
  Pigment pigment;
  parser.expect('{', "a pigment");
  parse_pigment_items(parser, pigment);
  parser.expect('}', "a pigment");
  return pigment;
}

}  // namespace lumivec::pov
