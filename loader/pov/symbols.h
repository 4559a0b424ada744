// Identifiers and what they stand for, innermost scope first.
//
// Scopes are dynamic, as the language has them: a macro sees the local identifiers of its callers.
// Each name keeps the stack of its own meanings, so that a look-up costs the same at any depth.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "loader/pov/keywords.h"
#include "loader/pov/value.h"

namespace lumivec::pov {

using Slot = std::shared_ptr<Value>;  // shared with macro parameters that refer to it

class Symbols {
 public:
  Symbols();

  Word intern(std::string_view text);
  std::size_t size() const { return names_.size(); }
  const std::string& text(Word word) const { return names_[word].text; }

  // What the word stands for here; null: nothing.
  const Slot* find(Word word) const {
    const auto& meanings = names_[word].meanings;
    return meanings.empty() ? nullptr : &meanings.back().slot;
  }

  // Scope 0 is the global one.
  void open_scope();
  void close_scope();

  // #declare: gives the innermost meaning of the word a new value, or makes a global one.
  Slot declare(Word word, Value value);
  // #local: the same in the innermost scope.
  Slot declare_local(Word word, Value value);
  // Makes the word stand for slot in the innermost scope: a macro parameter.
  void bind(Word word, Slot slot);
  // Forgets the innermost meaning; false: there is none.
  bool undefine(Word word);

  // A known name that is like an unknown one; empty: there is none.
  std::string like(Word unknown) const;

 private:
  struct Meaning {
    Slot slot;
    std::size_t scope = 0;
  };
  struct Name {
    std::string text;
    std::vector<Meaning> meanings;
  };
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const {
      return std::hash<std::string_view>()(text);
    }
  };

  std::vector<Name> names_;
  std::unordered_map<std::string, Word, Hash, std::equal_to<>> words_;
  std::vector<Word> locals_;               // of all open scopes, in the order of their making
  std::vector<std::size_t> scope_begins_;  // indices into locals_
};

}  // namespace lumivec::pov
