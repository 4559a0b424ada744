#include "loader/gltf/container.h"

#include <array>

namespace lumivec::gltf {
namespace {

constexpr std::uint32_t magic = 0x46546C67;       // "glTF"
constexpr std::uint32_t json_chunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t bin_chunk = 0x004E4942;   // "BIN\0"
constexpr std::uint64_t header_size = 12;
constexpr std::uint64_t chunk_header_size = 8;

std::uint32_t little_endian(const ByteSource& file, std::uint64_t offset) {
  std::array<std::uint8_t, 4> b{};
  file.read(offset, b.data(), b.size());
  return std::uint32_t{b[0]} | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 |
         std::uint32_t{b[3]} << 24;
}

std::string text(Context& context, const ByteSource& part) {
  context.claim(part.size(), "");
  std::string json(part.size(), '\0');
  part.read(0, json.data(), json.size());
  return json;
}

std::string at_byte(std::uint64_t offset) {
  return "byte " + std::to_string(offset);
}

}  // namespace

Container read_container(Context& context, const ByteSource& file) {
  Container container;
  if (file.size() < 4 || little_endian(file, 0) != magic) {
    container.json = text(context, file);
    return container;
  }
  container.binary = true;
  if (file.size() < header_size + chunk_header_size) {
    context.fail("", "binary glTF cut off inside its header", "fetch the file again");
  }
  const std::uint32_t version = little_endian(file, 4);
  if (version != 2) {
    context.fail(at_byte(4), "binary glTF version " + std::to_string(version) + " is not supported",
                 "convert the file to glTF 2.0");
  }
  const std::uint64_t length = little_endian(file, 8);
  if (length > file.size() || length < header_size) {
    context.fail(at_byte(8),
                 "header says " + std::to_string(length) + " bytes, but the file has " +
                     std::to_string(file.size()),
                 "fetch the file again");
  }
  bool has_json = false;
  for (std::uint64_t offset = header_size; offset < length;) {
    if (length - offset < chunk_header_size) {
      context.fail(at_byte(offset), "chunk header cut off", "fetch the file again");
    }
    const std::uint64_t size = little_endian(file, offset);
    const std::uint32_t type = little_endian(file, offset + 4);
    const std::uint64_t begin = offset + chunk_header_size;
    if (size > length - begin) {
      context.fail(at_byte(offset),
                   "chunk of " + std::to_string(size) + " bytes, but only " +
                       std::to_string(length - begin) + " are left",
                   "fetch the file again");
    }
    if (!has_json) {
      if (type != json_chunk) context.fail(at_byte(offset), "the first chunk is not JSON");
      container.json = text(context, file.slice(begin, size));
      has_json = true;
    } else if (type == json_chunk || (type == bin_chunk && container.chunk)) {
      context.fail(at_byte(offset), "more than one chunk of the same type");
    } else if (type == bin_chunk) {
      container.chunk = file.slice(begin, size);
    }
    offset = begin + size;
  }
  return container;
}

}  // namespace lumivec::gltf
