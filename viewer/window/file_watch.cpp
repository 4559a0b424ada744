#include "viewer/window/file_watch.h"

#include <system_error>

namespace fs = std::filesystem;

namespace lumivec {

FileWatch::State FileWatch::state_of(const fs::path& file) {
  State state;
  std::error_code error;
  state.size = fs::file_size(file, error);
  if (error) return {};
  state.time = fs::last_write_time(file, error);
  if (error) return {};
  state.there = true;
  return state;
}

std::vector<FileWatch::State> FileWatch::states() const {
  std::vector<State> result;
  result.reserve(files_.size());
  for (const fs::path& file : files_) result.push_back(state_of(file));
  return result;
}

void FileWatch::watch(std::vector<fs::path> files) {
  files_ = std::move(files);
  known_ = latest_ = states();
}

bool FileWatch::changed(double now) {
  if (files_.empty()) return false;
  std::vector<State> current = states();
  if (current != latest_) {
    latest_ = std::move(current);
    since_ = now;
    return false;
  }
  if (latest_ == known_ || now - since_ < settle_seconds) return false;
  // Saving may remove a file and make it again: one that is gone is waited for.
  for (std::size_t i = 0; i < latest_.size(); ++i) {
    if (known_[i].there && !latest_[i].there) return false;
  }
  known_ = latest_;
  return true;
}

std::vector<fs::path> files_of_scene(const fs::path& scene) {
  fs::path buffer = scene;
  buffer.replace_extension(".bin");
  if (buffer == scene) return {scene};
  return {scene, buffer};
}

}  // namespace lumivec
