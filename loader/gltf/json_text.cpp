#include "loader/gltf/json_text.h"

#include <algorithm>

namespace lumivec::gltf {
namespace {

// Lines and columns count from 1, columns in bytes.
std::string line_and_column(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t last_break = before.rfind('\n');
  const std::size_t column =
      last_break == std::string_view::npos ? before.size() + 1 : before.size() - last_break;
  return "line " + std::to_string(line) + " column " + std::to_string(column);
}

void check_depth(const Context& context, std::string_view text) {
  int depth = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') {
        ++i;
      } else if (c == '"') {
        in_string = false;
      }
    } else if (c == '"') {
      in_string = true;
    } else if (c == '{' || c == '[') {
      if (++depth > max_json_depth) {
        context.fail(line_and_column(text, i),
                     "JSON nested deeper than " + std::to_string(max_json_depth) + " levels");
      }
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
}

// The library's message without its own prefix, which repeats the place.
std::string reason(const std::string& what) {
  constexpr std::string_view column = "column ";
  std::size_t begin = what.find(column);
  begin = what.find(": ", begin == std::string::npos ? 0 : begin);
  return printable(begin == std::string::npos ? what : what.substr(begin + 2));
}

}  // namespace

nlohmann::json parse_json(const Context& context, std::string text) {
  while (!text.empty() && text.back() == '\0') text.pop_back();
  check_depth(context, text);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t offset = error.byte > 0 ? error.byte - 1 : 0;
    context.fail(line_and_column(text, offset), reason(error.what()), "correct the JSON there");
  } catch (const nlohmann::json::exception& error) {
    context.fail("", "JSON: " + printable(error.what()), "correct the JSON");
  }
}

}  // namespace lumivec::gltf
