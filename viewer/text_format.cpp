#include "viewer/text_format.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace lumivec {

std::string format_number(double value, int significant) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.*g", significant, value);
  return text.data();
}

std::string format_fixed(double value, int decimals) {
  std::array<char, 384> text{};  // the largest double has 309 digits before the point
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string format_duration(double seconds) {
  constexpr double longest = 1e9;
  if (!(seconds >= 0.0) || seconds > longest) return "?";
  if (seconds > 0.0 && seconds < 0.0995) return format_number(seconds * 1e3, 2) + " ms";
  if (seconds < 9.995) return format_fixed(seconds, 2) + " s";
  if (seconds < 59.95) return format_fixed(seconds, 1) + " s";
  const auto whole = static_cast<long long>(std::llround(seconds));
  std::array<char, 64> text{};
  if (whole < 3600) {
    std::snprintf(text.data(), text.size(), "%lld:%02lld", whole / 60, whole % 60);
  } else {
    std::snprintf(text.data(), text.size(), "%lld:%02lld:%02lld", whole / 3600, whole / 60 % 60,
                  whole % 60);
  }
  return text.data();
}

std::string format_bytes(std::uint64_t bytes) {
  constexpr std::array<const char*, 6> units = {"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
  if (bytes < 1024) return std::to_string(bytes) + " B";
  double value = double(bytes);
  std::size_t unit = 0;
  while (value >= 1023.95 && unit + 1 < units.size()) {
    value /= 1024.0;
    ++unit;
  }
  return format_fixed(value, 1) + " " + units[unit];
}

std::string format_count(std::uint64_t count) {
  std::string digits = std::to_string(count);
  for (auto place = std::ptrdiff_t(digits.size()) - 3; place > 0; place -= 3) {
    digits.insert(std::size_t(place), 1, ',');
  }
  return digits;
}

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

}  // namespace lumivec
