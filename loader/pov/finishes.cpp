#include "loader/pov/finishes.h"

#include "loader/pov/colors.h"
#include "loader/pov/expression.h"
#include "loader/pov/settings_block.h"

namespace lumivec::pov {
namespace {

// reflection { MIN, MAX fresnel falloff F exponent E metallic M }.
void parse_reflection_block(Parser& parser, Finish& finish) {
  finish.reflection_min = finish.reflection_max = parse_rgb(parser);
  finish.fresnel = false;
  skip_comma(parser);
  if (begins_color(parser)) {
    finish.reflection_max = parse_rgb(parser);
  } else {
    finish.reflection_min = {0.0, 0.0, 0.0};
  }
  const bool one_color = finish.reflection_min == std::array<double, 3>{};
  bool varied = false;
  while (!parser.accept('}')) {
    if (parser.accept(K::fresnel_)) {
      finish.fresnel = parse_switch(parser);
      varied = true;
    } else if (parser.accept(K::falloff_)) {
      finish.reflection_falloff = parse_float(parser, "falloff");
      varied = true;
    } else if (parser.accept(K::exponent_)) {
      finish.reflection_exponent = parse_float(parser, "exponent");
    } else if (parser.accept(K::metallic_)) {
      finish.reflection_metallic = begins_number(parser) ? parse_float(parser, "metallic") : 1.0;
    } else {
      parser.fail_expected("'}' of a reflection");
    }
  }
  // One color alone is the same from all sides.
  if (one_color && !varied) finish.reflection_min = finish.reflection_max;
}

void parse_reflection(Parser& parser, Finish& finish) {
  if (parser.accept('{')) return parse_reflection_block(parser, finish);
  finish.reflection_min = finish.reflection_max = parse_rgb(parser);
}

double number_or(Parser& parser, double otherwise) {
  return begins_number(parser) ? parse_float(parser, "a finish") : otherwise;
}

void parse_diffuse(Parser& parser, Finish& finish) {
  finish.diffuse_albedo = parser.accept(K::albedo_);
  finish.diffuse = parse_float(parser, "diffuse");
  if (parser.accept(',')) finish.diffuse_back = parse_float(parser, "diffuse");
}

// What scenes before version 3.1 say of the inside.
bool parse_old_item(Parser& parser, Finish& finish) {
  if (parser.accept(K::ior_)) {
    finish.ior = parse_float(parser, "ior");
  } else if (parser.accept(K::refraction_)) {
    finish.refraction = parse_float(parser, "refraction");
  } else if (parser.accept(K::caustics_)) {
    finish.caustics = parse_float(parser, "caustics");
  } else if (parser.accept(K::fade_distance_)) {
    finish.fade_distance = parse_float(parser, "fade_distance");
  } else if (parser.accept(K::fade_power_)) {
    finish.fade_power = parse_float(parser, "fade_power");
  } else {
    return false;
  }
  return true;
}

bool parse_rare_item(Parser& parser, Finish& finish) {
  if (parser.accept(K::irid_)) {
    const Place place = parser.place();
    const Settings settings = parse_settings_block(parser, "irid");
    finish.irid = settings.empty() ? 0.0 : settings.front().second;
    parser.mention(place, "iridescence is left out");
  } else if (parser.accept(K::subsurface_)) {
    const Place place = parser.place();
    parse_settings_block(parser, "subsurface");
    finish.subsurface = true;
    parser.mention(place, "subsurface scattering is left out");
  } else if (parser.accept(K::use_alpha_)) {
    finish.use_alpha = parse_switch(parser);
  } else if (parser.accept(K::conserve_energy_)) {
    finish.conserve_energy = parse_switch(parser);
  } else if (parser.accept(K::crand_)) {
    finish.crand = parse_float(parser, "crand");
  } else if (parser.accept(K::reflection_exponent_)) {
    finish.reflection_exponent = parse_float(parser, "reflection_exponent");
  } else {
    return parse_old_item(parser, finish);
  }
  return true;
}

bool parse_item(Parser& parser, Finish& finish) {
  if (const Slot* slot = parser.meaning(parser.peek());
      slot && (*slot)->kind == ValueKind::finish) {
    finish = (*slot)->as<Finish>();
    parser.take();
  } else if (parser.accept(K::ambient_)) {
    finish.ambient = parse_rgb(parser);
  } else if (parser.accept(K::emission_)) {
    finish.emission = parse_rgb(parser);
  } else if (parser.accept(K::diffuse_)) {
    parse_diffuse(parser, finish);
  } else if (parser.accept(K::brilliance_)) {
    finish.brilliance = parse_float(parser, "brilliance");
  } else if (parser.accept(K::phong_)) {
    finish.phong_albedo = parser.accept(K::albedo_);
    finish.phong = parse_float(parser, "phong");
  } else if (parser.accept(K::phong_size_)) {
    finish.phong_size = parse_float(parser, "phong_size");
  } else if (parser.accept(K::specular_)) {
    finish.specular_albedo = parser.accept(K::albedo_);
    finish.specular = parse_float(parser, "specular");
  } else if (parser.accept(K::roughness_)) {
    finish.roughness = parse_float(parser, "roughness");
  } else if (parser.accept(K::metallic_)) {
    finish.metallic = number_or(parser, 1.0);
  } else if (parser.accept(K::reflection_)) {
    parse_reflection(parser, finish);
  } else {
    return parse_rare_item(parser, finish);
  }
  return true;
}

}  // namespace

void parse_finish_block(Parser& parser, Finish& finish) {
  const Nesting nesting(parser);
  parser.expect('{', "a finish");
  while (!parser.accept('}')) {
    if (!parse_item(parser, finish) && !parser.accept(','))
      parser.fail_expected("a part of a finish");
  }
}

}  // namespace lumivec::pov
