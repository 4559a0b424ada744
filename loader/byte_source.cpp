#include "loader/byte_source.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace lumivec {

struct ByteSource::File {
  explicit File(int opened) : descriptor(opened) {}
  ~File() { ::close(descriptor); }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const int descriptor;
};

ByteSource ByteSource::open(const std::filesystem::path& file, bool follow_link) {
  // Without O_NONBLOCK a named pipe would wait for its writer.
  const int flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | (follow_link ? 0 : O_NOFOLLOW);
  const int descriptor = ::open(file.c_str(), flags);
  if (descriptor < 0) throw std::runtime_error(std::strerror(errno));
  ByteSource source;
  source.file_ = std::make_shared<const File>(descriptor);
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) throw std::runtime_error(std::strerror(errno));
  if (!S_ISREG(status.st_mode)) throw std::runtime_error("not a regular file");
  source.size_ = static_cast<std::uint64_t>(status.st_size);
  return source;
}

ByteSource ByteSource::from_memory(std::vector<std::uint8_t> bytes) {
  ByteSource source;
  source.size_ = bytes.size();
  source.memory_ = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
  return source;
}

ByteSource ByteSource::slice(std::uint64_t offset, std::uint64_t size) const {
  assert(offset <= size_ && size <= size_ - offset);
  ByteSource part = *this;
  part.begin_ += offset;
  part.size_ = size;
  return part;
}

void ByteSource::read(std::uint64_t offset, void* to, std::uint64_t size) const {
  assert(offset <= size_ && size <= size_ - offset);
  if (size == 0) return;
  if (memory_) {
    std::memcpy(to, memory_->data() + begin_ + offset, size);
    return;
  }
  auto* next = static_cast<std::uint8_t*>(to);
  auto position = static_cast<off_t>(begin_ + offset);
  while (size > 0) {
    const ssize_t got = ::pread(file_->descriptor, next, size, position);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw std::runtime_error(std::strerror(errno));
    if (got == 0) throw std::runtime_error("the file became shorter while it was read");
    next += got;
    position += got;
    size -= static_cast<std::uint64_t>(got);
  }
}

std::vector<std::uint8_t> ByteSource::read(std::uint64_t offset, std::uint64_t size) const {
  std::vector<std::uint8_t> bytes(size);
  read(offset, bytes.data(), size);
  return bytes;
}

}  // namespace lumivec
