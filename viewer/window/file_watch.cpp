#include "viewer/window/file_watch.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>

namespace fs = std::filesystem;

namespace lumivec {
namespace {

// Beyond these a look at everything a few times a second costs more than it is worth.
constexpr std::uintmax_t most_json_bytes = std::uintmax_t{64} << 20;
constexpr std::size_t most_watched = 1000;

// "%20" and its like become what they stand for.
std::string decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned value = 0;
    const char* end = uri.data() + std::min(i + 3, uri.size());
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(uri.data() + i + 1, end, value, 16).ptr == end) {
      text += char(value);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

}  // namespace

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
  std::vector<fs::path> files = {scene};
  std::string extension = scene.extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  std::error_code error;
  if (extension != ".gltf" || fs::file_size(scene, error) > most_json_bytes || error) return files;
  std::ifstream in(scene, std::ios::binary);
  const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object()) return files;
  for (const char* list : {"buffers", "images"}) {
    const auto entries = json.find(list);
    if (entries == json.end() || !entries->is_array()) continue;
    for (const nlohmann::json& entry : *entries) {
      if (files.size() == most_watched) return files;
      const auto uri = entry.find("uri");
      if (uri == entry.end() || !uri->is_string()) continue;
      const std::string text = uri->get<std::string>();
      if (text.starts_with("data:")) continue;
      try {
        files.push_back(scene.parent_path() / decoded(text));
      } catch (const std::exception&) {
        // No name of a file: what loading says of it is enough.
      }
    }
  }
  return files;
}

}  // namespace lumivec
