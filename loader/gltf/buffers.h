// The bytes of buffers and buffer views, opened when they are first needed.
#pragma once

#include <optional>
#include <vector>

#include "loader/gltf/document.h"

namespace lumivec::gltf {

class Buffers {
 public:
  Buffers(const Context& context, Document& document);

  // The bytes of a buffer view, checked to lie in its buffer, and the buffer to exist. Fails if
  // not.
  ByteSource view(int index);

 private:
  const ByteSource& buffer(int index);

  const Context& context_;
  Document& document_;
  std::vector<std::optional<ByteSource>> sources_;
};

}  // namespace lumivec::gltf
