#include "viewer/suggestion.h"

#include <algorithm>
#include <cctype>

namespace lumivec {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the table: the swap of neighbours looks two rows back.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

std::optional<std::string> closest(std::string_view word,
                                   const std::vector<std::string>& candidates) {
  constexpr std::size_t letters_per_edit = 3;
  constexpr std::size_t shortest_beginning = 3;
  const std::string wanted = lower(word);
  std::optional<std::string> best;
  // Words of one or two letters differ by one edit from too many others.
  std::size_t best_distance = wanted.size() / letters_per_edit + 1;
  for (const std::string& candidate : candidates) {
    const std::string known = lower(candidate);
    std::size_t distance = edit_distance(wanted, known);
    if (wanted.size() >= shortest_beginning && known.starts_with(wanted)) {
      distance = std::min<std::size_t>(distance, 1);
    }
    if (distance < best_distance && distance < known.size()) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t listed = 12;
  if (const auto near = closest(word, candidates)) return "did you mean '" + *near + "'?";
  std::string text = "known are ";
  for (std::size_t i = 0; i < std::min(candidates.size(), listed); ++i) {
    text += (i ? ", " : "") + candidates[i];
  }
  if (candidates.size() > listed) {
    text += " and " + std::to_string(candidates.size() - listed) + " more";
  }
  return candidates.empty() ? "there is none" : text;
}

}  // namespace lumivec
