// What the scene language is made of: words, numbers, strings, punctuation and directives, each
// with its place.
#pragma once

#include <cstdint>

#include "loader/pov/keywords.h"

namespace lumivec::pov {

// Where something is said. Lines and columns count from 1; columns in bytes.
struct Place {
  std::uint32_t file = 0;  // index into Sources
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

enum class TokenKind : std::uint8_t {
  end,          // of the scene
  word,         // keyword or identifier: Token::word
  number,       // Token::number
  string,       // Token::word indexes Source::strings
  punctuation,  // Token::word is the character; two of them are combined as by two_characters
  directive,    // Token::word is the word after #
  invalid       // Token::word indexes Source::strings: why no token begins here
};

constexpr std::uint32_t two_characters(char first, char second) {
  return static_cast<std::uint32_t>(first) << 8 | static_cast<std::uint32_t>(second);
}

struct Token {
  double number = 0.0;
  Word word = 0;
  std::uint32_t jump = 0;  // directives that open or divide a block: the token of the same source
                           // that divides or ends it next; 0: there is none
  std::uint32_t line = 0;
  std::uint16_t column = 0;  // 65535 and beyond are the same
  TokenKind kind = TokenKind::end;

  bool is(char c) const {
    return kind == TokenKind::punctuation && word == static_cast<std::uint32_t>(c);
  }
  bool is(char first, char second) const {
    return kind == TokenKind::punctuation && word == two_characters(first, second);
  }
  bool is(K keyword) const { return kind == TokenKind::word && word == static_cast<Word>(keyword); }
  bool is_directive(K keyword) const {
    return kind == TokenKind::directive && word == static_cast<Word>(keyword);
  }
  bool is_identifier() const {
    return kind == TokenKind::word && word >= static_cast<Word>(K::keyword_count);
  }
  bool is_keyword_word() const { return word < static_cast<Word>(K::keyword_count); }
  bool is_keyword() const {
    return kind == TokenKind::word && word < static_cast<Word>(K::keyword_count);
  }
  // Of a keyword; K::keyword_count for anything else.
  K keyword() const { return is_keyword() ? static_cast<K>(word) : K::keyword_count; }
};

}  // namespace lumivec::pov
