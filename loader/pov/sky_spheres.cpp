#include "loader/pov/sky_spheres.h"

#include "loader/pov/colors.h"
#include "loader/pov/pigments.h"
#include "loader/pov/transforms.h"

namespace lumivec::pov {

SkySphere parse_sky_sphere_block(Parser& parser) {
  const Nesting nesting(parser);
  SkySphere sky;
  sky.place = parser.place();
  parser.expect('{', "a sky sphere");
  while (!parser.accept('}')) {
    if (const Slot* slot = parser.meaning(parser.peek());
        slot && (*slot)->kind == ValueKind::sky_sphere) {
      sky = (*slot)->as<SkySphere>();
      parser.take();
    } else if (parser.accept(K::pigment_)) {
      sky.pigments.push_back(parse_pigment_block(parser));
    } else if (parser.accept(K::emission_)) {
      sky.emission = parse_color(parser).red;
    } else if (const auto transform = parse_transform(parser)) {
      PatternStep step;
      step.transform = *transform;
      sky.steps.push_back(step);
    } else {
      parser.fail_expected("a part of a sky sphere");
    }
  }
  return sky;
}

}  // namespace lumivec::pov
