// Elements of accessors as floats or unsigned integers: every component type, normalised or not,
// interleaved, sparse.
//
// Counts, offsets and strides are checked against the buffers before a byte is read. Tightly packed
// floats and 32-bit integers are read straight to their destination; everything else through a
// buffer of fixed size.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "loader/gltf/buffers.h"
#include "loader/gltf/document.h"

namespace lumivec::gltf {

// May integers stand for real numbers, and on what scale?
enum class Scale : std::uint8_t {
  as_declared,       // by the accessor's own flag
  always_normalized  // full range is 1, flag or not
};

class Accessors {
 public:
  Accessors(const Context& context, const Document& document, Buffers& buffers);

  const Accessor& operator[](int index) const;
  std::string where(int index) const;

  // Has the accessor any data, or is it all zeros by definition?
  bool has_data(int index) const;

  // Fails unless the accessor has one of the given numbers of components and one of the given
  // component types. user: who refers to it.
  void require(int index, std::string_view user, std::initializer_list<int> components,
               std::initializer_list<ComponentType> types) const;

  // Fails unless all elements lie in their buffers. To be called before room for them is made.
  void check(int index);

  // Elements [first, first + count), which must exist, to components floats (or integers) each.
  // Components that the accessor has not got are left as they are; the ones it has got too many of
  // are dropped.
  void read(int index, std::uint64_t first, std::uint64_t count, int components, float* to,
            Scale scale = Scale::as_declared);
  void read(int index, std::uint64_t first, std::uint64_t count, int components, std::uint32_t* to);

 private:
  struct Elements;
  Elements elements(int view, std::uint64_t offset, std::uint64_t count, std::uint64_t element_size,
                    bool strided, const std::string& where);
  template <class T>
  void read_elements(int index, std::uint64_t first, std::uint64_t count, int components, T* to,
                     bool normalized);
  template <class T>
  void read_sparse(int index, std::uint64_t first, std::uint64_t count, int components, T* to,
                   bool normalized);

  const Context& context_;
  const Document& document_;
  Buffers& buffers_;
  std::vector<std::uint8_t> chunk_;
};

// Bytes of one component; 0 for a type that glTF does not define.
std::uint64_t component_size(ComponentType type);

}  // namespace lumivec::gltf
