// Where the tokens come from: the scene, a file it includes, or a macro that runs.
#pragma once

#include <memory>
#include <vector>

#include "loader/pov/token.h"
#include "loader/pov/value.h"

namespace lumivec::pov {

enum class BlockKind : std::uint8_t { condition, while_loop, for_loop, choice };

// A block that is being obeyed.
struct Block {
  BlockKind kind = BlockKind::condition;
  std::uint64_t number = 0;  // no other block has it
  std::uint32_t begin = 0;   // loops: the token after #while or #for's head
  std::uint32_t directive = 0;
  Place place;
  std::shared_ptr<Value> variable;  // of #for
  double last = 0.0;
  double step = 1.0;
};

struct Frame {
  std::uint32_t source = 0;
  const Token* begin = nullptr;  // of the source's tokens
  const Token* next = nullptr;
  const Token* end = nullptr;          // where the frame ends; always a token that can be read
  std::shared_ptr<const Macro> macro;  // null: a file
  Place called_at;
  std::size_t first_block = 0;  // among those of all frames
  std::uint64_t number = 0;     // no other frame has it

  std::uint32_t position() const { return static_cast<std::uint32_t>(next - begin); }
  void go_to(std::uint32_t position) { next = begin + position; }
};

}  // namespace lumivec::pov
