#include "viewer/window/settings_file.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "viewer/atomic_file.h"
#include "viewer/errors.h"
#include "viewer/json_text.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

constexpr std::uintmax_t most_bytes = 1u << 20;

template <class T>
void read_number(const nlohmann::json& json, const char* name, T least, T most, T& value) {
  const auto found = json.find(name);
  if (found == json.end() || !found->is_number()) return;
  const double number = found->get<double>();
  if (number >= double(least) && number <= double(most)) value = T(number);
}

void read_text(const nlohmann::json& json, const char* name, std::string& value) {
  const auto found = json.find(name);
  if (found != json.end() && found->is_string()) value = found->get<std::string>();
}

}  // namespace

fs::path settings_place() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return fs::path(value ? value : "");
  };
  // Relative ones are to be passed over (XDG Base Directory Specification).
  const fs::path config = variable("XDG_CONFIG_HOME");
  if (config.is_absolute()) return config / "lumivec" / "window.json";
  const fs::path home = variable("HOME");
  if (home.is_absolute()) return home / ".config" / "lumivec" / "window.json";
  return {};
}

WindowSettings read_settings(const fs::path& file) {
  WindowSettings settings;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size > most_bytes) return settings;
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return settings;
  constexpr int most_side = 16384;
  read_number(json, "width", 160, most_side, settings.width);
  read_number(json, "height", 120, most_side, settings.height);
  read_number(json, "interface_scale", least_interface_scale, most_interface_scale,
              settings.interface_scale);
  read_number(json, "pixel_size", 0, 16, settings.pixel_size);
  read_number(json, "frame_time", 0.001, 10.0, settings.frame_time);
  read_number(json, "rest_samples", 1.0, 1e9, settings.rest_samples);
  if (json.contains("panels") && json["panels"].is_boolean()) settings.panels = json["panels"];
  read_text(json, "display", settings.display);
  read_text(json, "view", settings.view);
  if (json.contains("recent") && json["recent"].is_array()) {
    for (const nlohmann::json& entry : json["recent"]) {
      if (entry.is_string() && settings.recent.size() < most_recent_files)
        settings.recent.emplace_back(entry.get<std::string>());
    }
  }
  return settings;
}

void write_settings(const fs::path& file, const WindowSettings& settings) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  nlohmann::json json = {{"width", settings.width},
                         {"height", settings.height},
                         {"panels", settings.panels},
                         {"interface_scale", settings.interface_scale},
                         {"pixel_size", settings.pixel_size},
                         {"frame_time", settings.frame_time},
                         {"rest_samples", settings.rest_samples},
                         {"display", settings.display},
                         {"view", settings.view},
                         {"recent", nlohmann::json::array()}};
  for (const fs::path& recent : settings.recent) json["recent"].push_back(recent.string());
  write_text_atomically(file, json_text(json));
}

void remember_file(WindowSettings& settings, const fs::path& file) {
  std::error_code error;
  const fs::path place = fs::absolute(file, error);
  if (error) return;
  std::erase(settings.recent, place);
  settings.recent.insert(settings.recent.begin(), place);
  if (settings.recent.size() > most_recent_files) settings.recent.resize(most_recent_files);
}

}  // namespace lumivec
