// Memory in the processor's large pages: random reads of a large array otherwise spend half of
// their time on finding the page.
#pragma once

#include <cstddef>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace lumivec {

// What is smaller than one such page is allocated as usual.
constexpr std::size_t large_page = std::size_t{1} << 21;

// Throws std::bad_alloc. Without large pages everything works as well.
inline void* allocate_large_pages(std::size_t bytes, std::size_t alignment) {
  if (bytes < large_page) return ::operator new (bytes, std::align_val_t{alignment});
  void* memory = ::operator new (bytes, std::align_val_t{large_page});
#ifdef __linux__
  madvise(memory, bytes, MADV_HUGEPAGE);
#endif
  return memory;
}

// Of the same size and alignment.
inline void free_large_pages(void* memory, std::size_t bytes, std::size_t alignment) {
  ::operator delete (memory, std::align_val_t{bytes < large_page ? alignment : large_page});
}

// For standard containers.
template <typename T>
struct LargePageAllocator {
  using value_type = T;

  LargePageAllocator() = default;
  template <typename U>
  explicit LargePageAllocator(const LargePageAllocator<U>&) {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(allocate_large_pages(count * sizeof(T), alignof(T)));
  }
  void deallocate(T* memory, std::size_t count) {
    free_large_pages(memory, count * sizeof(T), alignof(T));
  }
  bool operator==(const LargePageAllocator&) const { return true; }
};

}  // namespace lumivec
