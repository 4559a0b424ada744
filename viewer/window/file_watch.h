// Tells when files have changed and are whole again: a program that saves a scene may take a while,
// and write several files.
#pragma once

#include <filesystem>
#include <vector>

namespace lumivec {

class FileWatch {
 public:
  // The files as they are now count as known.
  void watch(std::vector<std::filesystem::path> files);

  // To be called now and then; now: seconds on any clock. True once for each change, when the files
  // have stayed as they are for settle_seconds.
  bool changed(double now);

  static constexpr double settle_seconds = 0.3;

 private:
  struct State {
    bool there = false;
    std::filesystem::file_time_type time{};
    std::uintmax_t size = 0;

    bool operator==(const State&) const = default;
  };
  static State state_of(const std::filesystem::path& file);
  std::vector<State> states() const;

  std::vector<std::filesystem::path> files_;
  std::vector<State> known_, latest_;
  double since_ = 0.0;
};

// The scene file, and what a glTF file names as its buffers and images, whether they are there or
// not. A file that cannot be read has none.
std::vector<std::filesystem::path> files_of_scene(const std::filesystem::path& scene);

}  // namespace lumivec
