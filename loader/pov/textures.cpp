#include "loader/pov/textures.h"

#include "loader/pov/blend_maps.h"
#include "loader/pov/expression.h"
#include "loader/pov/finishes.h"
#include "loader/pov/interiors.h"
#include "loader/pov/normals.h"
#include "loader/pov/patterns.h"
#include "loader/pov/pigments.h"
#include "loader/pov/transforms.h"

namespace lumivec::pov {
namespace {

Texture default_texture(const Parser& parser) {
  if (parser.scene.default_texture) return *parser.scene.default_texture;
  Texture texture;
  texture.layers.emplace_back();
  return texture;
}

const Texture* declared_texture(Parser& parser) {
  const Slot* slot = parser.meaning(parser.peek());
  if (!slot) return nullptr;
  if ((*slot)->kind == ValueKind::texture) return &(*slot)->as<Texture>();
  return nullptr;
}

bool parse_part(Parser& parser, TextureLayer& layer) {
  if (parser.accept(K::pigment_)) {
    // Inside of a texture a pigment begins with what the texture has.
    Pigment pigment = layer.pigment;
    parser.expect('{', "a pigment");
    parse_pigment_items(parser, pigment);
    parser.expect('}', "a pigment");
    layer.pigment = std::move(pigment);
  } else if (parser.accept(K::normal_)) {
    layer.normal = parse_normal_block(parser);
    layer.has_normal = true;
  } else if (parser.accept(K::finish_)) {
    parse_finish_block(parser, layer.finish);
  } else {
    return false;
  }
  return true;
}

void parse_items(Parser& parser, Texture& texture);

TexturePtr parse_map_entry(Parser& parser) {
  auto texture = std::make_shared<Texture>(default_texture(parser));
  parse_items(parser, *texture);
  return texture;
}

// texture { A } texture { B }, of checker, tiles and the like.
void parse_texture_list(Parser& parser, TextureLayer& layer) {
  for (;;) {
    skip_comma(parser);
    if (!parser.accept(K::texture_) && !parser.accept(K::tile2_)) return;
    layer.textures.emplace_back(static_cast<double>(layer.textures.size()),
                                parse_texture_block(parser));
  }
}

void parse_tiles(Parser& parser, TextureLayer& layer) {
  parser.expect('{', "tiles");
  layer.pattern.kind = K::checker_;
  layer.pattern.place = parser.place();
  parse_texture_list(parser, layer);
  parser.expect('}', "tiles");
}

void parse_material_map(Parser& parser, TextureLayer& layer) {
  parser.expect('{', "a material map");
  layer.pattern.kind = K::image_pattern_;
  layer.pattern.place = parser.place();
  auto image = std::make_shared<ImageUse>(parse_image_file(parser));
  while (!parser.accept('}')) {
    if (parser.accept(K::texture_)) {
      layer.textures.emplace_back(static_cast<double>(layer.textures.size()),
                                  parse_texture_block(parser));
    } else if (parser.accept(K::map_type_)) {
      image->map_type = parse_int(parser, "map_type");
    } else if (parser.accept(K::interpolate_)) {
      image->interpolate = parse_int(parser, "interpolate");
    } else if (parser.accept(K::once_)) {
      image->once = true;
    } else {
      parser.fail_expected("a part of a material map");
    }
  }
  layer.pattern.image = image;
}

bool parse_item(Parser& parser, Texture& texture, bool& patterned) {
  if (const Texture* declared = declared_texture(parser)) {
    texture = *declared;
    parser.take();
    patterned = !texture.layers.empty() && texture.layers.back().pattern.kind != K::keyword_count;
    return true;
  }
  if (texture.layers.empty()) texture.layers.emplace_back();
  if (const auto transform = parse_transform(parser)) {
    for (TextureLayer& layer : texture.layers) layer.transform = layer.transform * *transform;
    return true;
  }
  TextureLayer& layer = texture.layers.back();
  if (parse_part(parser, layer)) return true;
  if (parser.accept(K::texture_map_)) {
    layer.textures = parse_texture_map(parser);
    return true;
  }
  if (parser.accept(K::tiles_)) {
    parse_tiles(parser, layer);
    return true;
  }
  if (parser.accept(K::material_map_)) {
    parse_material_map(parser, layer);
    return true;
  }
  if (parser.accept(K::uv_mapping_)) {
    texture.uv_mapping = parse_switch(parser);
    return true;
  }
  if (parser.accept(K::no_bump_scale_)) {
    parse_switch(parser);
    return true;
  }
  if (parse_pattern_kind(parser, layer.pattern)) {
    layer.place = layer.pattern.place;
    patterned = true;
    parse_texture_list(parser, layer);
    return true;
  }
  return patterned && parse_pattern_modifier(parser, layer.pattern);
}

// Of what the layers hold now.
void measure(Parser& parser, Texture& texture) {
  texture.measure = {};
  for (const TextureLayer& layer : texture.layers) {
    parser.contain(texture.measure, layer.pigment.measure);
    parser.contain(texture.measure, layer.normal.measure);
    parser.contain(texture.measure, layer.pattern.measure);
    for (const auto& [value, part] : layer.textures) {
      if (part) parser.contain(texture.measure, part->measure);
    }
  }
}

void parse_items(Parser& parser, Texture& texture) {
  const Nesting nesting(parser);
  bool patterned = false;
  while (!parser.at('}') && !parser.at(']')) {
    if (!parse_item(parser, texture, patterned) && !parser.accept(','))
      parser.fail_expected("a part of a texture");
  }
  measure(parser, texture);
}

}  // namespace

TexturePtr parse_texture_block(Parser& parser) {
  auto texture = std::make_shared<Texture>(default_texture(parser));
  parser.expect('{', "a texture");
  // The usual case of a declared texture alone shares it.
  if (declared_texture(parser)) {
    const Slot declared = *parser.meaning(parser.peek());
    parser.take();
    if (parser.accept('}')) return declared->share<Texture>();
    *texture = declared->as<Texture>();
  }
  for (TextureLayer& layer : texture->layers) layer.place = parser.place();
  parser.claim(sizeof(Texture) + texture->layers.size() * sizeof(TextureLayer));
  parse_items(parser, *texture);
  parser.expect('}', "a texture");
  return texture;
}

std::vector<std::pair<double, TexturePtr>> parse_texture_map(Parser& parser) {
  return parse_map<TexturePtr>(parser, ValueKind::texture_map,
                               [&] { return parse_map_entry(parser); });
}

bool parse_bare_part(Parser& parser, const TexturePtr& base, TexturePtr& result) {
  if (!parser.at(K::pigment_) && !parser.at(K::normal_) && !parser.at(K::finish_)) return false;
  auto texture = std::make_shared<Texture>(base ? *base : default_texture(parser));
  parser.claim(sizeof(Texture) + texture->layers.size() * sizeof(TextureLayer));
  if (texture->layers.empty()) texture->layers.emplace_back();
  texture->layers.back().place = parser.place();
  parse_part(parser, texture->layers.back());
  measure(parser, *texture);
  result = texture;
  return true;
}

MaterialBlock parse_material_block(Parser& parser) {
  const Nesting nesting(parser);
  MaterialBlock material;
  parser.expect('{', "a material");
  while (!parser.accept('}')) {
    if (const Slot* slot = parser.meaning(parser.peek());
        slot && (*slot)->kind == ValueKind::material) {
      material = (*slot)->as<MaterialBlock>();
      parser.take();
    } else if (parser.accept(K::texture_)) {
      material.texture = layered(parser, material.texture, parse_texture_block(parser));
    } else if (parser.accept(K::interior_texture_)) {
      material.interior_texture = parse_texture_block(parser);
    } else if (parser.accept(K::interior_)) {
      material.interior = parse_interior_block(parser);
    } else if (const auto transform = parse_transform(parser)) {
      if (material.texture) {
        parser.claim(material.texture->layers.size() * sizeof(TextureLayer));
        auto moved = std::make_shared<Texture>(*material.texture);
        for (TextureLayer& layer : moved->layers) layer.transform = layer.transform * *transform;
        material.texture = moved;
      }
    } else {
      parser.fail_expected("a part of a material");
    }
  }
  return material;
}

TexturePtr layered(Parser& parser, const TexturePtr& lower, const TexturePtr& upper) {
  if (!lower) return upper;
  if (!upper) return lower;
  constexpr std::size_t most_layers = 1000;  // far more than can be seen
  const std::size_t layers = lower->layers.size() + upper->layers.size();
  if (layers > most_layers) parser.fail("a texture has more than 1000 layers", "use fewer");
  parser.claim(layers * sizeof(TextureLayer));
  auto both = std::make_shared<Texture>(*lower);
  parser.contain(both->measure, upper->measure);
  both->layers.insert(both->layers.end(), upper->layers.begin(), upper->layers.end());
  return both;
}

void set_default(Parser& parser) {
  parser.expect('{', "#default");
  while (!parser.accept('}')) {
    TexturePtr texture;
    if (parser.accept(K::texture_)) {
      texture = parse_texture_block(parser);
    } else if (!parse_bare_part(parser, parser.scene.default_texture, texture)) {
      parser.fail_expected("texture, pigment, normal or finish");
    }
    parser.scene.default_texture = texture;
  }
}

}  // namespace lumivec::pov
