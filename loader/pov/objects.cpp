#include "loader/pov/objects.h"

#include "loader/pov/arrays.h"
#include "loader/pov/bounds.h"
#include "loader/pov/expression.h"
#include "loader/pov/light_sources.h"
#include "loader/pov/object_modifiers.h"
#include "loader/pov/shape_parsers.h"

namespace lumivec::pov {
namespace {

Shape parse_combination(Parser& parser, K keyword) {
  auto combined = std::make_shared<CombinedShape>();
  combined->combination = keyword == K::merge_          ? Combination::merge
                          : keyword == K::intersection_ ? Combination::intersection
                          : keyword == K::difference_   ? Combination::difference
                                                        : Combination::union_;
  for (;;) {
    if (parser.accept(K::split_union_)) {
      combined->split_union = parse_switch(parser);
      continue;
    }
    ObjectPtr part = parse_object(parser);
    if (!part) break;
    combined->parts.push_back(std::move(part));
    parser.claim(sizeof(ObjectPtr));
  }
  combined->bounds = bounds_of_parts(*combined);
  return std::shared_ptr<const CombinedShape>(std::move(combined));
}

Shape parse_shape(Parser& parser, K keyword) {
  switch (keyword) {
    case K::sphere_:
      return parse_sphere(parser);
    case K::box_:
      return parse_box(parser);
    case K::plane_:
      return parse_plane(parser);
    case K::cylinder_:
      return parse_cylinder(parser);
    case K::cone_:
      return parse_cone(parser);
    case K::torus_:
      return parse_torus(parser);
    case K::disc_:
      return parse_disc(parser);
    case K::triangle_:
    case K::smooth_triangle_:
      return parse_triangle(parser, keyword == K::smooth_triangle_);
    case K::polygon_:
      return parse_polygon(parser);
    case K::quadric_:
      return parse_quadric(parser);
    case K::cubic_:
      return parse_poly(parser, 3);
    case K::quartic_:
      return parse_poly(parser, 4);
    case K::poly_:
      return parse_poly(parser, 0);
    case K::superellipsoid_:
      return parse_superellipsoid(parser);
    case K::bicubic_patch_:
      return parse_bicubic_patch(parser);
    case K::prism_:
      return parse_prism(parser);
    case K::lathe_:
      return parse_lathe(parser);
    case K::sor_:
      return parse_sor(parser);
    case K::sphere_sweep_:
      return parse_sphere_sweep(parser);
    case K::mesh_:
      return parse_mesh(parser);
    case K::mesh2_:
      return parse_mesh2(parser);
    case K::blob_:
      return parse_blob(parser);
    case K::height_field_:
      return parse_height_field(parser);
    case K::text_:
      return parse_text(parser);
    case K::isosurface_:
      return parse_isosurface(parser);
    case K::parametric_:
      return parse_parametric(parser);
    case K::julia_fractal_:
      return parse_julia(parser);
    default:
      return parse_combination(parser, keyword);
  }
}

// A declared object, or an array's element that is one; null: there is none here.
ObjectPtr declared_object(Parser& parser) {
  const Slot* slot = parser.meaning(parser.peek());
  if (!slot) return nullptr;
  const Slot held = *slot;
  if (held->kind == ValueKind::object) {
    parser.take();
    return held->share<Object>();
  }
  if (held->kind == ValueKind::array && array_holds(*held, ValueKind::object)) {
    parser.take();
    const Value element = parse_array_element(parser, held);
    if (element.kind == ValueKind::object) return element.share<Object>();
  }
  return nullptr;
}

// Of shapes that say so after other modifiers: cylinder { ... texture { T } open }.
bool parse_late_open(Parser& parser, Shape& shape) {
  if (!parser.at(K::open_)) return false;
  if (auto* cone = std::get_if<ConeShape>(&shape)) {
    cone->open = true;
  } else if (auto* prism = std::get_if<std::shared_ptr<const PrismShape>>(&shape)) {
    auto opened = std::make_shared<PrismShape>(**prism);
    opened->open = true;
    *prism = opened;
  } else if (auto* sor = std::get_if<std::shared_ptr<const SorShape>>(&shape)) {
    auto opened = std::make_shared<SorShape>(**sor);
    opened->open = true;
    *sor = opened;
  } else {
    return false;
  }
  parser.take();
  return true;
}

void parse_modifiers(Parser& parser, Object& object) {
  while (!parser.accept('}')) {
    if (!parse_object_modifier(parser, object) && !parse_late_open(parser, object.shape) &&
        !parser.accept(',')) {
      parser.fail_expected("a modifier of an object, or '}',");
    }
  }
}

}  // namespace

bool begins_object(K keyword) {
  switch (keyword) {
    case K::sphere_:
    case K::box_:
    case K::plane_:
    case K::cylinder_:
    case K::cone_:
    case K::torus_:
    case K::disc_:
    case K::triangle_:
    case K::smooth_triangle_:
    case K::polygon_:
    case K::quadric_:
    case K::cubic_:
    case K::quartic_:
    case K::poly_:
    case K::superellipsoid_:
    case K::bicubic_patch_:
    case K::prism_:
    case K::lathe_:
    case K::sor_:
    case K::sphere_sweep_:
    case K::mesh_:
    case K::mesh2_:
    case K::blob_:
    case K::height_field_:
    case K::text_:
    case K::isosurface_:
    case K::parametric_:
    case K::julia_fractal_:
    case K::union_:
    case K::merge_:
    case K::intersection_:
    case K::difference_:
    case K::light_source_:
    case K::light_group_:
    case K::object_:
      return true;
    default:
      return false;
  }
}

ObjectPtr parse_object(Parser& parser) {
  const K keyword = parser.peek().keyword();
  if (!begins_object(keyword)) return nullptr;
  const Nesting nesting(parser);
  const Place place = parser.place();
  parser.take();
  if (keyword == K::light_source_) return parse_light_source(parser, place);
  if (keyword == K::light_group_) return parse_light_group(parser, place);
  parser.claim(sizeof(Object));
  auto object = std::make_shared<Object>();
  parser.expect('{', keyword_text(keyword));
  if (keyword == K::object_) {
    ObjectPtr held = declared_object(parser);
    if (!held) held = parse_object_in(parser, "object");
    *object = *held;
  } else {
    // The name of a declared object of the kind may stand for its shape.
    if (ObjectPtr held = declared_object(parser)) {
      *object = *held;
    } else {
      object->shape = parse_shape(parser, keyword);
    }
  }
  object->place = place;
  parse_modifiers(parser, *object);
  measure_object(parser, *object);
  return object;
}

ObjectPtr parse_object_in(Parser& parser, std::string_view construct) {
  ObjectPtr object = parse_object(parser);
  if (!object) parser.fail_expected("an object of " + std::string(construct));
  return object;
}

ObjectPtr parse_object_reference(Parser& parser) {
  if (ObjectPtr declared = declared_object(parser)) return declared;
  return parse_object_in(parser, "this block");
}

}  // namespace lumivec::pov
