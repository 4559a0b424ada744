#include "loader/pov/expression.h"
#include "loader/pov/fonts.h"
#include "loader/pov/functions.h"
#include "loader/pov/object_modifiers.h"
#include "loader/pov/patterns.h"
#include "loader/pov/shape_parsers.h"
#include "loader/pov/strings.h"
#include "loader/pov/textures.h"

namespace lumivec::pov {
namespace {

// sphere or cylinder of a blob, or its old form "component".
BlobShape::Component parse_component(Parser& parser, K keyword) {
  BlobShape::Component component;
  component.cylinder = keyword == K::cylinder_;
  if (keyword == K::component_) {
    component.strength = parse_float(parser, "a blob's component");
    skip_comma(parser);
    component.radius = parse_float(parser, "a blob's component");
    skip_comma(parser);
    component.center = parse_vector(parser);
    return component;
  }
  parser.expect('{', "a blob's component");
  component.center = parse_vector(parser);
  skip_comma(parser);
  if (component.cylinder) {
    component.cap = parse_vector(parser);
    skip_comma(parser);
  }
  component.radius = parse_float(parser, "a blob's component");
  skip_comma(parser);
  if (parser.accept(K::strength_)) skip_comma(parser);
  component.strength = parse_float(parser, "a blob's component");
  Object parts;
  parse_object_modifiers(parser, parts);
  if (parts.transform) component.transform = *parts.transform;
  component.texture = parts.texture;
  return component;
}

std::shared_ptr<const Function> parse_function_keyword(Parser& parser) {
  if (parser.accept(K::function_)) return parse_function(parser);
  parser.fail_expected("a function");
}

}  // namespace

Shape parse_blob(Parser& parser) {
  auto blob = std::make_shared<BlobShape>();
  for (;;) {
    const K keyword = parser.peek().keyword();
    if (parser.accept(K::threshold_)) {
      blob->threshold = parse_float(parser, "threshold");
    } else if (keyword == K::sphere_ || keyword == K::cylinder_ || keyword == K::component_) {
      parser.take();
      parser.claim(sizeof(BlobShape::Component));
      blob->components.push_back(parse_component(parser, keyword));
    } else if (parser.accept(K::hierarchy_)) {
      blob->hierarchy = parse_switch(parser);
    } else if (!parser.accept(',')) {
      break;
    }
  }
  return std::shared_ptr<const BlobShape>(std::move(blob));
}

Shape parse_height_field(Parser& parser) {
  auto field = std::make_shared<HeightFieldShape>();
  if (parser.accept(K::function_)) {
    field->function_width = parse_int(parser, "a height field's width");
    skip_comma(parser);
    field->function_height = parse_int(parser, "a height field's height");
    field->function = parse_function(parser);
  } else {
    field->image = parse_image_file(parser);
  }
  for (;;) {
    if (parser.accept(K::water_level_)) {
      field->water_level = parse_float(parser, "water_level");
    } else if (parser.accept(K::smooth_)) {
      field->smooth = parse_switch(parser);
    } else if (!parser.accept(',')) {
      break;
    }
  }
  return std::shared_ptr<const HeightFieldShape>(std::move(field));
}

Shape parse_text(Parser& parser) {
  FontName font;
  font.named_in = parser.source();
  if (parser.accept(K::internal_)) {
    parse_int(parser, "a font's number");
  } else {
    parser.accept(K::ttf_);
    parser.peek();
    font.place = parser.place();
    font.file = parse_file_name(parser, "a font");
  }
  skip_comma(parser);
  const std::string text = parse_string(parser, "a text");
  skip_comma(parser);
  const double thickness = parse_float(parser, "a text's thickness");
  skip_comma(parser);
  const Number offset = parse_number(parser);
  const V3d apart = offset.size == 1 ? V3d(offset.n[0], 0.0, 0.0) : to_vector(offset);
  if (font.file.empty()) {
    parser.mention(parser.place(), "a text in a font inside POV-Ray is left out: name a file");
    return std::make_shared<const TextShape>();
  }
  return std::make_shared<const TextShape>(text_of(parser, font, text, thickness, apart));
}

Shape parse_isosurface(Parser& parser) {
  auto surface = std::make_shared<IsosurfaceShape>();
  for (;;) {
    if (parser.accept(K::function_)) {
      surface->function = parse_function(parser);
    } else if (parser.accept(K::contained_by_)) {
      parser.expect('{', "contained_by");
      surface->sphere = parser.accept(K::sphere_);
      if (!surface->sphere && !parser.accept(K::box_)) parser.fail_expected("a sphere or box");
      parser.expect('{', "contained_by");
      surface->low = parse_vector(parser);
      skip_comma(parser);
      if (surface->sphere) {
        surface->radius = parse_float(parser, "a radius");
      } else {
        surface->high = parse_vector(parser);
      }
      parser.expect('}', "contained_by");
      parser.expect('}', "contained_by");
    } else if (parser.accept(K::threshold_)) {
      surface->threshold = parse_float(parser, "threshold");
    } else if (parser.accept(K::accuracy_)) {
      surface->accuracy = parse_float(parser, "accuracy");
    } else if (parser.accept(K::max_gradient_)) {
      surface->max_gradient = parse_float(parser, "max_gradient");
    } else if (parser.accept(K::max_trace_)) {
      parse_int(parser, "max_trace");
    } else if (parser.accept(K::evaluate_)) {
      for (int i = 0; i < 3; ++i) {
        parse_float(parser, "evaluate");
        skip_comma(parser);
      }
    } else if (parser.accept(K::all_intersections_)) {
      surface->all_intersections = true;
    } else if (parser.accept(K::open_)) {
      surface->open = true;
    } else if (!parser.accept(',')) {
      break;
    }
  }
  if (!surface->function) parser.fail("an isosurface needs a function");
  return std::shared_ptr<const IsosurfaceShape>(std::move(surface));
}

Shape parse_parametric(Parser& parser) {
  auto surface = std::make_shared<ParametricShape>();
  for (auto& function : surface->functions) {
    function = parse_function_keyword(parser);
    skip_comma(parser);
  }
  surface->low = parse_pair(parser);
  skip_comma(parser);
  surface->high = parse_pair(parser);
  for (;;) {
    if (parser.accept(K::contained_by_)) {
      parser.expect('{', "contained_by");
      parser.take();
      parser.expect('{', "contained_by");
      while (begins_number(parser)) {
        parse_number(parser);
        skip_comma(parser);
      }
      parser.expect('}', "contained_by");
      parser.expect('}', "contained_by");
    } else if (parser.accept(K::max_gradient_) || parser.accept(K::accuracy_)) {
      parse_float(parser, "a parametric surface");
    } else if (parser.accept(K::precompute_)) {
      parse_int(parser, "precompute");
      while (parser.accept(',') || parser.at(K::x_) || parser.at(K::y_) || parser.at(K::z_)) {
        if (parser.at(K::x_) || parser.at(K::y_) || parser.at(K::z_)) parser.take();
      }
    } else if (!parser.accept(',')) {
      break;
    }
  }
  return std::shared_ptr<const ParametricShape>(std::move(surface));
}

Shape parse_julia(Parser& parser) {
  JuliaShape julia;
  const Number parameter = parse_number(parser);
  for (std::size_t i = 0; i < 4; ++i) julia.parameter[i] = parameter.n[i];
  for (;;) {
    if (parser.accept(K::max_iteration_) || parser.accept(K::precision_)) {
      parse_float(parser, "julia_fractal");
    } else if (parser.accept(K::slice_)) {
      parse_number(parser);
      skip_comma(parser);
      parse_float(parser, "slice");
    } else if (parser.at(K::quaternion_) || parser.at(K::hypercomplex_) ||
               parser.at(K::reciprocal_) || parser.at(K::cube_)) {
      parser.take();
    } else if (parser.at(K::sqr_) || parser.at(K::exp_) || parser.at(K::sin_) ||
               parser.at(K::cos_) || parser.at(K::tan_) || parser.at(K::sinh_) ||
               parser.at(K::cosh_) || parser.at(K::tanh_) || parser.at(K::ln_) ||
               parser.at(K::pwr_) || parser.at(K::asin_) || parser.at(K::acos_) ||
               parser.at(K::atan_) || parser.at(K::asinh_) || parser.at(K::acosh_) ||
               parser.at(K::atanh_)) {
      if (parser.take().is(K::pwr_)) {
        parser.expect('(', "pwr");
        parse_float(parser, "pwr");
        skip_comma(parser);
        parse_float(parser, "pwr");
        parser.expect(')', "pwr");
      }
    } else if (!parser.accept(',')) {
      break;
    }
  }
  return julia;
}

}  // namespace lumivec::pov
