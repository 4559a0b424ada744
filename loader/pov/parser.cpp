#include "loader/pov/parser.h"

#include <algorithm>

#include "loader/error.h"
#include "loader/pov/directives.h"
#include "loader/pov/macros.h"

namespace lumivec::pov {
namespace {

// text with everything that would break a line of output replaced, and cut to a readable length.
std::string printable(std::string_view text) {
  constexpr std::size_t readable = 80;
  std::string line(text.substr(0, readable));
  for (char& c : line) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  if (text.size() > readable) line += "...";
  return line;
}

std::string line_and_column(const Place& place) {
  return "line " + std::to_string(place.line) + ", column " + std::to_string(place.column);
}

}  // namespace

Parser::Parser(const std::filesystem::path& file, std::string_view text,
               const LoadOptions& load_options, LoadReport& load_report)
    : options(load_options), report(load_report), sources(file, load_options) {
  const std::uint32_t source = sources.add(file.string(), {}, text, symbols, options.max_bytes);
  claimed_ = std::min(sources.bytes(), options.max_bytes);
  token_ = sources[source].text.tokens.data();
  push(source, 0, static_cast<std::uint32_t>(sources[source].text.tokens.size() - 1), nullptr, {});
}

// ---- tokens
// ---------------------------------------------------------------------------------------

void Parser::fetch() {
  for (;;) {
    Frame& current = frames_.back();
    token_source_ = current.source;
    if (current.next == current.end) {
      if (end_frame()) continue;
      token_ = current.end;
      break;
    }
    token_ = current.next++;
    if (token_->kind == TokenKind::directive) {
      obey_directive(*this);
      if (fetched_) return;  // what the directive looked at and did not take
      continue;
    }
    if (token_->kind == TokenKind::invalid)
      fail(sources[current.source].text.strings[token_->word]);
    if (token_->is_identifier()) {
      const Slot* slot = symbols.find(token_->word);
      if (slot && (*slot)->kind == ValueKind::macro) {
        call_macro(*this, (*slot)->share<Macro>());
        if (fetched_) return;
        continue;
      }
    }
    break;
  }
  fetched_ = true;
}

bool Parser::end_frame() {
  if (const Block* block = innermost_block())
    fail_at(block->place, "the block that begins here has no #end");
  if (frames_.size() == 1) return false;
  symbols.close_scope();
  frames_.pop_back();
  return true;
}

void Parser::push(std::uint32_t source, std::uint32_t begin, std::uint32_t end,
                  std::shared_ptr<const Macro> macro, const Place& called_at) {
  if (frames_.size() > options.language.max_macro_depth) {
    fail("macros and includes are more than " + std::to_string(options.language.max_macro_depth) +
             " deep",
         "end the recursion, or raise the bound by --max-recursion");
  }
  Frame& frame = frames_.emplace_back();
  frame.source = source;
  frame.begin = sources[source].text.tokens.data();
  frame.next = frame.begin + begin;
  frame.end = frame.begin + end;
  frame.macro = std::move(macro);
  frame.called_at = called_at;
  frame.first_block = blocks_.size();
  frame.number = ++opened_;
}

Block& Parser::open_block(BlockKind kind) {
  Block& block = blocks_.emplace_back();
  block.kind = kind;
  block.number = ++opened_;
  block.place = place();
  return block;
}

Block* Parser::innermost_block() {
  return blocks_.size() > frames_.back().first_block ? &blocks_.back() : nullptr;
}

void Parser::expect(char c, std::string_view construct) {
  if (accept(c)) return;
  fail_expected("'" + std::string(1, c) + "' of " + std::string(construct));
}

const std::string& Parser::string_of(const Token& token) const {
  return sources[token_source_].text.strings[token.word];
}

const Token& Parser::raw_peek(std::size_t ahead) const {
  const Frame& current = frames_.back();
  const auto left = static_cast<std::size_t>(current.end - current.next);
  return current.next[std::min(ahead, left)];
}

const Token& Parser::raw_take() {
  Frame& current = frames_.back();
  token_source_ = current.source;
  token_ = current.next;
  if (current.next < current.end) ++current.next;
  if (token_->kind == TokenKind::invalid) fail(sources[current.source].text.strings[token_->word]);
  return *token_;
}

// ---- bounds
// ---------------------------------------------------------------------------------------

void Parser::count_step() {
  count_steps(1);
}

void Parser::count_steps(std::uint64_t count) {
  if (count <= steps_left()) {
    steps_ += count;
    return;
  }
  fail("the scene takes more than " + std::to_string(options.language.max_steps) +
           " steps of loops and macros",
       "end the loop, or raise the bound by --max-steps");
}

void Parser::claim(std::uint64_t bytes) {
  if (bytes <= options.max_bytes && claimed_ <= options.max_bytes - bytes) {
    claimed_ += bytes;
    return;
  }
  fail("needs " + std::to_string(bytes) + " bytes, after " + std::to_string(claimed_) +
           ", and would pass the limit of " + std::to_string(options.max_bytes),
       "raise it by --max-bytes if the scene is trusted");
}

void Parser::contain(Measure& whole, const Measure& part, std::uint64_t most) const {
  whole.depth = std::max(whole.depth, part.depth + 1);
  if (whole.depth > options.language.max_depth) {
    fail("declared things hold each other more than " + std::to_string(options.language.max_depth) +
             " deep",
         "put what a loop makes side by side, or raise the bound by --max-chain");
  }
  most = std::min(most, options.language.max_parts);
  // Each part was within the bound, so that sums cannot wrap.
  whole.count += part.count;
  if (whole.count <= most) return;
  fail("something is made of more than " + std::to_string(most) + " parts",
       most == options.language.max_parts ? "raise the bound by --max-parts if the scene is trusted"
                                          : "use fewer");
}

Nesting::Nesting(Parser& parser) : parser_(parser) {
  if (++parser_.nesting <= parser_.options.language.max_nesting) return;
  --parser_.nesting;
  parser_.fail("blocks and brackets are more than " +
                   std::to_string(parser_.options.language.max_nesting) + " deep",
               "nest less, or raise the bound by --max-nesting");
}

// ---- complaints
// -----------------------------------------------------------------------------------

std::string Parser::place_text(const Place& place) const {
  return sources[place.file].name + ": " + line_and_column(place);
}

std::string Parser::stack_text() const {
  constexpr std::size_t told = 8;  // of the innermost frames
  std::string text;
  std::size_t count = 0;
  for (std::size_t i = frames_.size(); i-- > 1;) {
    if (++count > told) {
      return text + ", and " + std::to_string(i) + " more";
    }
    const Frame& inner = frames_[i];
    text += inner.macro ? ", in macro " + printable(symbols.text(inner.macro->name)) + " called at "
                        : ", in " + printable(sources[inner.source].name) + " included at ";
    text += sources[inner.called_at.file].name + ":" + std::to_string(inner.called_at.line) + ":" +
            std::to_string(inner.called_at.column);
  }
  return text;
}

void Parser::fail_at(const Place& at_place, const std::string& problem,
                     const std::string& remedy) const {
  throw SceneError(sources[at_place.file].name, line_and_column(at_place) + stack_text(), problem,
                   remedy.empty() ? "correct the scene" : remedy);
}

void Parser::fail(const std::string& problem, const std::string& remedy) const {
  fail_at(place(), problem, remedy);
}

void Parser::fail_expected(std::string_view wanted) {
  const Token& found = peek();
  if (found.is_identifier() && !symbols.find(found.word)) {
    const std::string like = symbols.like(found.word);
    fail("'" + printable(symbols.text(found.word)) + "' is not declared",
         like.empty() ? "declare it, or include the file that does" : "did you mean " + like + "?");
  }
  fail(std::string(wanted) + " is expected, but " + describe(found) + " is found");
}

std::string Parser::describe(const Token& token) const {
  switch (token.kind) {
    case TokenKind::end:
      return "the end of the file";
    case TokenKind::number:
      return "a number";
    case TokenKind::string:
      return "a string";
    case TokenKind::directive:
      return "#" + symbols.text(token.word);
    case TokenKind::word: {
      const std::string name = "'" + printable(symbols.text(token.word)) + "'";
      const Slot* slot = meaning(token);
      return slot ? name + ", " + kind_name((*slot)->kind) + "," : name;
    }
    case TokenKind::punctuation: {
      std::string text(1, '\'');
      if (token.word > 0xff) text += static_cast<char>(token.word >> 8);
      text += static_cast<char>(token.word & 0xff);
      return text + '\'';
    }
    case TokenKind::invalid:
      break;
  }
  return "something else";
}

void Parser::mention(const Place& at_place, const std::string& what) {
  // Texts may come from the scene, and could be as many as a loop makes.
  constexpr std::size_t most_texts = 1000;
  const auto known = mentioned.find(what);
  if (known != mentioned.end()) {
    ++known->second;
  } else if (mentioned.size() < most_texts) {
    mentioned.emplace(what, 1);
    scene.mentions.push_back({at_place, what});
  }
}

}  // namespace lumivec::pov
