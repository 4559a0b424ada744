#include "loader/pov/conditions.h"

#include <cmath>

#include "loader/pov/expression.h"

namespace lumivec::pov {
namespace {

const Token& token_at(Parser& parser, std::uint32_t index) {
  return parser.frame().begin[index];
}

// What a directive asks in parentheses must end where it begins: macros that are called there could
// bring a parenthesis or #end of their own.
class Head {
 public:
  explicit Head(Parser& parser) : parser_(parser), frame_(parser.frame().number), block_(block()) {}

  void check_end() const {
    if (parser_.frame().number == frame_ && block() == block_) return;
    parser_.fail(
        "the parentheses of a directive end in another macro, file or block than they begin in",
        "close them, and all blocks within, where they are opened");
  }

 private:
  std::uint64_t block() const {
    const Block* block = parser_.innermost_block();
    return block ? block->number : 0;
  }

  Parser& parser_;
  std::uint64_t frame_;
  std::uint64_t block_;
};

// The directive that divides or ends the block next.
std::uint32_t next_divider(Parser& parser, std::uint32_t index) {
  const std::uint32_t next = token_at(parser, index).jump;
  if (next == 0) {
    const Token& token = token_at(parser, index);
    parser.fail("the block of #" + parser.symbols.text(token.word) + " has no #end");
  }
  return next;
}

std::uint32_t end_of_block(Parser& parser, std::uint32_t index) {
  do {
    index = next_divider(parser, index);
  } while (!token_at(parser, index).is_directive(K::end_));
  return index;
}

void open(Parser& parser, BlockKind kind, std::uint32_t index) {
  Block& block = parser.open_block(kind);
  block.directive = index;
  block.begin = index + 1;
}

bool in_parentheses(Parser& parser, std::string_view construct) {
  const Head head(parser);
  parser.expect('(', construct);
  const bool holds = parse_condition(parser) != 0.0;
  parser.expect(')', construct);
  head.check_end();
  return holds;
}

// #ifdef (NAME), also of an array's element.
bool is_defined(Parser& parser) {
  const Head head(parser);
  if (!parser.raw_take().is('(')) parser.fail("'(' is expected after #ifdef and #ifndef");
  const bool defined = parse_defined(parser);
  parser.expect(')', "#ifdef");
  head.check_end();
  return defined;
}

// Goes behind the block's next divider from index on. Null: it was the block's end or #else, behind
// which reading goes on.
const Token* next_branch(Parser& parser, std::uint32_t& index) {
  index = next_divider(parser, index);
  parser.frame().go_to(index + 1);
  const Token& token = token_at(parser, index);
  if (token.is_directive(K::end_)) parser.pop_block();
  return token.is_directive(K::end_) || token.is_directive(K::else_) ? nullptr : &token;
}

// Skips branches from index on until one whose condition holds.
void find_branch(Parser& parser, std::uint32_t index) {
  while (next_branch(parser, index)) {
    if (in_parentheses(parser, "#elseif")) return;
  }
}

void leave_block(Parser& parser) {
  parser.frame().go_to(end_of_block(parser, parser.innermost_block()->directive) + 1);
  parser.pop_block();
}

bool for_goes_on(const Block& block) {
  // The last value is met although steps such as 0.1 add up inexactly.
  const double slack = 1e-9 * std::abs(block.step);
  const double value = block.variable->number.n[0];
  return block.step > 0.0 ? value <= block.last + slack : value >= block.last - slack;
}

}  // namespace

void begin_condition(Parser& parser, std::uint32_t index) {
  const Token& token = parser.raw_current();
  open(parser, BlockKind::condition, index);
  const bool holds = token.is_directive(K::if_)      ? in_parentheses(parser, "#if")
                     : token.is_directive(K::ifdef_) ? is_defined(parser)
                                                     : !is_defined(parser);
  if (!holds) find_branch(parser, index);
}

void end_branch(Parser& parser) {
  const Block* block = parser.innermost_block();
  if (!block) parser.fail("#else is in no block that it could divide");
  // Cases without #break run into the default one.
  if (block->kind == BlockKind::choice) return;
  leave_block(parser);
}

void begin_choice(Parser& parser, std::uint32_t index) {
  open(parser, BlockKind::choice, index);
  const Head head(parser);
  parser.expect('(', "#switch");
  const double chosen = parse_float(parser, "#switch");
  parser.expect(')', "#switch");
  head.check_end();
  constexpr double tolerance = 1e-10;  // of equal floats
  while (const Token* token = next_branch(parser, index)) {
    parser.expect('(', "#case");
    const double low = parse_float(parser, "#case");
    double high = low;
    if (token->is_directive(K::range_)) {
      parser.accept(',');
      high = parse_float(parser, "#range");
    }
    parser.expect(')', "#case");
    head.check_end();
    if (chosen >= low - tolerance && chosen <= high + tolerance) return;
  }
}

void pass_case(Parser& parser, std::uint32_t index) {
  const Block* block = parser.innermost_block();
  if (!block || block->kind != BlockKind::choice) {
    parser.fail("#" + parser.symbols.text(token_at(parser, index).word) + " is in no #switch");
  }
  parser.expect('(', "#case");
  parse_float(parser, "#case");
  if (parser.accept(',')) parse_float(parser, "#range");
  parser.expect(')', "#case");
}

void begin_while(Parser& parser, std::uint32_t index) {
  open(parser, BlockKind::while_loop, index);
  if (!in_parentheses(parser, "#while")) leave_block(parser);
}

void begin_for(Parser& parser, std::uint32_t index) {
  open(parser, BlockKind::for_loop, index);
  const Head head(parser);
  if (!parser.raw_take().is('(')) parser.fail("'(' is expected after #for");
  const Token& name = parser.raw_take();
  if (!name.is_identifier()) {
    parser.fail("#for needs a name of its own, but " + parser.describe(name) + " is found");
  }
  parser.expect(',', "#for");
  const double first = parse_float(parser, "#for");
  parser.expect(',', "#for");
  const double last = parse_float(parser, "#for");
  const double step = parser.accept(',') ? parse_float(parser, "#for") : 1.0;
  parser.expect(')', "#for");
  head.check_end();
  if (step == 0.0) parser.fail("the step of #for is 0");
  Block& block = *parser.innermost_block();
  block.begin = parser.frame().position();
  block.last = last;
  block.step = step;
  block.variable = parser.symbols.declare_local(name.word, Number(first));
  if (!for_goes_on(block)) leave_block(parser);
}

void break_block(Parser& parser) {
  const Block* block = parser.innermost_block();
  while (block && block->kind == BlockKind::condition) {
    parser.pop_block();
    block = parser.innermost_block();
  }
  if (!block) parser.fail("#break is in no #while, #for or #switch");
  leave_block(parser);
}

void end_block(Parser& parser) {
  if (!parser.innermost_block()) parser.fail("#end ends no block");
  Block& block = *parser.innermost_block();
  switch (block.kind) {
    case BlockKind::condition:
    case BlockKind::choice:
      return parser.pop_block();
    case BlockKind::while_loop: {
      const std::uint32_t after = parser.frame().position();
      parser.frame().go_to(block.begin);
      if (!in_parentheses(parser, "#while")) {
        parser.frame().go_to(after);
        parser.pop_block();
      }
      return;
    }
    case BlockKind::for_loop:
      block.variable->kind = ValueKind::number;
      block.variable->number = Number(block.variable->number.n[0] + block.step);
      if (for_goes_on(block)) {
        parser.frame().go_to(block.begin);
      } else {
        parser.pop_block();
      }
      return;
  }
}

}  // namespace lumivec::pov
