#include "loader/pov/object_modifiers.h"

#include "loader/pov/colors.h"
#include "loader/pov/expression.h"
#include "loader/pov/functions.h"
#include "loader/pov/interiors.h"
#include "loader/pov/objects.h"
#include "loader/pov/settings_block.h"
#include "loader/pov/textures.h"
#include "loader/pov/transforms.h"

namespace lumivec::pov {
namespace {

ObjectExtras& extras_of(Object& object, std::shared_ptr<ObjectExtras>& made) {
  made = object.extras ? std::make_shared<ObjectExtras>(*object.extras)
                       : std::make_shared<ObjectExtras>();
  object.extras = made;
  return *made;
}

// clipped_by { OBJECTS } or clipped_by { bounded_by }, and the other way round.
void parse_bounds(Parser& parser, Object& object, bool clip) {
  const std::string_view construct = clip ? "clipped_by" : "bounded_by";
  std::shared_ptr<ObjectExtras> made;
  ObjectExtras& extras = extras_of(object, made);
  parser.expect('{', construct);
  if (parser.accept(clip ? K::bounded_by_ : K::clipped_by_)) {
    if (clip) extras.clipped_by_bounds = true;
  } else {
    while (!parser.at('}'))
      (clip ? extras.clipped_by : extras.bounded_by).push_back(parse_object_reference(parser));
    measure_object(parser, object);
  }
  parser.expect('}', construct);
}

void set_texture(Object& object, TexturePtr texture) {
  object.texture = std::move(texture);
  object.texture_transform = nullptr;
}

void parse_material(Parser& parser, Object& object) {
  const MaterialBlock material = parse_material_block(parser);
  if (material.texture) set_texture(object, layered(parser, object.texture, material.texture));
  if (material.interior) object.interior = material.interior;
  if (material.interior_texture) {
    std::shared_ptr<ObjectExtras> made;
    extras_of(object, made).interior_texture = material.interior_texture;
  }
}

bool parse_flag(Parser& parser, Object& object) {
  const std::pair<K, bool Object::*> flags[] = {
      {K::hollow_, &Object::hollow},
      {K::no_shadow_, &Object::no_shadow},
      {K::no_image_, &Object::no_image},
      {K::no_reflection_, &Object::no_reflection},
      {K::no_radiosity_, &Object::no_radiosity},
      {K::double_illuminate_, &Object::double_illuminate},
      {K::uv_mapping_, &Object::uv_mapping},
  };
  for (const auto& [word, flag] : flags) {
    if (!parser.accept(word)) continue;
    object.*flag = parse_switch(parser);
    return true;
  }
  if (!parser.accept(K::inverse_)) return false;
  object.inverse = !object.inverse;
  return true;
}

// Hints to POV-Ray's own ray tests, and old ways to say what does not show.
bool parse_ignored(Parser& parser) {
  if (parser.accept(K::sturm_) || parser.accept(K::hierarchy_)) {
    parse_switch(parser);
    return true;
  }
  if (parser.accept(K::photons_)) {
    parse_settings_block(parser, "photons");
    return true;
  }
  if (parser.accept(K::radiosity_)) {
    parse_settings_block(parser, "radiosity");
    return true;
  }
  if (parser.accept(K::color_)) {
    parse_color(parser);
    return true;
  }
  return false;
}

// Of the objects that move along with one.
std::uint64_t companions(const Object& object) {
  std::uint64_t count = 0;
  for (const auto* list : {&object.extras->clipped_by, &object.extras->bounded_by}) {
    for (const ObjectPtr& part : *list) count += part->measure.count;
  }
  return count;
}

}  // namespace

void measure_object(Parser& parser, Object& object) {
  object.measure = {};
  const auto add = [&](const Measure& part) { parser.contain(object.measure, part); };
  if (object.texture) add(object.texture->measure);
  if (const auto* combined = std::get_if<std::shared_ptr<const CombinedShape>>(&object.shape)) {
    for (const ObjectPtr& part : (*combined)->parts) add(part->measure);
  } else if (const auto* mesh = std::get_if<std::shared_ptr<const MeshShape>>(&object.shape)) {
    for (const TexturePtr& texture : (*mesh)->textures) add(texture->measure);
  } else if (const auto* surface =
                 std::get_if<std::shared_ptr<const IsosurfaceShape>>(&object.shape)) {
    add((*surface)->function->measure);
  } else if (const auto* blob = std::get_if<std::shared_ptr<const BlobShape>>(&object.shape)) {
    for (const BlobShape::Component& part : (*blob)->components) {
      if (part.texture) add(part.texture->measure);
    }
  } else if (const auto* field =
                 std::get_if<std::shared_ptr<const HeightFieldShape>>(&object.shape)) {
    if ((*field)->function) add((*field)->function->measure);
  } else if (const auto* patch =
                 std::get_if<std::shared_ptr<const ParametricShape>>(&object.shape)) {
    for (const auto& function : (*patch)->functions) add(function->measure);
  } else if (const auto* light = std::get_if<std::shared_ptr<const LightSource>>(&object.shape)) {
    for (const auto& held : {(*light)->looks_like, (*light)->projected_through}) {
      if (held) add(held->measure);
    }
  }
  if (!object.extras) return;
  for (const auto* list : {&object.extras->clipped_by, &object.extras->bounded_by}) {
    for (const ObjectPtr& part : *list) add(part->measure);
  }
  if (object.extras->interior_texture) add(object.extras->interior_texture->measure);
}

void transform_object(Object& object, const M44d& transform) {
  const auto after = [&](std::shared_ptr<const M44d>& held) {
    held = std::make_shared<const M44d>(held ? *held * transform : transform);
  };
  after(object.transform);
  if (object.extras) {
    // What clips and bounds it moves along.
    auto moved = std::make_shared<ObjectExtras>(*object.extras);
    for (auto* list : {&moved->clipped_by, &moved->bounded_by}) {
      for (ObjectPtr& part : *list) {
        auto copy = std::make_shared<Object>(*part);
        transform_object(*copy, transform);
        part = std::move(copy);
      }
    }
    object.extras = std::move(moved);
  }
  if (!object.texture) return;
  if (object.texture_transform) {
    after(object.texture_transform);
  } else {
    object.texture_transform = std::make_shared<const M44d>(transform);
  }
}

bool parse_object_modifier(Parser& parser, Object& object) {
  if (parser.peek().kind != TokenKind::word) return false;
  if (const auto transform = parse_transform(parser)) {
    parser.claim(2 * sizeof(M44d));
    if (object.extras) parser.claim(companions(object) * sizeof(Object));
    transform_object(object, *transform);
    return true;
  }
  if (parser.accept(K::texture_)) {
    const TexturePtr texture = parse_texture_block(parser);
    set_texture(object, layered(parser, object.texture, texture));
    return true;
  }
  if (TexturePtr changed; parse_bare_part(parser, object.texture, changed)) {
    if (object.texture) {
      object.texture = changed;
    } else {
      set_texture(object, changed);
    }
    return true;
  }
  if (parser.accept(K::material_)) {
    parse_material(parser, object);
    return true;
  }
  if (parser.accept(K::interior_)) {
    object.interior = parse_interior_block(parser);
    return true;
  }
  if (parser.accept(K::interior_texture_)) {
    std::shared_ptr<ObjectExtras> made;
    extras_of(object, made).interior_texture = parse_texture_block(parser);
    return true;
  }
  if (parser.accept(K::clipped_by_)) {
    parse_bounds(parser, object, true);
    return true;
  }
  if (parser.accept(K::bounded_by_)) {
    parse_bounds(parser, object, false);
    return true;
  }
  return parse_flag(parser, object) || parse_ignored(parser);
}

void parse_object_modifiers(Parser& parser, Object& object) {
  while (!parser.accept('}')) {
    if (!parse_object_modifier(parser, object) && !parser.accept(','))
      parser.fail_expected("a modifier of an object, or '}',");
  }
}

}  // namespace lumivec::pov
