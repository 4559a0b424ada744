#include "viewer/window/key_table.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>

namespace lumivec {

const std::vector<KeyRow>& key_table() {
  constexpr int shift = GLFW_MOD_SHIFT, ctrl = GLFW_MOD_CONTROL, alt = GLFW_MOD_ALT;
  constexpr std::string_view move = "Moving", view = "Views", light = "Light", picture = "Picture",
                             work = "Rendering", files = "Files", window = "Window";
  static const std::vector<int> digits = {GLFW_KEY_0, GLFW_KEY_1, GLFW_KEY_2, GLFW_KEY_3,
                                          GLFW_KEY_4, GLFW_KEY_5, GLFW_KEY_6, GLFW_KEY_7,
                                          GLFW_KEY_8, GLFW_KEY_9};
  static const std::vector<int> terms = {GLFW_KEY_1, GLFW_KEY_2, GLFW_KEY_3, GLFW_KEY_4,
                                         GLFW_KEY_5};
  static const std::vector<int> axes = {GLFW_KEY_X, GLFW_KEY_Y, GLFW_KEY_Z};
  static const std::vector<KeyRow> table = {
      {move, "Left drag", "Go around the pivot", Action::none, 0, {}},
      {move, "Middle drag, Shift+left", "Move along the picture", Action::none, 0, {}},
      {move, "Wheel, Ctrl+left drag", "Go to the pivot and away from it", Action::none, 0, {}},
      {move, "Right drag", "Look around", Action::none, 0, {}},
      {move,
       "W A S D, Q E",
       "Fly, and down and up; Shift: faster, Alt: slower",
       Action::none,
       0,
       {}},
      {move, "Double click", "Make the pivot what is there", Action::none, 0, {}},
      {move, "F", "Show the whole scene", Action::frame_all, 0, {GLFW_KEY_F}},
      {move, "L", "Level the horizon", Action::level, 0, {GLFW_KEY_L}},
      {view, "X, Y, Z", "Look from the right, above, the front", Action::look_from, 0, axes},
      {view, "Shift+X, Y, Z", "Look from the left, below, behind", Action::look_from_opposite,
       shift, axes},
      {view, "O", "Parallel view, and back", Action::toggle_projection, 0, {GLFW_KEY_O}},
      {view, "Home", "Back to the file's camera", Action::home, 0, {GLFW_KEY_HOME}},
      {view, "C", "The file's next camera", Action::next_camera, 0, {GLFW_KEY_C}},
      {view, "Shift+C", "The file's previous camera", Action::previous_camera, shift, {GLFW_KEY_C}},
      {view, "Ctrl+0 to 9", "Keep this view", Action::store_view, ctrl, digits},
      {view, "Alt+0 to 9", "Show the view that was kept", Action::recall_view, alt, digits},
      {view,
       "Ctrl+C",
       "Copy the view as text for render --camera",
       Action::copy_view,
       ctrl,
       {GLFW_KEY_C}},
      {view, "Ctrl+V", "Show a view that was copied", Action::paste_view, ctrl, {GLFW_KEY_V}},
      {view, "K", "Add this view to the camera path", Action::path_key, 0, {GLFW_KEY_K}},
      {view, "Shift+K", "Play the camera path", Action::path_play, shift, {GLFW_KEY_K}},
      {view,
       "Ctrl+K",
       "Save the camera path for walk --path",
       Action::path_save,
       ctrl,
       {GLFW_KEY_K}},
      {light, "1 to 5", "Emitted, specular, direct, indirect, caustic: on, off",
       Action::toggle_term, 0, terms},
      {light, "Shift+1 to 5", "That one alone, and back", Action::solo_term, shift, terms},
      {light, "0", "All five", Action::every_term, 0, {GLFW_KEY_0}},
      {light,
       "V",
       "Path tracing on the left, to compare; drag the line",
       Action::wipe,
       0,
       {GLFW_KEY_V}},
      {light, "M", "Error against a path-traced picture", Action::error_map, 0, {GLFW_KEY_M}},
      {picture,
       "+",
       "Brighter by a quarter stop",
       Action::brighter,
       0,
       {GLFW_KEY_EQUAL, GLFW_KEY_KP_ADD}},
      {picture, "-", "Darker", Action::darker, 0, {GLFW_KEY_MINUS, GLFW_KEY_KP_SUBTRACT}},
      {picture, "B", "Middle grey for the picture's mean", Action::exposure_auto, 0, {GLFW_KEY_B}},
      {picture, "Shift+B", "Exposure 0", Action::exposure_zero, shift, {GLFW_KEY_B}},
      {picture, "T", "Colour, red, green, blue, luminance", Action::next_channel, 0, {GLFW_KEY_T}},
      {picture, "U", "Picture, objects, normals, depth", Action::next_layer, 0, {GLFW_KEY_U}},
      {picture, "G", "Stops from middle grey as colours", Action::false_color, 0, {GLFW_KEY_G}},
      {picture,
       "N",
       "What is not a number, infinite or negative",
       Action::nan_map,
       0,
       {GLFW_KEY_N}},
      {picture, "H", "Histogram", Action::histogram, 0, {GLFW_KEY_H}},
      {picture, "I", "Values under the mouse", Action::inspector, 0, {GLFW_KEY_I}},
      {picture,
       "J",
       "Records of cached light, and the light at the last double click",
       Action::records,
       0,
       {GLFW_KEY_J}},
      {work, "Space, P", "Pause", Action::pause, 0, {GLFW_KEY_SPACE, GLFW_KEY_P}},
      {work, "R", "Begin again", Action::restart, 0, {GLFW_KEY_R}},
      {work, "[", "Smaller pixels", Action::finer, 0, {GLFW_KEY_LEFT_BRACKET}},
      {work, "]", "Larger pixels, faster", Action::coarser, 0, {GLFW_KEY_RIGHT_BRACKET}},
      {work,
       "Ctrl+Z",
       "Undo a change of a light, material or object",
       Action::undo,
       ctrl,
       {GLFW_KEY_Z}},
      {work, "Ctrl+Y", "Redo it", Action::redo, ctrl, {GLFW_KEY_Y}},
      {files, "Drop a file", "Open it", Action::none, 0, {}},
      {files, "F5", "Read the scene again", Action::reload, 0, {GLFW_KEY_F5}},
      {files, "Ctrl+O", "Files", Action::recent_files, ctrl, {GLFW_KEY_O}},
      {files, "F12", "Write what is displayed", Action::screenshot, 0, {GLFW_KEY_F12}},
      {files, "Ctrl+S", "Render a still with all layers", Action::export_still, ctrl, {GLFW_KEY_S}},
      {window, "F1", "These keys", Action::help, 0, {GLFW_KEY_F1}},
      {window, "Tab", "Panels on, off", Action::panels, 0, {GLFW_KEY_TAB}},
      {window,
       "Ctrl+plus",
       "Larger text and panels",
       Action::larger_text,
       ctrl,
       {GLFW_KEY_EQUAL, GLFW_KEY_KP_ADD}},
      {window,
       "Ctrl+minus",
       "Smaller",
       Action::smaller_text,
       ctrl,
       {GLFW_KEY_MINUS, GLFW_KEY_KP_SUBTRACT}},
      {window, "F11", "Full screen, and back", Action::full_screen, 0, {GLFW_KEY_F11}},
      {window, "Esc", "Close what lies over the picture", Action::close, 0, {GLFW_KEY_ESCAPE}},
      {window, "Ctrl+Q", "Quit", Action::quit, ctrl, {GLFW_KEY_Q}}};
  return table;
}

std::optional<KeyAction> find_action(int code, int modifiers) {
  const bool is_plus = code == GLFW_KEY_EQUAL;  // typed with Shift on many keyboards
  modifiers &= GLFW_MOD_SHIFT | GLFW_MOD_CONTROL | GLFW_MOD_ALT | GLFW_MOD_SUPER;
  if (is_plus) modifiers &= ~GLFW_MOD_SHIFT;
  for (const KeyRow& row : key_table()) {
    if (row.action == Action::none || row.modifiers != modifiers) continue;
    const auto found = std::find(row.codes.begin(), row.codes.end(), code);
    if (found != row.codes.end()) return KeyAction{row.action, int(found - row.codes.begin())};
  }
  return std::nullopt;
}

std::string key_help() {
  std::size_t width = 0;
  for (const KeyRow& row : key_table()) width = std::max(width, row.keys.size());
  std::string text;
  std::string_view group;
  for (const KeyRow& row : key_table()) {
    if (row.group != group) {
      if (!text.empty()) text += '\n';
      group = row.group;
      text += std::string(group) + ":\n";
    }
    std::string keys(row.keys);
    keys.resize(width, ' ');
    text += "  " + keys + "  " + std::string(row.does) + "\n";
  }
  return text;
}

}  // namespace lumivec
