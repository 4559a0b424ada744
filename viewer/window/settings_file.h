// What the window remembers between runs, in the user's configuration folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lumivec {

constexpr float least_interface_scale = 0.5f, most_interface_scale = 4.0f;

struct WindowSettings {
  int width = 0, height = 0;  // of the window, on a usual display; 0: as the scene asks
  bool panels = true;
  float interface_scale = 0.0f;               // of text; 0: as the screen asks
  int pixel_size = 0;                         // screen pixels a side; 0: as fast as needed
  double frame_time = 0.033;                  // seconds
  double rest_samples = 4096.0;               // a pixel
  std::string display, view;                  // of the built-in configuration; empty: its defaults
  std::vector<std::filesystem::path> recent;  // newest first
};

constexpr std::size_t most_recent_files = 10;

// $XDG_CONFIG_HOME/lumivec/window.json, or in ~/.config; empty if there is neither.
std::filesystem::path settings_place();

// What is missing, broken or out of range has its default: a settings file never keeps the window
// from opening.
WindowSettings read_settings(const std::filesystem::path& file);
// Makes the folder. Throws CommandError.
void write_settings(const std::filesystem::path& file, const WindowSettings& settings);

// Puts file at the front, once.
void remember_file(WindowSettings& settings, const std::filesystem::path& file);

}  // namespace lumivec
