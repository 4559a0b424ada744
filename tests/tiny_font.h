// A TrueType font of one letter, for tests that must know its outline: "A" is a square from (0.1,
// 0) to (0.9, 0.8) with a square hole from (0.3, 0.2) to (0.7, 0.6), and 1 wide; all else is empty.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

inline std::string big16(std::initializer_list<int> numbers) {
  std::string bytes;
  for (const int n : numbers) {
    bytes += static_cast<char>(n >> 8);
    bytes += static_cast<char>(n);
  }
  return bytes;
}

inline std::string big32(std::uint32_t n) {
  return big16({static_cast<int>(n >> 16), static_cast<int>(n & 0xffff)});
}

inline std::string tiny_font() {
  // Two contours of four corners: their ends, no instructions, flags "on the curve", then steps.
  std::string glyph = big16({2, 100, 0, 900, 800, 3, 7, 0}) + std::string(8, '\1');
  glyph += big16({100, 800, 0, -800, 200, 0, 400, 0});  // x, each from the one before
  glyph += big16({0, 0, 800, 0, -600, 400, 0, -400});   // y
  if (glyph.size() % 2) glyph += '\0';
  const auto in_words = static_cast<int>(glyph.size() / 2);
  const std::vector<std::pair<std::string, std::string>> tables = {
      {"cmap", big16({0, 1, 3, 1}) + big32(12) +
                   big16({4, 32, 0, 4, 4, 1, 0, 65, 0xffff, 0, 65, 0xffff, -64, 1, 0, 0})},
      {"glyf", glyph},
      {"head", big16({1, 0, 1, 0}) + big32(0) + big32(0x5f0f3cf5) + big16({0, 1000}) +
                   std::string(16, '\0') + big16({100, 0, 900, 800, 0, 8, 2, 0, 0})},
      {"hhea", big16({1, 0, 800, -200, 0, 1000, 0, 0, 900, 1, 0, 0, 0, 0, 0, 0, 0, 2})},
      {"hmtx", big16({1000, 0, 1000, 100})},
      {"loca", big16({0, 0, in_words})},
      {"maxp", big16({1, 0, 2, 8, 2, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0})}};
  std::string font = big16({1, 0, static_cast<int>(tables.size()), 64, 2, 48}), body;
  const std::size_t start = 12 + 16 * tables.size();
  for (const auto& [name, data] : tables) {
    font += name + big32(0) + big32(static_cast<std::uint32_t>(start + body.size())) +
            big32(static_cast<std::uint32_t>(data.size()));
    body += data + std::string((4 - data.size() % 4) % 4, '\0');
  }
  return font + body;
}
