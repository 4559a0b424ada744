#include "loader/gltf/uri.h"

#include <array>
#include <cctype>
#include <string>

namespace lumivec::gltf {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view data_scheme = "data:";

// "http" of "http://…"; empty for a relative reference (RFC 3986, section 3.1).
std::string scheme_of(std::string_view uri) {
  std::string scheme;
  for (const char c : uri) {
    if (c == ':') return scheme;
    const auto u = static_cast<unsigned char>(c);
    const bool allowed =
        scheme.empty() ? std::isalpha(u) != 0 : std::isalnum(u) || c == '+' || c == '-' || c == '.';
    if (!allowed) return {};
    scheme += static_cast<char>(std::tolower(u));
  }
  return {};
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string percent_decoded(std::string_view text) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size()) {
      const int high = hex_digit(text[i + 1]);
      const int low = hex_digit(text[i + 2]);
      if (high >= 0 && low >= 0) {
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
        continue;
      }
    }
    decoded += text[i];
  }
  return decoded;
}

constexpr std::array<std::int8_t, 256> base64_values = [] {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::int8_t, 256> values{};
  values.fill(-1);
  for (std::size_t i = 0; i < digits.size(); ++i) {
    values[static_cast<unsigned char>(digits[i])] = static_cast<std::int8_t>(i);
  }
  values['-'] = 62;  // the URL-safe alphabet of RFC 4648, section 5
  values['_'] = 63;
  return values;
}();

std::optional<std::vector<std::uint8_t>> base64_decoded(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t group = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    if (std::isspace(static_cast<unsigned char>(c))) continue;
    const int value = base64_values[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    group = group << 6 | static_cast<std::uint32_t>(value);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes.push_back(static_cast<std::uint8_t>(group >> bits));
    }
  }
  return bytes;
}

bool lies_inside(const fs::path& file, const fs::path& folder) {
  const fs::path relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

}  // namespace

bool is_data_uri(std::string_view uri) {
  return scheme_of(uri.substr(0, 16)) == "data";
}

std::optional<std::vector<std::uint8_t>> decode_data_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string_view header = uri.substr(data_scheme.size(), comma - data_scheme.size());
  const std::string_view body = uri.substr(comma + 1);
  if (header.ends_with(";base64")) {
    if (body.find('%') == std::string_view::npos) return base64_decoded(body);
    return base64_decoded(percent_decoded(body));
  }
  const std::string decoded = percent_decoded(body);
  return std::vector<std::uint8_t>(decoded.begin(), decoded.end());
}

bool is_remote_uri(std::string_view uri) {
  const std::string scheme = scheme_of(uri);
  return !scheme.empty() && scheme != "file" && scheme != "data";
}

std::optional<fs::path> find_file(const Context& context, std::string_view where,
                                  std::string_view uri) {
  std::string_view path = uri;
  if (scheme_of(uri) == "file") {
    path.remove_prefix(std::string_view("file:").size());
    if (path.starts_with("//")) path.remove_prefix(2);
    if (path.starts_with("localhost/")) path.remove_prefix(std::string_view("localhost").size());
  }
  // Some exporters forget to encode: the literal name is tried where the decoded one does not
  // exist.
  for (const std::string& name : {percent_decoded(path), std::string(path)}) {
    if (name.empty() || name.find('\0') != std::string::npos) continue;
    std::error_code error;
    const fs::path file = fs::weakly_canonical(context.folder / name, error);
    if (error) continue;
    if (!context.options.allow_outside_files && !lies_inside(file, context.folder)) {
      context.fail(where,
                   "file " + printable(name) + " lies outside the scene's folder and is not read",
                   "allow outside files if the scene is trusted");
    }
    if (fs::exists(file, error)) return file;
  }
  return std::nullopt;
}

}  // namespace lumivec::gltf
