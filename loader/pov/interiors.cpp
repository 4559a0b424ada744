#include "loader/pov/interiors.h"

#include "loader/pov/colors.h"
#include "loader/pov/expression.h"
#include "loader/pov/pigments.h"
#include "loader/pov/transforms.h"

namespace lumivec::pov {
namespace {

// scattering { TYPE, COLOR eccentricity E extinction X }.
void parse_scattering(Parser& parser, Media& media) {
  parser.expect('{', "scattering");
  media.scattering_type = parse_int(parser, "scattering");
  skip_comma(parser);
  media.scattering = parse_rgb(parser);
  while (!parser.accept('}')) {
    if (!parser.accept(K::eccentricity_) && !parser.accept(K::extinction_))
      parser.fail_expected("'}' of scattering");
    parse_float(parser, "scattering");
  }
}

// How finely POV-Ray samples, which says nothing of the scene.
bool parse_sampling(Parser& parser) {
  static constexpr K words[] = {K::intervals_, K::samples_,    K::method_,
                                K::ratio_,     K::confidence_, K::variance_,
                                K::jitter_,    K::aa_level_,   K::aa_threshold_};
  for (const K word : words) {
    if (!parser.accept(word)) continue;
    while (begins_number(parser)) {
      parse_float(parser, "media");
      skip_comma(parser);
    }
    return true;
  }
  return false;
}

bool parse_media_item(Parser& parser, Media& media) {
  if (const Slot* slot = parser.meaning(parser.peek()); slot && (*slot)->kind == ValueKind::media) {
    media = (*slot)->as<Media>();
    parser.take();
  } else if (parser.accept(K::absorption_)) {
    media.absorption = parse_rgb(parser);
  } else if (parser.accept(K::emission_)) {
    media.emission = parse_rgb(parser);
  } else if (parser.accept(K::scattering_)) {
    parse_scattering(parser, media);
  } else if (parser.accept(K::density_)) {
    parse_pigment_block(parser);
  } else if (!parse_sampling(parser)) {
    return parse_transform(parser).has_value();
  }
  return true;
}

bool parse_interior_item(Parser& parser, Interior& interior) {
  if (const Slot* slot = parser.meaning(parser.peek());
      slot && (*slot)->kind == ValueKind::interior) {
    interior = (*slot)->as<Interior>();
    parser.take();
  } else if (parser.accept(K::ior_)) {
    interior.ior = parse_float(parser, "ior");
  } else if (parser.accept(K::caustics_)) {
    interior.caustics = parse_float(parser, "caustics");
  } else if (parser.accept(K::dispersion_)) {
    interior.dispersion = parse_float(parser, "dispersion");
    if (interior.dispersion != 1.0) parser.mention(parser.place(), "dispersion is left out");
  } else if (parser.accept(K::dispersion_samples_)) {
    parse_float(parser, "dispersion_samples");
  } else if (parser.accept(K::fade_distance_)) {
    interior.fade_distance = parse_float(parser, "fade_distance");
  } else if (parser.accept(K::fade_power_)) {
    interior.fade_power = parse_float(parser, "fade_power");
  } else if (parser.accept(K::fade_color_)) {
    interior.fade_color = parse_rgb(parser);
  } else if (parser.accept(K::media_)) {
    interior.media.push_back(parse_media_block(parser));
  } else {
    return false;
  }
  return true;
}

}  // namespace

Media parse_media_block(Parser& parser) {
  const Nesting nesting(parser);
  Media media;
  media.place = parser.place();
  parser.mention(media.place, "media are left out");
  parser.expect('{', "media");
  while (!parser.accept('}')) {
    if (!parse_media_item(parser, media) && !parser.accept(','))
      parser.fail_expected("a part of media");
  }
  return media;
}

std::shared_ptr<const Interior> parse_interior_block(Parser& parser) {
  const Nesting nesting(parser);
  auto interior = std::make_shared<Interior>();
  parser.expect('{', "an interior");
  while (!parser.accept('}')) {
    if (!parse_interior_item(parser, *interior) && !parser.accept(','))
      parser.fail_expected("a part of an interior");
  }
  return interior;
}

}  // namespace lumivec::pov
