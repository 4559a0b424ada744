#include "loader/pov/string_escapes.h"

#include <charconv>

namespace lumivec::pov {
namespace {

// What the letter after a backslash stands for; 0: nothing.
char simple_escape(char letter) {
  switch (letter) {
    case 'a':
      return '\a';
    case 'b':
      return '\b';
    case 'f':
      return '\f';
    case 'n':
      return '\n';
    case 'r':
      return '\r';
    case 't':
      return '\t';
    case 'v':
      return '\v';
    case '"':
    case '\'':
    case '\\':
      return letter;
    default:
      return '\0';
  }
}

}  // namespace

std::string utf8(unsigned code) {
  std::string bytes;
  if (code < 0x80) {
    bytes += static_cast<char>(code);
  } else if (code < 0x800) {
    bytes += static_cast<char>(0xc0 | code >> 6);
    bytes += static_cast<char>(0x80 | (code & 0x3f));
  } else {
    bytes += static_cast<char>(0xe0 | (code >> 12 & 0x0f));
    bytes += static_cast<char>(0x80 | (code >> 6 & 0x3f));
    bytes += static_cast<char>(0x80 | (code & 0x3f));
  }
  return bytes;
}

std::string replace_escapes(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 1 == text.size()) {
      out += text[i];
      continue;
    }
    const char letter = text[i + 1];
    unsigned code = 0;
    if (letter == 'u' && i + 6 <= text.size() &&
        std::from_chars(text.data() + i + 2, text.data() + i + 6, code, 16).ptr ==
            text.data() + i + 6) {
      out += utf8(code);
      i += 5;
    } else if (const char simple = simple_escape(letter)) {
      out += simple;
      ++i;
    } else {
      out += '\\';
    }
  }
  return out;
}

}  // namespace lumivec::pov
