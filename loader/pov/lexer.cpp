#include "loader/pov/lexer.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "loader/pov/blocks.h"

namespace lumivec::pov {
namespace {

constexpr std::uint16_t last_column = std::numeric_limits<std::uint16_t>::max();

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r') || c == '\x1a';  // 1A ends files of DOS
}

class Lexer {
 public:
  Lexer(std::string_view text, Symbols& symbols, std::uint64_t most_bytes)
      : text_(text), symbols_(symbols), most_bytes_(most_bytes) {}

  TokenText run() {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = line_begin_ = 3;
    do {
      next();
      if (bytes() <= most_bytes_) continue;
      invalid(
          "the text takes more memory than the limit on bytes leaves; it is raised by --max-bytes");
      add(TokenKind::end, 0);
    } while (out_.tokens.back().kind != TokenKind::end);
    link_blocks(out_.tokens);
    return std::move(out_);
  }

 private:
  char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }

  // A name takes a place in two tables besides its letters.
  std::uint64_t bytes() const {
    constexpr std::uint64_t bytes_of_name = 192;
    const std::uint64_t names = symbols_.size() - names_before_;
    return out_.tokens.size() * sizeof(Token) + string_bytes_ + names * bytes_of_name;
  }

  void new_line() {
    ++line_;
    line_begin_ = at_;
  }

  Token& add(TokenKind kind, Word word) {
    Token token;
    token.kind = kind;
    token.word = word;
    token.line = token_line_;
    token.column = token_column_;
    return out_.tokens.emplace_back(token);
  }

  void invalid(std::string why) {
    add(TokenKind::invalid, static_cast<Word>(out_.strings.size()));
    out_.strings.push_back(std::move(why));
  }

  void begin_token() {
    token_line_ = line_;
    token_column_ =
        static_cast<std::uint16_t>(std::min<std::size_t>(at_ - line_begin_ + 1, last_column));
  }

  // False: a comment does not end, and became an invalid token.
  bool skip_space() {
    while (at_ < text_.size()) {
      if (is_space(text_[at_])) {
        if (text_[at_++] == '\n') new_line();
      } else if (peek() == '/' && peek(1) == '/') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (peek() == '/' && peek(1) == '*') {
        begin_token();
        if (!skip_block_comment()) {
          invalid("the comment has no end");
          return false;
        }
      } else {
        break;
      }
    }
    return true;
  }

  bool skip_block_comment() {
    int depth = 0;
    while (at_ < text_.size()) {
      if (peek() == '/' && peek(1) == '*') {
        ++depth;
        at_ += 2;
      } else if (peek() == '*' && peek(1) == '/') {
        at_ += 2;
        if (--depth == 0) return true;
      } else if (text_[at_++] == '\n') {
        new_line();
      }
    }
    return false;
  }

  void next() {
    if (!skip_space()) return;
    begin_token();
    if (at_ >= text_.size()) {
      add(TokenKind::end, 0);
    } else if (is_letter(peek())) {
      add(TokenKind::word, word());
    } else if (is_digit(peek()) || (peek() == '.' && is_digit(peek(1)))) {
      number();
    } else if (peek() == '"') {
      string();
    } else if (peek() == '#') {
      directive();
    } else {
      punctuation();
    }
  }

  Word word() {
    const std::size_t begin = at_;
    while (is_letter(peek()) || is_digit(peek())) ++at_;
    return symbols_.intern(text_.substr(begin, at_ - begin));
  }

  void number() {
    double value = 0.0;
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    const std::string digits(begin, end);
    at_ += digits.size();
    // What is too small for a double is nothing; what is too large is a mistake.
    if (error == std::errc::result_out_of_range) value = std::strtod(digits.c_str(), nullptr);
    if (!std::isfinite(value)) {
      invalid("the number " + digits.substr(0, 40) + " is out of range");
    } else {
      add(TokenKind::number, 0).number = value;
    }
  }

  void string() {
    const std::size_t begin = ++at_;
    bool escaped = false;
    while (at_ < text_.size() && (escaped || text_[at_] != '"')) {
      escaped = !escaped && text_[at_] == '\\';
      if (text_[at_++] == '\n') new_line();
    }
    if (at_ >= text_.size()) return invalid("the string has no closing quote");
    add(TokenKind::string, static_cast<Word>(out_.strings.size()));
    out_.strings.emplace_back(text_.substr(begin, at_ - begin));
    string_bytes_ += sizeof(std::string) + out_.strings.back().size();
    ++at_;
  }

  void directive() {
    ++at_;
    while (peek() == ' ' || peek() == '\t') ++at_;
    if (!is_letter(peek())) return invalid("# is followed by no directive");
    add(TokenKind::directive, word());
  }

  void punctuation() {
    const char c = text_[at_++];
    if ((c == '<' || c == '>' || c == '!') && peek() == '=') {
      ++at_;
      add(TokenKind::punctuation, two_characters(c, '='));
    } else if (std::string_view("(){}[]<>,;:.+-*/=!&|?").find(c) != std::string_view::npos) {
      add(TokenKind::punctuation, static_cast<Word>(c));
    } else if (c > ' ' && c < '\x7f') {
      invalid(std::string("the character '") + c + "' means nothing here");
    } else {
      invalid("the byte " + std::to_string(static_cast<unsigned char>(c)) +
              " is no character of the scene language");
    }
  }

  std::string_view text_;
  Symbols& symbols_;
  TokenText out_;
  std::uint64_t most_bytes_;
  std::uint64_t string_bytes_ = 0;
  std::size_t names_before_ = symbols_.size();
  std::size_t at_ = 0;
  std::size_t line_begin_ = 0;
  std::uint32_t line_ = 1;
  std::uint32_t token_line_ = 1;
  std::uint16_t token_column_ = 1;
};

}  // namespace

TokenText lex(std::string_view text, Symbols& symbols, std::uint64_t most_bytes) {
  return Lexer(text, symbols, most_bytes).run();
}

}  // namespace lumivec::pov
