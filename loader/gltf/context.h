// What every part of the glTF reader needs: whose file it is, what may be read, where to complain,
// how much to decode.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>

#include "loader/load_scene.h"

namespace lumivec::gltf {

// A JSON pointer from its parts: pointer({"meshes", 3, "primitives", 0}) is
// "/meshes/3/primitives/0".
std::string pointer(std::initializer_list<std::variant<std::string_view, std::size_t>> parts);

// text with everything that would break a line of output replaced, and cut to a readable length.
std::string printable(std::string_view text);

class Context {
 public:
  Context(const std::filesystem::path& file, const LoadOptions& load_options,
          LoadReport& load_report);

  const std::string file;              // as the user named it
  const std::filesystem::path folder;  // canonical; relative URIs start here
  const LoadOptions& options;
  LoadReport& report;

  // Throws SceneError. where: a JSON pointer. An empty remedy becomes the advice to repair or
  // export the file again.
  [[noreturn]] void fail(std::string_view where, std::string_view problem,
                         std::string_view remedy = {}) const;

  // Adds a warning to the report; after max_warnings of them only counts on.
  void warn(std::string_view where, std::string_view message);

  // Says in the report how many warnings were left out.
  void finish_warnings();

  // Takes bytes from LoadOptions::max_bytes before they are allocated; fails if there are not
  // enough left. Thread-safe.
  void claim(std::uint64_t bytes, std::string_view where);
  // The same for count things of size bytes each, without overflow.
  void claim(std::uint64_t count, std::uint64_t size, std::string_view where);

 private:
  static constexpr std::size_t max_warnings = 100;  // more than anyone reads
  std::size_t warnings_left_out_ = 0;
  std::atomic<std::uint64_t> claimed_{0};
};

}  // namespace lumivec::gltf
