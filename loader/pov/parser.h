// The state of reading a scene: the stream of tokens with directives obeyed and macros expanded,
// the identifiers, the bounds, and where to complain. The parts of the grammar are functions over
// it.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "loader/load_scene.h"
#include "loader/pov/frames.h"
#include "loader/pov/pov_scene.h"
#include "loader/pov/sources.h"
#include "loader/pov/symbols.h"

namespace lumivec::pov {

class Parser {
 public:
  // file names the scene in errors, and its folder bounds what is read.
  Parser(const std::filesystem::path& file, std::string_view text, const LoadOptions& options,
         LoadReport& report);

  // ---- tokens, after directives and macros
  // -------------------------------------------------------
  const Token& peek() {
    if (!fetched_) fetch();
    return *token_;
  }
  // Tokens live as long as the parser.
  const Token& take() {
    const Token& token = peek();
    fetched_ = false;
    return token;
  }
  bool at(char c) { return peek().is(c); }
  bool at(K keyword) { return peek().is(keyword); }
  bool accept(char c) {
    if (!at(c)) return false;
    fetched_ = false;
    return true;
  }
  bool accept(K keyword) {
    if (!at(keyword)) return false;
    fetched_ = false;
    return true;
  }
  bool has_peeked() const { return fetched_; }
  // The same of the token as it is written, which does not obey a directive that follows.
  bool next_is(char c) const { return fetched_ ? token_->is(c) : raw_peek().is(c); }
  bool next_is_word(K keyword) const {
    return fetched_ ? token_->is(keyword) : raw_peek().is(keyword);
  }
  // construct: what needs it, for the error: "a sphere".
  void expect(char c, std::string_view construct);
  const std::string& string_of(const Token& token) const;
  // What the identifier at hand stands for; null: it is none, or stands for nothing.
  const Slot* meaning(const Token& token) const {
    return token.is_identifier() ? symbols.find(token.word) : nullptr;
  }

  // ---- tokens as they are written, which directives need
  // ----------------------------------------- They may follow a taken token, not one that was
  // peeked at.
  const Token& raw_peek(std::size_t ahead = 0) const;
  const Token& raw_take();
  const Token& raw_current() const { return *token_; }  // the last one

  // ---- running ----------------------------------------------------------------------------------
  Frame& frame() { return frames_.back(); }
  // The tokens [begin, end) of a source come next. macro: null for a file.
  void push(std::uint32_t source, std::uint32_t begin, std::uint32_t end,
            std::shared_ptr<const Macro> macro, const Place& called_at);
  // The blocks of the frame at hand that are open.
  Block& open_block(BlockKind kind);
  Block* innermost_block();  // null: there is none
  void pop_block() { blocks_.pop_back(); }
  void count_step();  // of LanguageLimits::max_steps
  void count_steps(std::uint64_t count);
  std::uint64_t steps_left() const { return options.language.max_steps - steps_; }
  void claim(std::uint64_t bytes);  // of LoadOptions::max_bytes
  std::uint64_t unclaimed() const { return options.max_bytes - claimed_; }
  // Adds a part's measure to that of what holds it. most: bounds the count, besides max_parts.
  void contain(Measure& whole, const Measure& part,
               std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) const;
  std::uint32_t source() const { return token_source_; }  // of the last token

  // ---- complaints -------------------------------------------------------------------------------
  Place place() const { return {token_source_, token_->line, token_->column}; }
  [[noreturn]] void fail(const std::string& problem, const std::string& remedy = {}) const;
  [[noreturn]] void fail_at(const Place& place, const std::string& problem,
                            const std::string& remedy = {}) const;
  // "a number is expected, but '}' is found".
  [[noreturn]] void fail_expected(std::string_view wanted);
  std::string describe(const Token& token) const;
  // Says once for each text that something is not shown as the scene has it.
  void mention(const Place& place, const std::string& what);
  std::string place_text(const Place& place) const;  // "scene.pov: line 3, column 4"

  const LoadOptions& options;
  LoadReport& report;
  Symbols symbols;
  Sources sources;
  PovScene scene;
  std::map<std::string, std::uint32_t, std::less<>> mentioned;  // and how often; bounded
  std::vector<std::uint32_t> random_states;                     // of seed()
  std::uint32_t nesting = 0;
  // Of image maps, by file, the source that names it, its gamma and the scene's.
  std::map<std::tuple<std::string, std::uint32_t, double, double>,
           std::shared_ptr<const MapPicture>>
      pictures;
  std::vector<Slot> arguments;  // of the macro calls that are being read

 private:
  void fetch();
  bool end_frame();  // false: there is no other
  std::string stack_text() const;

  std::vector<Frame> frames_;
  std::vector<Block> blocks_;  // of all frames, the innermost last
  std::uint64_t opened_ = 0;   // frames and blocks so far
  const Token* token_ = nullptr;
  std::uint32_t token_source_ = 0;
  bool fetched_ = false;
  std::uint64_t steps_ = 0;
  std::uint64_t claimed_ = 0;
};

// One block or bracket within another, for as long as it lives.
class Nesting {
 public:
  explicit Nesting(Parser& parser);
  ~Nesting() { --parser_.nesting; }
  Nesting(const Nesting&) = delete;
  Nesting& operator=(const Nesting&) = delete;

 private:
  Parser& parser_;
};

}  // namespace lumivec::pov
