#include "viewer/option_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "viewer/errors.h"
#include "viewer/suggestion.h"
#include "viewer/text_format.h"

namespace lumivec {
namespace {

constexpr std::array<std::pair<std::string_view, PixelFilter>, 4> filters = {
    {{"box", PixelFilter::box},
     {"tent", PixelFilter::tent},
     {"gaussian", PixelFilter::gaussian},
     {"blackman-harris", PixelFilter::blackman_harris}}};

double parse_finite(const std::string& option, const std::string& text) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0.0;
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error == std::errc() && rest == end && std::isfinite(value)) return value;
  throw UsageError(option + ": '" + text + "' is not a " +
                   (error == std::errc::result_out_of_range || (rest == end && begin != end)
                        ? "finite number"
                        : "number"));
}

// Without the digits that only a computer needs: 1e+30 stays as it is, 100 is not 1e+02.
std::string limit_text(double limit) {
  return format_number(limit, 12);
}

[[noreturn]] void out_of_range(const std::string& option, const std::string& text,
                               const std::string& range) {
  throw UsageError(option + ": " + text + " is out of range; give a number " + range);
}

bool is_digits(std::string_view text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

double parse_number(const std::string& option, const std::string& text, double least, double most) {
  const double value = parse_finite(option, text);
  if (value < least || value > most) {
    out_of_range(option, text, "from " + limit_text(least) + " to " + limit_text(most));
  }
  return value;
}

double parse_number_above(const std::string& option, const std::string& text, double least,
                          double most) {
  const double value = parse_finite(option, text);
  if (value <= least || value > most) {
    out_of_range(option, text, "above " + limit_text(least) + ", at most " + limit_text(most));
  }
  return value;
}

std::uint64_t parse_whole(const std::string& option, const std::string& text, std::uint64_t least,
                          std::uint64_t most) {
  const bool is_negative = text.starts_with('-') && is_digits(std::string_view(text).substr(1));
  if (!is_digits(text) && !is_negative) {
    throw UsageError(option + ": '" + text + "' is not a whole number");
  }
  std::uint64_t value = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (is_negative || error != std::errc() || value < least || value > most) {
    out_of_range(option, text, "from " + std::to_string(least) + " to " + std::to_string(most));
  }
  return value;
}

PictureSize parse_size(const std::string& option, const std::string& text) {
  const std::size_t cross = text.find_first_of("xX");
  const std::string width = text.substr(0, cross);
  const std::string height = cross == std::string::npos ? width : text.substr(cross + 1);
  if (!is_digits(width) || !is_digits(height)) {
    throw UsageError(option + ": '" + text +
                     "' is not a size; give WIDTHxHEIGHT in pixels, such as 640x480, or one "
                     "number for a square");
  }
  return {int(parse_whole(option, width, 1, max_picture_side)),
          int(parse_whole(option, height, 1, max_picture_side))};
}

PixelFilter parse_filter(const std::string& option, const std::string& text) {
  std::vector<std::string> known;
  for (const auto& [name, filter] : filters) {
    if (text == name) return filter;
    known.emplace_back(name);
  }
  throw UsageError(option + ": there is no filter '" + text + "'; " + suggestion(text, known));
}

std::string filter_name(PixelFilter filter) {
  for (const auto& [name, value] : filters) {
    if (value == filter) return std::string(name);
  }
  return {};
}

std::uint32_t parse_terms(const std::string& option, const std::string& text) {
  const std::vector<std::string> known(term_names.begin(), term_names.end());
  std::uint32_t terms = 0;
  for (const std::string& name : split(text, ',')) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      throw UsageError(option + ": there is no term '" + name + "'; " + suggestion(name, known));
    }
    const std::uint32_t bit = 1u << (found - known.begin());
    if (terms & bit) throw UsageError(option + ": '" + name + "' is there twice; name it once");
    terms |= bit;
  }
  return terms;
}

std::string terms_text(std::uint32_t terms) {
  std::string text;
  for (std::size_t t = 0; t < term_names.size(); ++t) {
    if (terms >> t & 1u) text += (text.empty() ? "" : ",") + std::string(term_names[t]);
  }
  return text;
}

std::string parse_word(const std::string& option, const std::string& text,
                       const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), text) != known.end()) return text;
  throw UsageError(option + ": there is no '" + text + "'; " + suggestion(text, known));
}

std::pair<std::string, std::string> parse_pair(const std::string& option, const std::string& text) {
  const std::size_t sign = text.find('=');
  if (sign == std::string::npos || sign == 0 || sign + 1 == text.size()) {
    throw UsageError(option + ": '" + text + "' is not of the form NAME=NAME");
  }
  return {text.substr(0, sign), text.substr(sign + 1)};
}

int find_by_name_or_index(const std::string& option, const std::string& text,
                          const std::vector<std::string>& names, const std::string& what) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].empty() && names[i] == text) return int(i);
  }
  if (is_digits(text)) {
    std::size_t index = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error == std::errc() && index < names.size()) return int(index);
    throw UsageError(option + ": there is no " + what + " " + text + "; there are " +
                     std::to_string(names.size()) + ", counted from 0");
  }
  std::vector<std::string> named;
  for (const std::string& name : names) {
    if (!name.empty()) named.push_back(name);
  }
  throw UsageError(option + ": there is no " + what + " '" + text + "'; " +
                   (named.empty() ? "none has a name: give a number from 0 to " +
                                        std::to_string(names.size() - 1)
                                  : suggestion(text, named)));
}

}  // namespace lumivec
