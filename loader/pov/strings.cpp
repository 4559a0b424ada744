#include "loader/pov/strings.h"

#include <algorithm>
#include <cctype>
#include <cstdio>

#include "loader/pov/arrays.h"
#include "loader/pov/expression.h"
#include "loader/pov/string_escapes.h"

namespace lumivec::pov {
namespace {

constexpr int most_digits = 100;  // of a printed number; longer widths are not readable

// A width below 0 fills up with zeros; fewer than 0 digits mean the usual six.
std::string formatted(double value, int width, int digits) {
  const bool zeros = width < 0;
  const int length = std::clamp(std::abs(std::max(width, -most_digits)), 0, most_digits);
  char text[512];
  std::snprintf(text, sizeof text, zeros ? "%0*.*f" : "%*.*f", length,
                digits < 0 ? 6 : std::min(digits, most_digits), value);
  return text;
}

std::string number_text(Parser& parser) {
  const double value = parse_float(parser, "str");
  skip_comma(parser);
  const int width = parse_int(parser, "str");
  skip_comma(parser);
  return formatted(value, width, parse_int(parser, "str"));
}

std::string vector_text(Parser& parser) {
  const int count = parse_int(parser, "vstr");
  if (count < 2 || count > 5) parser.fail("vstr writes 2 to 5 components");
  skip_comma(parser);
  const Number vector = parse_number(parser);
  skip_comma(parser);
  const std::string separator = parse_string(parser, "vstr");
  skip_comma(parser);
  const int width = parse_int(parser, "vstr");
  skip_comma(parser);
  const int digits = parse_int(parser, "vstr");
  std::string text;
  for (int i = 0; i < count; ++i) {
    const double n = i < vector.size ? vector.n[static_cast<std::size_t>(i)] : 0.0;
    text += (i > 0 ? separator : "") + formatted(n, width, digits);
  }
  return text;
}

std::string part(Parser& parser) {
  const std::string text = parse_string(parser, "substr");
  skip_comma(parser);
  const int first = parse_int(parser, "substr");
  skip_comma(parser);
  const int count = parse_int(parser, "substr");
  if (first < 1 || count < 0 ||
      static_cast<std::size_t>(first) + static_cast<std::size_t>(count) > text.size() + 1) {
    parser.fail("substr asks for characters " + std::to_string(first) + " and on, " +
                std::to_string(count) + " of them, of a string of " + std::to_string(text.size()));
  }
  return text.substr(static_cast<std::size_t>(first - 1), static_cast<std::size_t>(count));
}

enum class Use : std::uint8_t { text, file_name };

std::string parse(Parser& parser, std::string_view construct, Use use);

std::string joined(Parser& parser, Use use) {
  std::string text = parse(parser, "concat", use);
  constexpr std::size_t longest = std::size_t{1} << 24;
  while (parser.accept(',')) {
    text += parse(parser, "concat", use);
    if (text.size() > longest) parser.fail("a string grows beyond 16 million characters");
  }
  return text;
}

std::string in_case(Parser& parser, int (*change)(int)) {
  std::string text = parse_string(parser, "a string function");
  for (char& c : text) c = static_cast<char>(change(static_cast<unsigned char>(c)));
  return text;
}

std::string character(Parser& parser) {
  const int code = parse_int(parser, "chr");
  if (code < 0 || code > 0xffff) parser.fail("chr has no character " + std::to_string(code));
  return utf8(static_cast<unsigned>(code));
}

// Scenes must give the same picture at any time.
std::string date(Parser& parser) {
  parse_float(parser, "datetime");
  if (parser.accept(',')) parse_string(parser, "datetime");
  return "2000-01-01 00:00:00Z";
}

std::string call(Parser& parser, K keyword, Use use) {
  switch (keyword) {
    case K::str_:
      return number_text(parser);
    case K::vstr_:
      return vector_text(parser);
    case K::substr_:
      return part(parser);
    case K::concat_:
      return joined(parser, use);
    case K::strlwr_:
      return in_case(parser, std::tolower);
    case K::strupr_:
      return in_case(parser, std::toupper);
    case K::chr_:
      return character(parser);
    default:
      return date(parser);
  }
}

bool is_string_function(K keyword) {
  return keyword == K::str_ || keyword == K::vstr_ || keyword == K::substr_ ||
         keyword == K::concat_ || keyword == K::strlwr_ || keyword == K::strupr_ ||
         keyword == K::chr_ || keyword == K::datetime_;
}

std::string parse(Parser& parser, std::string_view construct, Use use) {
  const Token& token = parser.peek();
  if (token.kind == TokenKind::string) {
    const std::string& text = parser.string_of(token);
    parser.take();
    return use == Use::file_name ? text : replace_escapes(text);
  }
  if (is_string_function(token.keyword())) {
    const Nesting nesting(parser);
    parser.take();
    parser.expect('(', keyword_text(token.keyword()));
    std::string text = call(parser, token.keyword(), use);
    parser.expect(')', keyword_text(token.keyword()));
    parser.claim(text.size());
    return text;
  }
  if (const Slot* slot = parser.meaning(token)) {
    const Slot held = *slot;
    if (held->kind == ValueKind::string ||
        (held->kind == ValueKind::array && array_holds(*held, ValueKind::string))) {
      parser.take();
      const Value value =
          held->kind == ValueKind::array ? parse_array_element(parser, held) : *held;
      if (value.kind == ValueKind::string) return value.as<std::string>();
      parser.fail(std::string("a string is expected, but ") + kind_name(value.kind) + " is found");
    }
  }
  parser.fail_expected("a string for " + std::string(construct));
}

}  // namespace

std::string parse_string(Parser& parser, std::string_view construct) {
  return parse(parser, construct, Use::text);
}

std::string parse_file_name(Parser& parser, std::string_view construct) {
  return parse(parser, construct, Use::file_name);
}

bool begins_string(Parser& parser) {
  const Token& token = parser.peek();
  if (token.kind == TokenKind::string || is_string_function(token.keyword())) return true;
  const Slot* slot = parser.meaning(token);
  return slot && ((*slot)->kind == ValueKind::string ||
                  ((*slot)->kind == ValueKind::array && array_holds(**slot, ValueKind::string)));
}

std::string one_line(std::string text) {
  constexpr std::size_t readable = 200;
  if (text.size() > readable) text = text.substr(0, readable) + "...";
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace lumivec::pov
