#include "loader/gltf/accessors.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>
#include <type_traits>

namespace lumivec::gltf {
namespace {

constexpr std::uint64_t chunk_bytes =
    1 << 18;  // fits a second-level cache, and makes system calls rare

template <class C, class T>
T component(const std::uint8_t* from, bool normalized) {
  C value;
  std::memcpy(&value, from, sizeof(C));
  if constexpr (std::is_same_v<T, std::uint32_t> || std::is_same_v<C, float>) {
    return static_cast<T>(value);
  } else {
    if (!normalized) return static_cast<T>(value);
    constexpr T full = static_cast<T>(std::numeric_limits<C>::max());
    return std::max(static_cast<T>(value) / full, T{-1});
  }
}

// used: components to convert; components: their distance in the destination.
template <class C, class T>
void convert(const std::uint8_t* from, std::uint64_t stride, std::uint64_t count, int used, T* to,
             int components, bool normalized) {
  for (std::uint64_t i = 0; i < count; ++i) {
    for (int c = 0; c < used; ++c) {
      to[c] = component<C, T>(from + static_cast<std::size_t>(c) * sizeof(C), normalized);
    }
    from += stride;
    to += components;
  }
}

template <class T>
void convert(ComponentType type, const std::uint8_t* from, std::uint64_t stride,
             std::uint64_t count, int used, T* to, int components, bool normalized) {
  switch (type) {
    case ComponentType::int8:
      return convert<std::int8_t>(from, stride, count, used, to, components, normalized);
    case ComponentType::uint8:
      return convert<std::uint8_t>(from, stride, count, used, to, components, normalized);
    case ComponentType::int16:
      return convert<std::int16_t>(from, stride, count, used, to, components, normalized);
    case ComponentType::uint16:
      return convert<std::uint16_t>(from, stride, count, used, to, components, normalized);
    case ComponentType::uint32:
      return convert<std::uint32_t>(from, stride, count, used, to, components, normalized);
    case ComponentType::float32:
      if constexpr (std::is_same_v<T, float>) {
        return convert<float>(from, stride, count, used, to, components, normalized);
      }
      break;
  }
  assert(false);
}

template <class T>
constexpr ComponentType native_type() {
  return std::is_same_v<T, float> ? ComponentType::float32 : ComponentType::uint32;
}

}  // namespace

struct Accessors::Elements {
  ByteSource bytes;
  std::uint64_t offset = 0;
  std::uint64_t stride = 0;
};

std::uint64_t component_size(ComponentType type) {
  switch (type) {
    case ComponentType::int8:
    case ComponentType::uint8:
      return 1;
    case ComponentType::int16:
    case ComponentType::uint16:
      return 2;
    case ComponentType::uint32:
    case ComponentType::float32:
      return 4;
  }
  return 0;
}

Accessors::Accessors(const Context& context, const Document& document, Buffers& buffers)
    : context_(context), document_(document), buffers_(buffers) {}

const Accessor& Accessors::operator[](int index) const {
  return document_.accessors[static_cast<std::size_t>(index)];
}

std::string Accessors::where(int index) const {
  return pointer({"accessors", static_cast<std::size_t>(index)});
}

bool Accessors::has_data(int index) const {
  const Accessor& accessor = (*this)[index];
  return accessor.view >= 0 || (accessor.sparse && accessor.sparse->count > 0);
}

void Accessors::require(int index, std::string_view user, std::initializer_list<int> components,
                        std::initializer_list<ComponentType> types) const {
  const Accessor& accessor = (*this)[index];
  const bool matrix = std::find(components.begin(), components.end(), 16) != components.end();
  if (accessor.matrix != matrix ||
      std::find(components.begin(), components.end(), accessor.components) == components.end()) {
    context_.fail(user, "accessor " + std::to_string(index) + " has the wrong type for it");
  }
  if (std::find(types.begin(), types.end(), accessor.component_type) == types.end()) {
    context_.fail(user, "accessor " + std::to_string(index) + " has component type " +
                            std::to_string(static_cast<int>(accessor.component_type)) +
                            ", which is not allowed for it");
  }
}

void Accessors::check(int index) {
  const Accessor& accessor = (*this)[index];
  const std::uint64_t element_size =
      component_size(accessor.component_type) * static_cast<std::uint64_t>(accessor.components);
  if (element_size == 0) {
    context_.fail(where(index), "has a type or component type that glTF does not define");
  }
  if (accessor.view >= 0) {
    elements(accessor.view, accessor.byte_offset, accessor.count, element_size, true, where(index));
  }
}

// Where count elements lie in a view, checked to lie in it.
Accessors::Elements Accessors::elements(int view, std::uint64_t offset, std::uint64_t count,
                                        std::uint64_t element_size, bool strided,
                                        const std::string& where) {
  Elements found{buffers_.view(view), offset, element_size};
  const std::uint64_t declared = document_.views[static_cast<std::size_t>(view)].byte_stride;
  if (strided && declared != 0) found.stride = declared;
  if (found.stride < element_size) {
    context_.fail(where, "stride of " + std::to_string(found.stride) + " bytes for elements of " +
                             std::to_string(element_size));
  }
  if (count == 0) return found;
  std::uint64_t end = 0;
  if (__builtin_mul_overflow(count - 1, found.stride, &end) ||
      __builtin_add_overflow(end, element_size, &end) ||
      __builtin_add_overflow(end, offset, &end) || end > found.bytes.size()) {
    context_.fail(where, "reaches past its buffer view: " + std::to_string(count) +
                             " elements from byte " + std::to_string(offset) + " of " +
                             std::to_string(found.bytes.size()));
  }
  return found;
}

template <class T>
void Accessors::read_elements(int index, std::uint64_t first, std::uint64_t count, int components,
                              T* to, bool normalized) {
  const Accessor& accessor = (*this)[index];
  const int used = std::min(components, accessor.components);
  if (accessor.view < 0) {
    for (std::uint64_t i = 0; i < count; ++i, to += components) std::fill_n(to, used, T{0});
    return;
  }
  const std::uint64_t element_size =
      component_size(accessor.component_type) * static_cast<std::uint64_t>(accessor.components);
  const Elements from = elements(accessor.view, accessor.byte_offset, accessor.count, element_size,
                                 true, where(index));
  std::uint64_t offset = from.offset + first * from.stride;
  if (accessor.component_type == native_type<T>() && components == accessor.components &&
      from.stride == element_size) {
    from.bytes.read(offset, to, count * element_size);
    return;
  }
  const std::uint64_t most = std::max<std::uint64_t>(1, chunk_bytes / from.stride);
  while (count > 0) {
    const std::uint64_t n = std::min(count, most);
    const std::uint64_t bytes = (n - 1) * from.stride + element_size;
    chunk_.resize(std::max<std::uint64_t>(chunk_.size(), bytes));
    from.bytes.read(offset, chunk_.data(), bytes);
    convert(accessor.component_type, chunk_.data(), from.stride, n, used, to, components,
            normalized);
    to += n * static_cast<std::uint64_t>(components);
    offset += n * from.stride;
    count -= n;
  }
}

template <class T>
void Accessors::read_sparse(int index, std::uint64_t first, std::uint64_t count, int components,
                            T* to, bool normalized) {
  const Accessor& accessor = (*this)[index];
  const SparseAccessor& sparse = *accessor.sparse;
  const std::string place = where(index) + "/sparse";
  if (sparse.count > accessor.count) {
    context_.fail(place, std::to_string(sparse.count) + " sparse elements of " +
                             std::to_string(accessor.count));
  }
  const std::uint64_t index_size = component_size(sparse.indices_type);
  const bool unsigned_type = sparse.indices_type == ComponentType::uint8 ||
                             sparse.indices_type == ComponentType::uint16 ||
                             sparse.indices_type == ComponentType::uint32;
  if (!unsigned_type) context_.fail(place + "/indices", "are not of an unsigned integer type");
  const std::uint64_t value_size =
      component_size(accessor.component_type) * static_cast<std::uint64_t>(accessor.components);
  const Elements indices = elements(sparse.indices_view, sparse.indices_offset, sparse.count,
                                    index_size, false, place + "/indices");
  const Elements values = elements(sparse.values_view, sparse.values_offset, sparse.count,
                                   value_size, false, place + "/values");
  const int used = std::min(components, accessor.components);
  std::vector<std::uint8_t> raw;
  std::vector<std::uint32_t> targets;
  std::int64_t previous = -1;
  const std::uint64_t most = chunk_bytes / value_size;
  for (std::uint64_t done = 0; done < sparse.count;) {
    const std::uint64_t n = std::min(sparse.count - done, most);
    raw = indices.bytes.read(indices.offset + done * index_size, n * index_size);
    targets.resize(n);
    convert(sparse.indices_type, raw.data(), index_size, n, 1, targets.data(), 1, false);
    raw = values.bytes.read(values.offset + done * value_size, n * value_size);
    for (std::uint64_t i = 0; i < n; ++i) {
      const std::uint64_t target = targets[i];
      if (target >= accessor.count || static_cast<std::int64_t>(target) <= previous) {
        context_.fail(place + "/indices",
                      "index " + std::to_string(target) + " is out of range or out of order");
      }
      previous = static_cast<std::int64_t>(target);
      if (target < first || target - first >= count) continue;
      convert(accessor.component_type, raw.data() + i * value_size, value_size, 1, used,
              to + (target - first) * static_cast<std::uint64_t>(components), components,
              normalized);
    }
    done += n;
  }
}

void Accessors::read(int index, std::uint64_t first, std::uint64_t count, int components, float* to,
                     Scale scale) {
  const Accessor& accessor = (*this)[index];
  assert(first <= accessor.count && count <= accessor.count - first);
  const bool normalized = accessor.normalized || scale == Scale::always_normalized;
  read_elements(index, first, count, components, to, normalized);
  if (accessor.sparse) read_sparse(index, first, count, components, to, normalized);
}

void Accessors::read(int index, std::uint64_t first, std::uint64_t count, int components,
                     std::uint32_t* to) {
  const Accessor& accessor = (*this)[index];
  assert(first <= accessor.count && count <= accessor.count - first);
  read_elements(index, first, count, components, to, false);
  if (accessor.sparse) read_sparse(index, first, count, components, to, false);
}

}  // namespace lumivec::gltf
