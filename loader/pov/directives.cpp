#include "loader/pov/directives.h"

#include <algorithm>

#include "loader/pov/conditions.h"
#include "loader/pov/data_files.h"
#include "loader/pov/declarations.h"
#include "loader/pov/expression.h"
#include "loader/pov/macros.h"
#include "loader/pov/strings.h"
#include "loader/pov/textures.h"

namespace lumivec::pov {
namespace {

void include_file(Parser& parser) {
  const Place called_at = parser.place();
  const std::string name = parse_file_name(parser, "#include");
  std::uint32_t source = 0;
  const std::uint64_t before = parser.sources.bytes();
  try {
    source = parser.sources.include(name, called_at.file, parser.symbols, parser.unclaimed());
  } catch (const FileProblem& problem) {
    parser.fail_at(called_at, problem.problem, problem.remedy);
  }
  const auto end = static_cast<std::uint32_t>(parser.sources[source].text.tokens.size() - 1);
  parser.claim(parser.sources.bytes() - before);
  parser.push(source, 0, end, nullptr, called_at);
  parser.symbols.open_scope();
}

void set_version(Parser& parser) {
  constexpr double oldest = 0.5, newest = 3.8;
  parser.scene.version = parse_float(parser, "#version");
  if (!(parser.scene.version > oldest && parser.scene.version <= newest)) {
    parser.fail("version " + std::to_string(parser.scene.version) + " of the language is not known",
                "give one up to 3.8");
  }
  parser.accept(';');
}

// Messages are of use where the scene is written, so only warnings are passed on, once each.
void tell(Parser& parser, const Place& place, const std::string& kind) {
  const std::string text = parse_string(parser, kind);
  if (kind == "#error") parser.fail_at(place, "the scene stops with #error: " + one_line(text));
  if (kind == "#warning") parser.mention(place, "the scene warns: " + one_line(text));
  constexpr std::size_t most_debug_text = 1 << 20;  // bytes
  if (kind == "#debug" && parser.scene.debug_text.size() < most_debug_text)
    parser.scene.debug_text += text;
}

}  // namespace

void obey_directive(Parser& parser) {
  const Nesting nesting(parser);
  const Token& token = parser.raw_current();
  const std::uint32_t index = parser.frame().position() - 1;
  const Place place = parser.place();
  parser.count_step();
  if (!token.is_keyword_word()) {
    parser.fail("there is no directive #" + parser.symbols.text(token.word));
  }
  switch (static_cast<K>(token.word)) {
    case K::declare_:
      return declare(parser, false);
    case K::local_:
      return declare(parser, true);
    case K::undef_:
      return undefine(parser);
    case K::macro_:
      return define_macro(parser, index);
    case K::include_:
      return include_file(parser);
    case K::if_:
    case K::ifdef_:
    case K::ifndef_:
      return begin_condition(parser, index);
    case K::elseif_:
    case K::else_:
      return end_branch(parser);
    case K::switch_:
      return begin_choice(parser, index);
    case K::case_:
    case K::range_:
      return pass_case(parser, index);
    case K::while_:
      return begin_while(parser, index);
    case K::for_:
      return begin_for(parser, index);
    case K::break_:
      return break_block(parser);
    case K::end_:
      return end_block(parser);
    case K::default_:
      return set_default(parser);
    case K::version_:
      return set_version(parser);
    case K::debug_:
    case K::warning_:
    case K::error_:
    case K::render_:
    case K::statistics_:
      return tell(parser, place, "#" + parser.symbols.text(token.word));
    case K::fopen_:
      return open_data_file(parser);
    case K::fclose_:
      return close_data_file(parser);
    case K::read_:
      return read_data_file(parser);
    case K::write_:
      parser.fail("#write is refused: scenes are not allowed to write files",
                  "write the file by POV-Ray, and include it");
    default:
      parser.fail("there is no directive #" + parser.symbols.text(token.word));
  }
}

}  // namespace lumivec::pov
