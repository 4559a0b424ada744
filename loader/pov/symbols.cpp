#include "loader/pov/symbols.h"

#include <algorithm>
#include <cctype>

namespace lumivec::pov {
namespace {

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

Symbols::Symbols() {
  for (Word k = 0; k < static_cast<Word>(K::keyword_count); ++k)
    intern(keyword_text(static_cast<K>(k)));
}

Word Symbols::intern(std::string_view text) {
  text = usual_spelling(text);
  if (const auto known = words_.find(text); known != words_.end()) return known->second;
  const auto word = static_cast<Word>(names_.size());
  names_.push_back({std::string(text), {}});
  words_.emplace(std::string(text), word);
  return word;
}

void Symbols::open_scope() {
  scope_begins_.push_back(locals_.size());
}

void Symbols::close_scope() {
  const std::size_t depth = scope_begins_.size();
  for (std::size_t i = scope_begins_.back(); i < locals_.size(); ++i) {
    auto& meanings = names_[locals_[i]].meanings;
    if (!meanings.empty() && meanings.back().scope == depth) meanings.pop_back();
  }
  locals_.resize(scope_begins_.back());
  scope_begins_.pop_back();
}

Slot Symbols::declare(Word word, Value value) {
  auto& meanings = names_[word].meanings;
  if (meanings.empty()) {
    meanings.push_back({std::make_shared<Value>(std::move(value)), 0});
  } else {
    *meanings.back().slot = std::move(value);
  }
  return meanings.back().slot;
}

Slot Symbols::declare_local(Word word, Value value) {
  auto& meanings = names_[word].meanings;
  if (!meanings.empty() && meanings.back().scope == scope_begins_.size()) {
    *meanings.back().slot = std::move(value);
    return meanings.back().slot;
  }
  Slot slot = std::make_shared<Value>(std::move(value));
  bind(word, slot);
  return slot;
}

void Symbols::bind(Word word, Slot slot) {
  names_[word].meanings.push_back({std::move(slot), scope_begins_.size()});
  if (!scope_begins_.empty()) locals_.push_back(word);
}

bool Symbols::undefine(Word word) {
  auto& meanings = names_[word].meanings;
  if (meanings.empty()) return false;
  meanings.pop_back();
  return true;
}

std::string Symbols::like(Word unknown) const {
  const std::string wanted = lower(names_[unknown].text);
  const auto found = std::find_if(names_.begin(), names_.end(), [&](const Name& name) {
    const bool known =
        &name < names_.data() + static_cast<Word>(K::keyword_count) || !name.meanings.empty();
    return known && lower(name.text) == wanted;
  });
  return found == names_.end() ? "" : found->text;
}

}  // namespace lumivec::pov
