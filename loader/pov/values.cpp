#include "loader/pov/values.h"

#include "loader/pov/arrays.h"
#include "loader/pov/blend_maps.h"
#include "loader/pov/cameras.h"
#include "loader/pov/colors.h"
#include "loader/pov/expression.h"
#include "loader/pov/finishes.h"
#include "loader/pov/functions.h"
#include "loader/pov/interiors.h"
#include "loader/pov/normals.h"
#include "loader/pov/objects.h"
#include "loader/pov/pigments.h"
#include "loader/pov/settings_block.h"
#include "loader/pov/sky_spheres.h"
#include "loader/pov/splines.h"
#include "loader/pov/strings.h"
#include "loader/pov/textures.h"
#include "loader/pov/transforms.h"

namespace lumivec::pov {
namespace {

template <class T>
Value held(Parser& parser, ValueKind kind, T thing) {
  parser.claim(sizeof(T));
  return {kind, std::make_shared<const T>(std::move(thing))};
}

Finish default_finish(const Parser& parser) {
  const TexturePtr& texture = parser.scene.default_texture;
  return texture && !texture->layers.empty() ? texture->layers.back().finish : Finish();
}

// Layers in a row are one texture.
Value parse_layers(Parser& parser) {
  TexturePtr texture = parse_texture_block(parser);
  while (parser.next_is_word(K::texture_)) {
    parser.take();
    texture = layered(parser, texture, parse_texture_block(parser));
  }
  return {ValueKind::texture, texture};
}

Value parse_map_value(Parser& parser, K keyword) {
  switch (keyword) {
    case K::color_map_:
      return held(parser, ValueKind::color_map, parse_color_map(parser, ValueKind::color_map));
    case K::density_map_:
      return held(parser, ValueKind::color_map, parse_color_map(parser, ValueKind::color_map));
    case K::pigment_map_:
      return held(parser, ValueKind::pigment_map, parse_pigment_map(parser));
    case K::normal_map_:
      return held(parser, ValueKind::normal_map, parse_normal_map(parser));
    case K::slope_map_:
      return held(parser, ValueKind::slope_map,
                  parse_map<std::array<double, 2>>(parser, ValueKind::slope_map,
                                                   [&] { return parse_pair(parser); }));
    default:
      return held(parser, ValueKind::texture_map, parse_texture_map(parser));
  }
}

// Something in braces behind a keyword that is no object; none: not one of these.
std::optional<Value> parse_block_value(Parser& parser, K keyword) {
  switch (keyword) {
    case K::texture_:
      parser.take();
      return parse_layers(parser);
    case K::pigment_:
    case K::density_:
      parser.take();
      return held(parser, ValueKind::pigment, parse_pigment_block(parser));
    case K::normal_:
      parser.take();
      return held(parser, ValueKind::normal, parse_normal_block(parser));
    case K::finish_: {
      parser.take();
      Finish finish = default_finish(parser);
      parse_finish_block(parser, finish);
      return held(parser, ValueKind::finish, finish);
    }
    case K::interior_:
      parser.take();
      return Value(ValueKind::interior, parse_interior_block(parser));
    case K::media_:
      parser.take();
      return held(parser, ValueKind::media, parse_media_block(parser));
    case K::material_:
      parser.take();
      return held(parser, ValueKind::material, parse_material_block(parser));
    case K::camera_:
      parser.take();
      return held(parser, ValueKind::camera, parse_camera_block(parser));
    case K::sky_sphere_:
      parser.take();
      return held(parser, ValueKind::sky_sphere, parse_sky_sphere_block(parser));
    case K::fog_:
    case K::rainbow_:
      parser.take();
      return held(parser, keyword == K::fog_ ? ValueKind::fog : ValueKind::rainbow,
                  parse_settings_block(parser, keyword_text(keyword)));
    case K::transform_:
      parser.take();
      return held(parser, ValueKind::transform, parse_transform_block(parser));
    case K::translate_:
    case K::rotate_:
    case K::scale_:
    case K::matrix_:
      return held(parser, ValueKind::transform, *parse_transform(parser));
    case K::color_map_:
    case K::pigment_map_:
    case K::normal_map_:
    case K::slope_map_:
    case K::texture_map_:
    case K::density_map_:
      parser.take();
      return parse_map_value(parser, keyword);
    case K::array_:
      parser.take();
      return parse_array(parser);
    case K::spline_:
      parser.take();
      return Value(ValueKind::spline, parse_spline(parser));
    case K::function_:
      parser.take();
      return Value(ValueKind::function, parse_function(parser));
    default:
      return std::nullopt;
  }
}

// The value of an identifier that is no number, alone; none: it begins a number or a string.
std::optional<Value> parse_declared(Parser& parser) {
  const Slot* slot = parser.meaning(parser.peek());
  if (!slot) return std::nullopt;
  const Slot found = *slot;
  switch (found->kind) {
    case ValueKind::none:
    case ValueKind::number:
    case ValueKind::string:
    case ValueKind::macro:
      return std::nullopt;
    case ValueKind::function:
    case ValueKind::spline:
      parser.take();
      if (!parser.next_is('(')) return *found;
      return parse_number_from(parser, *found);
    case ValueKind::array: {
      parser.take();
      Value element = parse_array_element(parser, found);
      if (element.kind == ValueKind::number || element.kind == ValueKind::function ||
          element.kind == ValueKind::spline) {
        return parse_number_from(parser, element);
      }
      return element;
    }
    default:
      parser.take();
      return *found;
  }
}

}  // namespace

Value parse_value(Parser& parser) {
  const Nesting nesting(parser);
  const Token& token = parser.peek();
  if (token.is_keyword()) {
    const K keyword = token.keyword();
    if (auto value = parse_block_value(parser, keyword)) return std::move(*value);
    if (begins_object(keyword)) return {ValueKind::object, parse_object(parser)};
    if (begins_color_word(keyword)) return parse_color_number(parser);
  } else if (auto value = parse_declared(parser)) {
    return std::move(*value);
  }
  if (begins_string(parser)) {
    std::string text = parse_string(parser, "a value");
    parser.claim(sizeof(std::string) + text.size());
    return string_value(std::move(text));
  }
  if (begins_number(parser)) return parse_number(parser);
  parser.fail_expected("a value");
}

}  // namespace lumivec::pov
