#include "loader/pov/settings_block.h"

#include "loader/pov/blend_maps.h"
#include "loader/pov/colors.h"
#include "loader/pov/expression.h"
#include "loader/pov/strings.h"
#include "loader/pov/transforms.h"

namespace lumivec::pov {

Settings parse_settings_block(Parser& parser, std::string_view construct) {
  const Nesting nesting(parser);
  Settings settings;
  K word = K::keyword_count;
  bool given = true;
  const auto end_word = [&] {
    if (!given) settings.emplace_back(word, 1.0);
    given = true;
  };
  parser.expect('{', construct);
  while (!parser.accept('}')) {
    if (parse_transform(parser) || parser.accept(',')) continue;
    if (const Slot* slot = parser.meaning(parser.peek());
        slot && ((*slot)->kind == ValueKind::fog || (*slot)->kind == ValueKind::rainbow)) {
      settings = (*slot)->as<Settings>();
      parser.take();
      continue;
    }
    if (parser.accept(K::color_map_)) {
      parse_color_map(parser, ValueKind::color_map);
    } else if (begins_number(parser)) {
      settings.emplace_back(word, parse_number(parser).n[0]);
      given = true;
    } else if (begins_color(parser)) {
      end_word();
      settings.emplace_back(K::color_, parse_color(parser).red);
    } else if (begins_string(parser)) {
      parse_string(parser, construct);
      given = true;
    } else if (parser.peek().is_keyword()) {
      end_word();
      word = parser.take().keyword();
      given = false;
    } else {
      parser.fail_expected("'}' of " + std::string(construct));
    }
    parser.claim(sizeof(settings[0]));
  }
  end_word();
  return settings;
}

double setting(const Settings& settings, K word, double otherwise) {
  double value = otherwise;
  for (const auto& [name, number] : settings) {
    if (name == word) value = number;
  }
  return value;
}

}  // namespace lumivec::pov
