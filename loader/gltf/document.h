// A parsed glTF file: what tinygltf reads of it, and the records of its storage, which are read
// here.
//
// tinygltf copies whole buffers, opens files, cuts integers and refuses accessors without a buffer
// view. So buffers, buffer views, accessors and images are taken out of the JSON before tinygltf
// sees it, and it touches no bytes at all.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "loader/byte_source.h"
#include "loader/gltf/container.h"

namespace lumivec::gltf {

struct Buffer {
  std::optional<std::string> uri;  // none: the binary chunk, or nothing
  std::uint64_t byte_length = 0;
};

struct BufferView {
  int buffer = -1;
  std::uint64_t byte_offset = 0;
  std::uint64_t byte_length = 0;
  std::uint64_t byte_stride = 0;  // 0: tightly packed
};

enum class ComponentType : std::uint16_t {
  int8 = 5120,
  uint8 = 5121,
  int16 = 5122,
  uint16 = 5123,
  uint32 = 5125,
  float32 = 5126
};

struct SparseAccessor {
  std::uint64_t count = 0;
  int indices_view = -1;
  std::uint64_t indices_offset = 0;
  ComponentType indices_type = ComponentType::uint32;
  int values_view = -1;
  std::uint64_t values_offset = 0;
};

struct Accessor {
  int view = -1;  // -1: zeros
  std::uint64_t byte_offset = 0;
  ComponentType component_type = ComponentType::float32;  // may hold any number until checked
  bool normalized = false;
  std::uint64_t count = 0;
  int components = 0;  // 0: a type that glTF does not define
  bool matrix = false;
  std::optional<SparseAccessor> sparse;
};

struct Image {
  std::string name;
  std::optional<std::string> uri;
  int view = -1;
};

struct Document {
  tinygltf::Model model;  // its buffers, bufferViews, accessors and images mean nothing
  std::vector<Buffer> buffers;
  std::vector<BufferView> views;
  std::vector<Accessor> accessors;
  std::vector<Image> images;
  std::optional<ByteSource> chunk;
};

// Checks syntax, types and references of everything, and that the file's version and required
// extensions are known. Fills the report but for the warnings of use. Throws SceneError.
Document parse_document(Context& context, Container container);

}  // namespace lumivec::gltf
