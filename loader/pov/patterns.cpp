#include "loader/pov/patterns.h"

#include "loader/pov/expression.h"
#include "loader/pov/functions.h"
#include "loader/pov/objects.h"
#include "loader/pov/pigments.h"
#include "loader/pov/transforms.h"

namespace lumivec::pov {
namespace {

enum class PatternForm : std::uint8_t {
  none,
  plain,
  vector,  // followed by one
  number   // followed by one
};

PatternForm form_of(K word) {
  switch (word) {
    case K::agate_:
    case K::boxed_:
    case K::bozo_:
    case K::bumps_:
    case K::cells_:
    case K::crackle_:
    case K::cylindrical_:
    case K::dents_:
    case K::granite_:
    case K::leopard_:
    case K::marble_:
    case K::onion_:
    case K::planar_:
    case K::radial_:
    case K::ripples_:
    case K::spherical_:
    case K::spotted_:
    case K::waves_:
    case K::wood_:
    case K::wrinkles_:
    case K::cubic_:
    case K::brick_:
    case K::checker_:
    case K::hexagon_:
    case K::facets_:
      return PatternForm::plain;
    case K::aoi_:
    case K::quilted_:
      return PatternForm::plain;
    case K::gradient_:
    case K::slope_:
      return PatternForm::vector;
    case K::spiral1_:
    case K::spiral2_:
    case K::tiling_:
      return PatternForm::number;
    default:
      return PatternForm::none;
  }
}

// slope { AXIS, LOW, HIGH altitude AXIS, LOW, HIGH } or slope AXIS.
void parse_slope(Parser& parser, Pattern& pattern) {
  const bool block = parser.accept('{');
  pattern.vector = parse_vector(parser);
  if (!block) return;
  while (!parser.accept('}')) {
    if (!parser.accept(',') && !parser.accept(K::altitude_) && !parser.accept(K::point_at_)) {
      const Number number = parse_number(parser);
      for (std::size_t i = 0; i < number.size; ++i) pattern.numbers.push_back(number.n[i]);
    }
  }
}

// mandel N, julia <a, b>, N, magnet and exponents.
void parse_fractal(Parser& parser, Pattern& pattern) {
  if (parser.accept(K::magnet_)) {
    pattern.numbers.push_back(parse_float(parser, "magnet"));
    if (parser.at(K::mandel_) || parser.at(K::julia_)) parser.take();
    skip_comma(parser);
  }
  while (begins_number(parser)) {
    const Number number = parse_number(parser);
    for (std::size_t i = 0; i < number.size; ++i) pattern.numbers.push_back(number.n[i]);
    skip_comma(parser);
  }
}

bool parse_warp_item(Parser& parser, PatternStep& step) {
  static constexpr K flags[] = {K::flip_,         K::offset_,     K::strength_,    K::falloff_,
                                K::radius_,       K::inverse_,    K::orientation_, K::dist_exp_,
                                K::major_radius_, K::turbulence_, K::octaves_,     K::omega_,
                                K::lambda_,       K::repeat_};
  for (const K flag : flags) {
    if (!parser.accept(flag)) continue;
    if (flag == K::inverse_) {
      step.options.emplace_back(flag, V3d(1.0));
    } else if (flag == K::turbulence_) {
      step.turbulence = parse_vector(parser);
    } else if (flag == K::octaves_) {
      step.octaves = parse_float(parser, "octaves");
    } else if (flag == K::omega_) {
      step.omega = parse_float(parser, "omega");
    } else if (flag == K::lambda_) {
      step.lambda = parse_float(parser, "lambda");
    } else {
      step.options.emplace_back(flag, parse_vector(parser));
    }
    return true;
  }
  return false;
}

PatternStep parse_warp(Parser& parser) {
  PatternStep step;
  step.kind = PatternStep::Kind::warp;
  parser.expect('{', "a warp");
  step.warp = parser.peek().keyword();
  switch (step.warp) {
    case K::repeat_:
    case K::black_hole_:
    case K::turbulence_:
    case K::cylindrical_:
    case K::spherical_:
    case K::toroidal_:
    case K::planar_:
    case K::cubic_:
      break;
    default:
      parser.fail_expected("the kind of a warp");
  }
  parser.take();
  while (begins_number(parser)) {
    const V3d vector = parse_vector(parser);
    if (step.warp == K::turbulence_) step.turbulence = vector;
    step.vectors.push_back(vector);
    skip_comma(parser);
  }
  while (!parser.accept('}')) {
    if (!parse_warp_item(parser, step) && !parser.accept(','))
      parser.fail_expected("'}' of a warp");
  }
  return step;
}

// Octaves and the like belong to the turbulence that stands before or after them.
PatternStep& turbulence_of(Pattern& pattern) {
  for (PatternStep& step : pattern.steps) {
    if (step.kind == PatternStep::Kind::turbulence) return step;
  }
  PatternStep step;
  step.kind = PatternStep::Kind::turbulence;
  return pattern.steps.emplace_back(step);
}

bool parse_wave(Parser& parser, Pattern& pattern) {
  switch (parser.peek().keyword()) {
    case K::ramp_wave_:
    case K::triangle_wave_:
    case K::sine_wave_:
    case K::scallop_wave_:
    case K::cubic_wave_:
      pattern.wave = parser.take().keyword();
      return true;
    case K::poly_wave_:
      pattern.wave = parser.take().keyword();
      if (begins_number(parser)) pattern.wave_exponent = parse_float(parser, "poly_wave");
      return true;
    default:
      return false;
  }
}

// Numbers that only certain patterns have, kept with their names.
bool parse_parameter(Parser& parser, Pattern& pattern) {
  const K word = parser.peek().keyword();
  switch (word) {
    case K::form_:
    case K::offset_: {
      parser.take();
      const Number number = parse_number(parser);
      for (std::size_t i = 0; i < number.size; ++i)
        pattern.parameters.emplace_back(word, number.n[i]);
      return true;
    }
    case K::metric_:
    case K::agate_turb_:
    case K::exponent_:
    case K::mortar_:
    case K::control0_:
    case K::control1_:
    case K::coords_:
    case K::size_:
    case K::repeat_:
    case K::accuracy_:
      parser.take();
      pattern.parameters.emplace_back(word, parse_float(parser, keyword_text(word)));
      return true;
    case K::brick_size_: {
      parser.take();
      pattern.vector = parse_vector(parser);
      return true;
    }
    case K::interior_:
    case K::exterior_: {
      parser.take();
      const double first = parse_float(parser, "interior or exterior");
      skip_comma(parser);
      pattern.parameters.emplace_back(word, first);
      pattern.parameters.emplace_back(word, parse_float(parser, "interior or exterior"));
      return true;
    }
    case K::solid_:
      parser.take();
      return true;
    case K::noise_generator_:
      parser.take();
      pattern.noise_generator = parse_int(parser, "noise_generator");
      return true;
    default:
      return false;
  }
}

}  // namespace

bool parse_pattern_kind(Parser& parser, Pattern& pattern) {
  const K word = parser.peek().keyword();
  const PatternForm form = form_of(word);
  const bool structured = word == K::mandel_ || word == K::julia_ || word == K::magnet_ ||
                          word == K::pigment_pattern_ || word == K::image_pattern_ ||
                          word == K::function_ || word == K::density_file_ || word == K::average_ ||
                          word == K::object_;
  if (form == PatternForm::none && !structured) return false;
  pattern.kind = word;
  pattern.place = parser.place();
  pattern.numbers.clear();
  pattern.vector = V3d(0.0);
  parser.take();
  if (form == PatternForm::vector) {
    if (word == K::slope_) {
      parse_slope(parser, pattern);
    } else {
      pattern.vector = parse_vector(parser);
    }
  } else if (form == PatternForm::number) {
    pattern.numbers = {parse_float(parser, keyword_text(word))};
  } else if (word == K::mandel_ || word == K::julia_ || word == K::magnet_) {
    parse_fractal(parser, pattern);
  } else if (word == K::pigment_pattern_) {
    pattern.pigment = std::make_shared<const Pigment>(parse_pigment_block(parser));
  } else if (word == K::image_pattern_) {
    pattern.image = parse_image_block(parser);
  } else if (word == K::function_) {
    pattern.function = parse_function(parser);
  } else if (word == K::density_file_) {
    pattern.image = std::make_shared<const ImageUse>(parse_image_file(parser));
    if (parser.accept(K::interpolate_)) parse_float(parser, "interpolate");
  } else if (word == K::object_) {
    parser.expect('{', "an object pattern");
    pattern.object = parse_object_reference(parser);
    parser.expect('}', "an object pattern");
  }
  pattern.measure = {};
  if (pattern.pigment) parser.contain(pattern.measure, pattern.pigment->measure);
  if (pattern.function) parser.contain(pattern.measure, pattern.function->measure);
  if (pattern.object) parser.contain(pattern.measure, pattern.object->measure);
  return true;
}

bool parse_pattern_modifier(Parser& parser, Pattern& pattern) {
  if (const auto transform = parse_transform(parser)) {
    PatternStep step;
    step.transform = *transform;
    pattern.steps.push_back(step);
    return true;
  }
  if (parser.accept(K::turbulence_)) {
    const V3d strength = parse_vector(parser);
    turbulence_of(pattern).turbulence = strength;
    return true;
  }
  if (parser.accept(K::octaves_)) {
    turbulence_of(pattern).octaves = parse_float(parser, "octaves");
    return true;
  }
  if (parser.accept(K::omega_)) {
    turbulence_of(pattern).omega = parse_float(parser, "omega");
    return true;
  }
  if (parser.accept(K::lambda_)) {
    turbulence_of(pattern).lambda = parse_float(parser, "lambda");
    return true;
  }
  if (parser.accept(K::warp_)) {
    pattern.steps.push_back(parse_warp(parser));
    return true;
  }
  if (parser.accept(K::frequency_)) {
    pattern.frequency = parse_float(parser, "frequency");
    return true;
  }
  if (parser.accept(K::phase_)) {
    pattern.phase = parse_float(parser, "phase");
    return true;
  }
  return parse_wave(parser, pattern) || parse_parameter(parser, pattern);
}

std::shared_ptr<const Pattern> parse_pattern_block(Parser& parser) {
  auto pattern = std::make_shared<Pattern>();
  parser.expect('{', "a pattern");
  while (!parser.accept('}')) {
    if (!parse_pattern_modifier(parser, *pattern) && !parse_pattern_kind(parser, *pattern))
      parser.fail_expected("a pattern or its modifier");
  }
  return pattern;
}

}  // namespace lumivec::pov
