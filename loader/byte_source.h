// Random access to the bytes of a file or of a block of memory, without mapping or copying the
// whole.
//
// Reads go straight to their destination, so loading needs no second copy of the geometry; and a
// file that shrinks while it is read is an error here, where a mapping would end the program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace lumivec {

class ByteSource {
 public:
  ByteSource() = default;

  // Opens a regular file. follow_link: may the last part of the path be a symbolic link? Throws
  // std::runtime_error with the system's reason.
  static ByteSource open(const std::filesystem::path& file, bool follow_link);
  static ByteSource from_memory(std::vector<std::uint8_t> bytes);

  // The part [offset, offset + size), which must lie inside.
  ByteSource slice(std::uint64_t offset, std::uint64_t size) const;

  std::uint64_t size() const { return size_; }

  // Copies [offset, offset + size), which must lie inside. Throws std::runtime_error if the system
  // fails to.
  void read(std::uint64_t offset, void* to, std::uint64_t size) const;
  std::vector<std::uint8_t> read(std::uint64_t offset, std::uint64_t size) const;

 private:
  struct File;
  std::shared_ptr<const File> file_;
  std::shared_ptr<const std::vector<std::uint8_t>> memory_;
  std::uint64_t begin_ = 0;
  std::uint64_t size_ = 0;
};

}  // namespace lumivec
