// What the keys and the mouse do in the window: one table, from which keys are looked up, and the
// window's own help and that of the command are printed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lumivec {

enum class Action {
  none,  // a row about the mouse, or about keys that are held
  frame_all,
  home,
  level,
  look_from,
  look_from_opposite,
  next_camera,
  previous_camera,
  store_view,
  recall_view,
  copy_view,
  paste_view,
  toggle_projection,
  toggle_term,
  solo_term,
  every_term,
  wipe,
  brighter,
  darker,
  exposure_zero,
  exposure_auto,
  next_channel,
  next_layer,
  false_color,
  nan_map,
  error_map,
  histogram,
  inspector,
  records,
  pause,
  restart,
  finer,
  coarser,
  path_key,
  path_play,
  path_save,
  undo,
  redo,
  reload,
  recent_files,
  screenshot,
  export_still,
  help,
  panels,
  larger_text,
  smaller_text,
  full_screen,
  close,
  quit
};

struct KeyRow {
  std::string_view group;
  std::string_view keys;  // as the help says it
  std::string_view does;
  Action action = Action::none;
  int modifiers = 0;       // GLFW_MOD_…; exactly these
  std::vector<int> codes;  // GLFW_KEY_…; which of them is told with the action
};

const std::vector<KeyRow>& key_table();

struct KeyAction {
  Action action = Action::none;
  int index = 0;  // of the code in its row: the digit, the axis
};

// code, modifiers: as GLFW reports them; caps and number lock are passed over.
std::optional<KeyAction> find_action(int code, int modifiers);

// All rows, a line each, under their groups.
std::string key_help();

}  // namespace lumivec
