#include "loader/pov/light_sources.h"

#include "loader/pov/bounds.h"
#include "loader/pov/colors.h"
#include "loader/pov/expression.h"
#include "loader/pov/object_modifiers.h"
#include "loader/pov/transforms.h"

namespace lumivec::pov {
namespace {

AreaLight parse_area(Parser& parser) {
  AreaLight area;
  area.axis1 = parse_vector(parser);
  skip_comma(parser);
  area.axis2 = parse_vector(parser);
  skip_comma(parser);
  area.count1 = parse_int(parser, "area_light");
  skip_comma(parser);
  area.count2 = parse_int(parser, "area_light");
  return area;
}

ObjectPtr parse_block_object(Parser& parser, std::string_view construct) {
  parser.expect('{', construct);
  ObjectPtr object = parse_object_reference(parser);
  auto changed = std::make_shared<Object>(*object);
  parse_object_modifiers(parser, *changed);
  measure_object(parser, *changed);
  return changed;
}

bool parse_number_item(Parser& parser, LightSource& light) {
  const std::pair<K, double LightSource::*> numbers[] = {
      {K::radius_, &LightSource::radius},         {K::falloff_, &LightSource::falloff},
      {K::tightness_, &LightSource::tightness},   {K::fade_distance_, &LightSource::fade_distance},
      {K::fade_power_, &LightSource::fade_power},
  };
  for (const auto& [word, number] : numbers) {
    if (!parser.accept(word)) continue;
    light.*number = parse_float(parser, keyword_text(word));
    return true;
  }
  return false;
}

bool parse_shape_item(Parser& parser, LightSource& light) {
  if (parser.accept(K::spotlight_)) {
    light.shape = LightShape::spotlight;
  } else if (parser.accept(K::cylinder_)) {
    light.shape = LightShape::cylinder;
    light.radius = 0.75;  // scene units, as the language has it
    light.falloff = 1.0;
  } else if (parser.accept(K::parallel_)) {
    light.parallel = true;
  } else if (parser.accept(K::point_at_)) {
    light.point_at = parse_vector(parser);
  } else if (parser.accept(K::area_light_)) {
    light.area = parse_area(parser);
  } else if (parser.accept(K::circular_)) {
    if (light.area) light.area->circular = true;
  } else if (parser.accept(K::orient_)) {
    if (light.area) light.area->orient = true;
  } else if (parser.accept(K::adaptive_)) {
    parse_float(parser, "adaptive");
  } else if (parser.accept(K::area_illumination_)) {
    parse_switch(parser);
  } else {
    return parser.accept(K::jitter_);
  }
  return true;
}

bool parse_item(Parser& parser, LightSource& light, Object& object) {
  if (parse_shape_item(parser, light) || parse_number_item(parser, light)) return true;
  if (parser.accept(K::shadowless_)) {
    light.shadowless = true;
  } else if (parser.accept(K::looks_like_)) {
    light.looks_like = parse_block_object(parser, "looks_like");
  } else if (parser.accept(K::projected_through_)) {
    light.projected_through = parse_block_object(parser, "projected_through");
  } else if (parser.accept(K::media_interaction_) || parser.accept(K::media_attenuation_)) {
    parse_switch(parser);
  } else if (begins_color_word(parser.peek().keyword())) {
    light.color = parse_color(parser);
  } else {
    return parse_object_modifier(parser, object);
  }
  return true;
}

}  // namespace

ObjectPtr parse_light_source(Parser& parser, const Place& place) {
  auto object = std::make_shared<Object>();
  auto light = std::make_shared<LightSource>();
  object->place = place;
  parser.claim(sizeof(Object) + sizeof(LightSource));
  parser.expect('{', "light_source");
  const Slot* slot = parser.meaning(parser.peek());
  const auto* held =
      slot && (*slot)->kind == ValueKind::object
          ? std::get_if<std::shared_ptr<const LightSource>>(&(*slot)->as<Object>().shape)
          : nullptr;
  if (held) {
    *light = **held;
    *object = (*slot)->as<Object>();
    object->place = place;
    parser.take();
  } else {
    light->location = parse_vector(parser);
    skip_comma(parser);
    light->color = parse_color(parser);
  }
  while (!parser.accept('}')) {
    if (!parse_item(parser, *light, *object) && !parser.accept(','))
      parser.fail_expected("a part of a light source");
  }
  object->shape = std::shared_ptr<const LightSource>(std::move(light));
  measure_object(parser, *object);
  return object;
}

// What lights of a group light only the group cannot be kept; the objects and lights are.
ObjectPtr parse_light_group(Parser& parser, const Place& place) {
  auto object = std::make_shared<Object>();
  auto group = std::make_shared<CombinedShape>();
  object->place = place;
  parser.mention(place, "the lights of a light group light everything");
  parser.expect('{', "light_group");
  for (;;) {
    if (parser.accept(K::global_lights_)) {
      parse_switch(parser);
      continue;
    }
    ObjectPtr part = parse_object(parser);
    if (!part) break;
    group->parts.push_back(std::move(part));
    parser.claim(sizeof(ObjectPtr));
  }
  group->bounds = bounds_of_parts(*group);
  object->shape = std::shared_ptr<const CombinedShape>(std::move(group));
  while (!parser.accept('}')) {
    if (parser.accept(K::global_lights_)) {
      parse_switch(parser);
    } else if (!parse_object_modifier(parser, *object)) {
      parser.fail_expected("'}' of a light group");
    }
  }
  measure_object(parser, *object);
  return object;
}

}  // namespace lumivec::pov
