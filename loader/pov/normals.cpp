#include "loader/pov/normals.h"

#include "loader/pov/blend_maps.h"
#include "loader/pov/expression.h"
#include "loader/pov/patterns.h"

namespace lumivec::pov {
namespace {

using SlopeMap = std::array<double, 2>;

bool parse_item(Parser& parser, Normal& normal) {
  if (const Slot* slot = parser.meaning(parser.peek());
      slot && (*slot)->kind == ValueKind::normal) {
    normal = (*slot)->as<Normal>();
    parser.take();
    return true;
  }
  if (parse_pattern_kind(parser, normal.pattern)) {
    skip_comma(parser);
    if (begins_number(parser)) normal.amount = parse_float(parser, "a normal");
    while (parser.accept(K::normal_)) {
      normal.normals.push_back(std::make_shared<const Normal>(parse_normal_block(parser)));
      skip_comma(parser);
    }
    return true;
  }
  if (parser.accept(K::normal_map_)) {
    normal.normal_map = parse_normal_map(parser);
    return true;
  }
  if (parser.accept(K::slope_map_)) {
    normal.slope_map =
        parse_map<SlopeMap>(parser, ValueKind::slope_map, [&] { return parse_pair(parser); });
    return true;
  }
  if (parser.accept(K::bump_map_)) {
    normal.image = parse_image_block(parser, &normal.bump_size);
    return true;
  }
  if (parser.accept(K::bump_size_)) {
    normal.amount = normal.bump_size = parse_float(parser, "bump_size");
    return true;
  }
  if (parser.accept(K::accuracy_)) {
    normal.accuracy = parse_float(parser, "accuracy");
    return true;
  }
  if (parser.accept(K::no_bump_scale_)) {
    normal.no_bump_scale = parse_switch(parser);
    return true;
  }
  if (parser.accept(K::uv_mapping_)) {
    normal.uv_mapping = parse_switch(parser);
    return true;
  }
  return parse_pattern_modifier(parser, normal.pattern);
}

}  // namespace

NormalMap parse_normal_map(Parser& parser) {
  return parse_map<std::shared_ptr<const Normal>>(parser, ValueKind::normal_map, [&] {
    parser.claim(sizeof(Normal));
    auto entry = std::make_shared<Normal>();
    parse_normal_items(parser, *entry);
    return entry;
  });
}

void parse_normal_items(Parser& parser, Normal& normal) {
  const Nesting nesting(parser);
  while (!parser.at('}') && !parser.at(']')) {
    if (!parse_item(parser, normal) && !parser.accept(','))
      parser.fail_expected("a pattern or other part of a normal");
  }
  parser.claim(sizeof(Normal));
  normal.measure = {};
  parser.contain(normal.measure, normal.pattern.measure);
  for (const auto& [value, part] : normal.normal_map) parser.contain(normal.measure, part->measure);
  for (const auto& part : normal.normals) parser.contain(normal.measure, part->measure);
}

Normal parse_normal_block(Parser& parser) {
  Normal normal;
  parser.expect('{', "a normal");
  parse_normal_items(parser, normal);
  parser.expect('}', "a normal");
  return normal;
}

}  // namespace lumivec::pov
