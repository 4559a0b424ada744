// What the window shows and how, apart from any window: what panels change and actions act on.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "viewer/option_values.h"
#include "viewer/window/engine_thread.h"
#include "viewer/window/gpu_display.h"
#include "viewer/window/object_place.h"
#include "viewer/window/orbit_camera.h"
#include "viewer/window/settings_file.h"
#include "viewer/window/surface_view.h"

namespace lumivec {

// What panels ask for beyond changing the state.
struct Wishes {
  std::optional<std::filesystem::path> open;
  std::optional<DisplayOptions> display;
  bool reload = false, screenshot = false, export_still = false, cancel_export = false;
  bool copy_view = false, paste_view = false;
  bool path_play = false, path_save = false;
  bool undo = false, redo = false;
};

struct StillWish {
  PictureSize size{1024, 1024};
  bool size_follows_window = true;
  int samples = 64;  // a pixel, as render's
  bool path_tracing = false;
  bool exr = true, png = true;
};

struct WindowState {
  OrbitCamera camera;
  int file_camera = 0;  // index into Scene::cameras: where `home` leads
  std::array<std::optional<OrbitCamera>, 10> kept_views;
  std::vector<OrbitCamera> path_keys;

  std::uint32_t terms = all_terms;
  std::uint32_t terms_before_solo = all_terms;

  DisplayLook look;
  Layer layer = Layer::light;
  bool error_map = false;
  bool wipe = false;
  float wipe_place = 0.5f;  // share of the picture's width

  bool paused = false;
  EngineKnobs knobs;
  // While their sliders are held; knobs afterwards.
  std::optional<double> pending_error;
  std::optional<int> pending_threads;
  WindowSettings settings;

  bool show_help = false, show_histogram = false, show_inspector = false, show_files = false;
  bool show_records = false;

  std::optional<PickAnswer> picked;  // by the last double click
  ObjectPlace picked_place;          // of its object, as the edit panel has it
  std::uint64_t gesture = 0;         // counts what panels' items are held for
  std::uint32_t held_item = 0;       // Dear ImGui's name of it; 0: none
  StillWish still;
  Wishes wishes;
  bool quit = false;

  // A line over the picture, and whether it tells of a failure.
  std::string message;
  bool message_is_error = false;
  double message_until = 0.0;  // seconds of the program's clock; failures stay

  void toggle_term(int term) { terms ^= 1u << unsigned(term); }
  // That one alone; again: what was there before.
  void solo_term(int term) {
    const std::uint32_t alone = 1u << unsigned(term);
    if (terms == alone) {
      terms = terms_before_solo == alone ? all_terms : terms_before_solo;
    } else {
      terms_before_solo = terms;
      terms = alone;
    }
  }
};

// Figures for the status line, the panels and scripts.
struct WindowFigures {
  double frames_per_second = 0.0;  // of the engine
  double frame_seconds = 0.0;
  double traced_share = 0.0;  // of the pixels, in the last frame
  double samples = 0.0;       // a pixel, of the view at rest
  double seconds = 0.0;       // since the view came to rest
  std::uint64_t records = 0, cache_bytes = 0;
  double hit_rate = 0.0;      // of the caches, in the last frame
  int width = 0, height = 0;  // of the picture
  int pixel_size = 1;
  bool resting = false;
  bool shows_errors = false;    // the picture is an error map
  bool shows_surfaces = false;  // the picture is a layer without light
};

}  // namespace lumivec
