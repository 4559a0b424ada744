// Names for files that are written without asking: FOLDER/STEM_0001.EXTENSION, with the first
// number that is free. They are taken at once, so that neither another picture nor another program
// is given the same.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lumivec {

class NewFiles {
 public:
  // One file for each extension, of one number that is free for all of them; empty until they are
  // written. Throws CommandError.
  NewFiles(const std::filesystem::path& folder, const std::string& stem,
           const std::vector<std::string>& extensions);
  // Removes them, unless they are to be kept.
  ~NewFiles();
  NewFiles(const NewFiles&) = delete;
  NewFiles& operator=(const NewFiles&) = delete;

  const std::filesystem::path& file(std::size_t i) const { return files_[i]; }
  // All have been written.
  void keep() { kept_ = true; }

 private:
  void remove() noexcept;

  std::vector<std::filesystem::path> files_;
  bool kept_ = false;
};

}  // namespace lumivec
