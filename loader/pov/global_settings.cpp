#include "loader/pov/global_settings.h"

#include "loader/pov/colors.h"
#include "loader/pov/expression.h"
#include "loader/pov/settings_block.h"
#include "loader/pov/strings.h"

namespace lumivec::pov {
namespace {

void parse_gamma(Parser& parser, GlobalSettings& settings) {
  constexpr double srgb_gamma = 2.2;
  settings.has_assumed_gamma = true;
  if (parser.accept(K::srgb_)) {
    settings.assumed_gamma = srgb_gamma;
    return;
  }
  settings.assumed_gamma = parse_float(parser, "assumed_gamma");
  if (!(settings.assumed_gamma > 0.0)) parser.fail("assumed_gamma must be more than 0");
}

void parse_photons(Parser& parser, PhotonSettings& photons) {
  photons.settings = parse_settings_block(parser, "photons");
  photons.on = true;
  photons.spacing = setting(photons.settings, K::spacing_, 0.0);
  photons.count = setting(photons.settings, K::count_, 0.0);
}

// Settings of POV-Ray's own tracing, which have no meaning here.
bool parse_ignored(Parser& parser) {
  switch (parser.peek().keyword()) {
    case K::adc_bailout_:
    case K::max_intersections_:
    case K::number_of_waves_:
    case K::hf_gray_16_:
    case K::mm_per_unit_:
      parser.take();
      parse_switch(parser);
      return true;
    case K::irid_wavelength_:
      parser.take();
      parse_color(parser);
      return true;
    case K::charset_:
      parser.take();
      parser.take();
      return true;
    case K::subsurface_:
      parser.take();
      parse_settings_block(parser, "subsurface");
      return true;
    default:
      return false;
  }
}

}  // namespace

void parse_global_settings(Parser& parser) {
  const Nesting nesting(parser);
  GlobalSettings& settings = parser.scene.settings;
  parser.expect('{', "global_settings");
  while (!parser.accept('}')) {
    if (parser.accept(K::assumed_gamma_)) {
      parse_gamma(parser, settings);
    } else if (parser.accept(K::ambient_light_)) {
      settings.ambient_light = parse_rgb(parser);
    } else if (parser.accept(K::max_trace_level_)) {
      settings.max_trace_level = parse_float(parser, "max_trace_level");
    } else if (parser.accept(K::noise_generator_)) {
      settings.noise_generator = parse_int(parser, "noise_generator");
    } else if (parser.accept(K::radiosity_)) {
      settings.radiosity.on = true;
      settings.radiosity.settings = parse_settings_block(parser, "radiosity");
    } else if (parser.accept(K::photons_)) {
      parse_photons(parser, settings.photons);
    } else if (!parse_ignored(parser) && !parser.accept(',')) {
      parser.fail_expected("a part of global_settings");
    }
  }
}

}  // namespace lumivec::pov
