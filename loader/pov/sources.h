// The files of a scene: where they may lie, how large they may be, and each lexed once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "loader/byte_source.h"
#include "loader/load_scene.h"
#include "loader/pov/lexer.h"

namespace lumivec::pov {

struct Source {
  std::string name;              // as errors call it
  std::filesystem::path folder;  // canonical; where its own includes are searched first
  std::filesystem::path file;    // canonical; empty for text from memory
  TokenText text;
};

// Why a file cannot be had, and what to do about it.
struct FileProblem {
  std::string problem;
  std::string remedy;
};

class Sources {
 public:
  // scene: the file as the user named it. Include paths that do not exist are ignored.
  Sources(const std::filesystem::path& scene, const LoadOptions& options);

  // Lexes the scene's own text, or an included file once, and takes at most the given bytes for it.
  // Returns the index; throws FileProblem.
  std::uint32_t add(std::string name, const std::filesystem::path& file, std::string_view text,
                    Symbols& symbols, std::uint64_t most_bytes);
  std::uint32_t include(const std::string& name, std::uint32_t from, Symbols& symbols,
                        std::uint64_t most_bytes);

  // The whole of another file that the scene names: a height field, a picture, a #read file.
  // Throws FileProblem.
  std::vector<std::uint8_t> read(const std::string& name, std::uint32_t from) const;
  bool exists(const std::string& name, std::uint32_t from) const;

  // That were opened, canonical, each once.
  std::vector<std::filesystem::path> files() const;

  const Source& operator[](std::uint32_t index) const { return *sources_[index]; }
  std::uint64_t bytes() const { return bytes_; }  // of all tokens and strings

 private:
  std::optional<std::filesystem::path> find(const std::string& name, std::uint32_t from,
                                            bool& outside) const;
  std::filesystem::path find_or_throw(const std::string& name, std::uint32_t from) const;
  ByteSource open(const std::string& name, const std::filesystem::path& file) const;

  const LoadOptions& options_;
  std::filesystem::path scene_folder_;        // canonical
  std::vector<std::filesystem::path> roots_;  // canonical; the scene's folder comes first
  std::vector<std::unique_ptr<Source>> sources_;
  mutable std::set<std::filesystem::path> opened_;
  std::uint64_t bytes_ = 0;
};

}  // namespace lumivec::pov
