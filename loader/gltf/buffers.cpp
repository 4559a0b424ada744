#include "loader/gltf/buffers.h"

#include <stdexcept>

#include "loader/gltf/uri.h"

namespace lumivec::gltf {
namespace {

ByteSource open_uri(const Context& context, const std::string& where, const std::string& uri) {
  if (is_data_uri(uri)) {
    auto bytes = decode_data_uri(uri);
    if (!bytes) context.fail(where, "malformed data URI");
    return ByteSource::from_memory(std::move(*bytes));
  }
  if (is_remote_uri(uri)) {
    context.fail(where, "URI " + printable(uri) + " would need a network and is not read",
                 "fetch the file and place it beside the scene");
  }
  const auto file = find_file(context, where, uri);
  if (!file) {
    context.fail(where, "file " + printable(uri) + " does not exist",
                 "place it beside the scene file");
  }
  try {
    return ByteSource::open(*file, false);
  } catch (const std::runtime_error& error) {
    context.fail(where, "file " + printable(uri) + ": " + error.what(), "make it readable");
  }
}

}  // namespace

Buffers::Buffers(const Context& context, Document& document)
    : context_(context), document_(document), sources_(document.buffers.size()) {}

const ByteSource& Buffers::buffer(int index) {
  std::optional<ByteSource>& source = sources_[static_cast<std::size_t>(index)];
  if (source) return *source;
  Buffer& record = document_.buffers[static_cast<std::size_t>(index)];
  const std::string where = pointer({"buffers", static_cast<std::size_t>(index)});
  if (record.uri) {
    source = open_uri(context_, where + "/uri", *record.uri);
    record.uri = std::string();  // a data URI is not needed twice
  } else if (index == 0 && document_.chunk) {
    source = document_.chunk;
  } else {
    context_.fail(where, "has neither a URI nor a binary chunk");
  }
  if (source->size() < record.byte_length) {
    context_.fail(where, "needs " + std::to_string(record.byte_length) + " bytes, but only " +
                             std::to_string(source->size()) + " are there");
  }
  return *source;
}

ByteSource Buffers::view(int index) {
  const BufferView& view = document_.views[static_cast<std::size_t>(index)];
  const ByteSource& source = buffer(view.buffer);
  const std::uint64_t size = document_.buffers[static_cast<std::size_t>(view.buffer)].byte_length;
  if (view.byte_offset > size || view.byte_length > size - view.byte_offset) {
    context_.fail(pointer({"bufferViews", static_cast<std::size_t>(index)}),
                  "reaches from byte " + std::to_string(view.byte_offset) + " over " +
                      std::to_string(view.byte_length) + " bytes, but its buffer has " +
                      std::to_string(size));
  }
  return source.slice(view.byte_offset, view.byte_length);
}

}  // namespace lumivec::gltf
