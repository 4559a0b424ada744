#include "loader/pov/scene_items.h"

#include "loader/pov/cameras.h"
#include "loader/pov/colors.h"
#include "loader/pov/expression.h"
#include "loader/pov/global_settings.h"
#include "loader/pov/interiors.h"
#include "loader/pov/objects.h"
#include "loader/pov/settings_block.h"
#include "loader/pov/sky_spheres.h"
#include "loader/pov/values.h"

namespace lumivec::pov {
namespace {

void parse_background(Parser& parser) {
  parser.expect('{', "background");
  parser.scene.background = parse_color(parser);
  parser.expect('}', "background");
}

bool parse_item(Parser& parser) {
  const Place place = parser.place();
  if (ObjectPtr object = parse_object(parser)) {
    parser.scene.objects.push_back(std::move(object));
    parser.claim(sizeof(ObjectPtr));
  } else if (parser.accept(K::camera_)) {
    parser.scene.camera = parse_camera_block(parser);
  } else if (parser.accept(K::background_)) {
    parse_background(parser);
  } else if (parser.accept(K::sky_sphere_)) {
    parser.scene.sky_sphere = parse_sky_sphere_block(parser);
  } else if (parser.accept(K::global_settings_)) {
    parse_global_settings(parser);
  } else if (parser.accept(K::fog_)) {
    parse_settings_block(parser, "fog");
    parser.mention(place, "fog is left out");
  } else if (parser.accept(K::rainbow_)) {
    parse_settings_block(parser, "rainbow");
    parser.mention(place, "the rainbow is left out");
  } else if (parser.accept(K::media_)) {
    parse_media_block(parser);
  } else if (!parser.accept(';')) {
    return false;
  }
  return true;
}

}  // namespace

void parse_scene_items(Parser& parser) {
  while (parser.peek().kind != TokenKind::end) {
    if (parse_item(parser)) continue;
    const Slot* slot = parser.meaning(parser.peek());
    if (slot && (*slot)->kind == ValueKind::object) {
      parser.fail("the object " + parser.symbols.text(parser.peek().word) + " stands alone",
                  "write object { } around its name");
    }
    parser.fail_expected("an object or a directive");
  }
}

}  // namespace lumivec::pov
