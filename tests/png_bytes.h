// PNG files of any bit depth and colour type, uncompressed, for tests that must know every bit of a
// picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct PngBytes {
  std::string file = std::string("\x89PNG\r\n\x1a\n", 8);

  // color: 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA. rows: packed samples of each row.
  PngBytes(std::uint32_t width, std::uint32_t height, int depth, int color,
           const std::vector<std::vector<std::uint8_t>>& rows, const std::string& palette = {}) {
    std::string header = big(width) + big(height);
    header += {static_cast<char>(depth), static_cast<char>(color), 0, 0, 0};
    chunk("IHDR", header);
    if (!palette.empty()) chunk("PLTE", palette);
    std::string raw;
    for (const auto& row : rows) raw += '\0' + std::string(row.begin(), row.end());
    chunk("IDAT", stored(raw));
    chunk("IEND", "");
  }

 private:
  static std::string big(std::uint32_t x) {
    return {static_cast<char>(x >> 24), static_cast<char>(x >> 16), static_cast<char>(x >> 8),
            static_cast<char>(x)};
  }

  static std::string stored(const std::string& raw) {
    const auto size = static_cast<std::uint16_t>(raw.size());
    const auto inverse = static_cast<std::uint16_t>(~size);
    std::string stream = {'\x78',
                          '\x01',
                          '\x01',
                          static_cast<char>(size),
                          static_cast<char>(size >> 8),
                          static_cast<char>(inverse),
                          static_cast<char>(inverse >> 8)};
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char c : raw) {
      a = (a + static_cast<std::uint8_t>(c)) % 65521;
      b = (b + a) % 65521;
    }
    return stream + raw + big(b << 16 | a);
  }

  void chunk(const std::string& type, const std::string& data) {
    const std::string body = type + data;
    std::uint32_t crc = 0xffffffff;
    for (const char c : body) {
      crc ^= static_cast<std::uint8_t>(c);
      for (int i = 0; i < 8; ++i) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320 : 0);
    }
    file += big(static_cast<std::uint32_t>(data.size())) + body + big(~crc);
  }
};
