#include "viewer/window/script_player.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "viewer/atomic_file.h"
#include "viewer/camera_text.h"
#include "viewer/errors.h"
#include "viewer/json_text.h"
#include "viewer/option_values.h"
#include "viewer/window/picture_files.h"
#include "viewer/window/window.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

constexpr double longest_wait = 120.0;  // seconds
constexpr int drag_steps = 8;           // that a drag moves in

// What GLFW would call: it is told nothing of what is replayed.
template <class Callback, class Set, class... Arguments>
void call(GLFWwindow* window, Set set, Arguments... arguments) {
  const Callback callback = set(window, nullptr);
  set(window, callback);
  if (callback) callback(window, arguments...);
}

double number(const std::string& where, const std::string& text) {
  constexpr double most = 1e9;
  return parse_number(where, text, -most, most);
}

}  // namespace

ScriptPlayer::ScriptPlayer(const fs::path& file, Window& window)
    : file_(file), window_(window), lines_(read_script(file)) {
  window_.script_mouse = Window::ScriptMouse();
}

std::string ScriptPlayer::where(const ScriptLine& line) const {
  return file_.string() + ":" + std::to_string(line.number);
}

bool ScriptPlayer::step() {
  if (waiting_) {
    if (!waiting_()) {
      if (glfwGetTime() > wait_end_)
        throw CommandError(waiting_for_ + " did not happen within two minutes");
      return true;
    }
    waiting_ = nullptr;
  }
  if (!steps_.empty()) {
    const auto step = std::move(steps_.front());
    steps_.pop_front();
    step();
    return true;
  }
  if (next_ == lines_.size()) return false;
  begin(lines_[next_++]);
  return true;
}

void ScriptPlayer::press_key(const ScriptKey& key, int action) {
  call<GLFWkeyfun>(window_.handle(), glfwSetKeyCallback, key.code, 0, action, key.modifiers);
}

void ScriptPlayer::move(double x, double y) {
  window_.script_mouse->x = x;
  window_.script_mouse->y = y;
  call<GLFWcursorenterfun>(window_.handle(), glfwSetCursorEnterCallback, GLFW_TRUE);
  call<GLFWcursorposfun>(window_.handle(), glfwSetCursorPosCallback, x, y);
}

void ScriptPlayer::button(int which, int action, int modifiers) {
  window_.script_mouse->down[std::size_t(which)] = action == GLFW_PRESS;
  call<GLFWmousebuttonfun>(window_.handle(), glfwSetMouseButtonCallback, which, action, modifiers);
}

void ScriptPlayer::input(const ScriptLine& line) {
  static const std::map<std::string, int> buttons = {{"left", GLFW_MOUSE_BUTTON_LEFT},
                                                     {"right", GLFW_MOUSE_BUTTON_RIGHT},
                                                     {"middle", GLFW_MOUSE_BUTTON_MIDDLE}};
  const std::vector<std::string>& w = line.words;
  const std::string at = where(line);
  const auto value = [&](std::size_t i) { return number(at, w[i]); };
  const auto which = [&](const std::string& name) {
    const auto found = buttons.find(name);
    if (found == buttons.end()) throw CommandError(at + ": there is no button '" + name + "'");
    return found->second;
  };
  constexpr int left = GLFW_MOUSE_BUTTON_LEFT;
  if (w[0] == "key") {
    const ScriptKey key = parse_script_key(w[1], at);
    press_key(key, GLFW_PRESS);
    then([this, key] { press_key(key, GLFW_RELEASE); });
  } else if (w[0] == "hold" || w[0] == "let") {
    press_key(parse_script_key(w[1], at), w[0] == "hold" ? GLFW_PRESS : GLFW_RELEASE);
  } else if (w[0] == "move") {
    move(value(1), value(2));
  } else if (w[0] == "wheel") {
    call<GLFWscrollfun>(window_.handle(), glfwSetScrollCallback, 0.0, value(1));
  } else if (w[0] == "press" || w[0] == "release") {
    button(which(w[1]), w[0] == "press" ? GLFW_PRESS : GLFW_RELEASE, 0);
  } else if (w[0] == "click" || w[0] == "double") {
    move(value(1), value(2));
    const int times = w[0] == "click" ? 1 : 2;
    then([] {});  // the panels learn where the mouse is
    for (int i = 0; i < times; ++i) {
      then([this] { button(left, GLFW_PRESS, 0); });
      then([this] { button(left, GLFW_RELEASE, 0); });
    }
  } else if (w[0] == "drag") {
    const int with = which(w[1]);
    const double x0 = value(2), y0 = value(3), x1 = value(4), y1 = value(5);
    const int modifiers = w.size() < 7 ? 0 : w[6] == "Shift" ? GLFW_MOD_SHIFT : GLFW_MOD_CONTROL;
    move(x0, y0);
    then([] {});
    then([=, this] { button(with, GLFW_PRESS, modifiers); });
    for (int i = 1; i <= drag_steps; ++i) {
      const double share = double(i) / drag_steps;
      then([=, this] { move(x0 + (x1 - x0) * share, y0 + (y1 - y0) * share); });
    }
    then([=, this] { button(with, GLFW_RELEASE, modifiers); });
  } else if (w[0] == "text") {
    for (std::size_t i = 1; i < w.size(); ++i) {
      for (const char c : (i > 1 ? " " : "") + w[i])
        call<GLFWcharfun>(window_.handle(), glfwSetCharCallback, unsigned(c));
    }
  } else if (w[0] == "drop") {
    const char* file = w[1].c_str();
    call<GLFWdropfun>(window_.handle(), glfwSetDropCallback, 1, &file);
  }
}

void ScriptPlayer::wait_for(const ScriptLine& line) {
  const std::vector<std::string>& w = line.words;
  const std::string at = where(line);
  waiting_for_ = at + ": '" + (w.size() > 1 ? w[1] : w[0]) + "'";
  wait_end_ = glfwGetTime() + longest_wait;
  if (w[0] == "wait") {
    const double end = glfwGetTime() + number(at, w[1]);
    wait_end_ = end + longest_wait;
    waiting_ = [end] { return glfwGetTime() >= end; };
  } else if (w[0] == "frames") {
    for (int i = int(number(at, w[1])); i > 1; --i) then([] {});
  } else if (w[1] == "loaded") {
    waiting_ = [this] { return window_.shows_current_view() && window_.status().doing.empty(); };
  } else if (w[1] == "rest") {
    waiting_ = [this] { return window_.shows_current_view() && window_.status().resting; };
  } else if (w[1] == "error") {
    waiting_ = [this] {
      return window_.state().message_is_error && !window_.state().message.empty();
    };
  } else if (w[1] == "idle") {
    waiting_ = [this] { return window_.status().doing.empty() && !window_.still_running(); };
  } else if (w[1] == "errors") {
    waiting_ = [this] { return window_.figures().shows_errors; };
  } else if (w[1] == "wipe") {
    waiting_ = [this] { return window_.shows_comparison(); };
  } else if (w[1] == "records") {
    waiting_ = [this] { return window_.shows_records(); };
  } else if (w[1] == "picked") {
    waiting_ = [this] { return window_.picks_answered(); };
  } else if (w[1] == "minimised") {
    waiting_ = [this] { return window_.iconified(); };
  } else if (w[1] == "restored") {
    waiting_ = [this] { return !window_.iconified() && window_.shows_current_view(); };
  } else if (w[1] == "opened" && w.size() == 3) {
    const double files = number(at, w[2]);
    waiting_ = [this, files] {
      const EngineStatus status = window_.status();
      return double(status.opened_number) >= files && status.doing.empty() &&
             window_.shows_current_view();
    };
  } else if (w[1] == "size" && w.size() == 3) {
    const PictureSize size = parse_size(at, w[2]);
    waiting_ = [this, size] {
      return window_.size() == std::array<int, 2>{size.width, size.height} &&
             window_.shows_current_view();
    };
  } else if (w[1] == "samples" && w.size() == 3) {
    const double samples = number(at, w[2]);
    waiting_ = [this, samples] {
      return window_.shows_current_view() && window_.picture().samples >= samples;
    };
  } else {
    throw CommandError(at + ": nothing is known of 'until " + w[1] + "'");
  }
}

void ScriptPlayer::begin(const ScriptLine& line) {
  const std::vector<std::string>& w = line.words;
  const std::string at = where(line);
  if (w[0] == "wait" || w[0] == "frames" || w[0] == "until") {
    wait_for(line);
  } else if (w[0] == "resize") {
    const PictureSize size = parse_size(at, w[1]);
    glfwSetWindowSize(window_.handle(), size.width, size.height);
  } else if (w[0] == "minimise") {
    glfwIconifyWindow(window_.handle());
  } else if (w[0] == "restore") {
    glfwRestoreWindow(window_.handle());
  } else if (w[0] == "shot") {
    window_.shot_file = w[1];
    waiting_for_ = at + ": the picture of the window";
    wait_end_ = glfwGetTime() + longest_wait;
    waiting_ = [this] { return window_.shot_file.empty(); };
  } else if (w[0] == "state") {
    write_state(w[1]);
  } else if (w[0] == "check-display") {
    window_.check_display = true;
    window_.display_difference = -1.0;
    waiting_for_ = at + ": the comparison";
    wait_end_ = glfwGetTime() + longest_wait;
    waiting_ = [this] { return window_.display_difference >= 0.0; };
    then([this, at] {
      if (window_.display_difference > 1.001)
        throw CommandError(at + ": what is displayed differs by " +
                           std::to_string(window_.display_difference) + "/255 from what it should");
    });
  } else if (w[0] == "copy") {
    std::error_code error;
    fs::copy_file(w[1], w[2], fs::copy_options::overwrite_existing, error);
    if (error) throw CommandError(at + ": " + error.message());
  } else if (w[0] == "quit") {
    window_.state().quit = true;
  } else {
    input(line);
  }
}

void ScriptPlayer::write_state(const fs::path& file) {
  const WindowState& s = window_.state();
  const WindowFigures& f = window_.figures();
  const EngineStatus status = window_.status();
  int width = 0, height = 0;
  glfwGetWindowSize(window_.handle(), &width, &height);
  nlohmann::json json = {
      {"camera", camera_text(s.camera.camera(), s.camera.pivot())},
      {"pivot", {s.camera.pivot().x, s.camera.pivot().y, s.camera.pivot().z}},
      {"eye", {s.camera.eye().x, s.camera.eye().y, s.camera.eye().z}},
      {"terms", terms_text(s.terms)},
      {"exposure", s.look.exposure},
      {"mode", int(s.look.mode)},
      {"channel", channel_names[std::size_t(s.look.channel)]},
      {"layer", layer_names[std::size_t(s.layer)]},
      {"wipe", s.wipe},
      {"wipe_place", s.wipe_place},
      {"error_map", s.error_map},
      {"shows_errors", f.shows_errors},
      {"paused", s.paused},
      {"cache_error", s.knobs.error},
      {"threads", s.knobs.threads},
      {"panels", s.settings.panels},
      {"help", s.show_help},
      {"histogram", s.show_histogram},
      {"inspector", s.show_inspector},
      {"records", s.show_records},
      {"files", s.show_files},
      {"keys", s.path_keys.size()},
      {"picked", s.picked ? s.picked->object : -1},
      {"incident_faces", s.picked && s.picked->light ? s.picked->light->faces.size() : 0},
      {"incident_records", s.picked && s.picked->light ? s.picked->light->records : 0},
      {"edits", window_.edits_done()},
      {"changed", status.scene ? patch_text(window_.patch(), status.scene->scene) : ""},
      {"message", s.message},
      {"error", s.message_is_error && !s.message.empty()},
      {"scene", status.scene ? status.scene->source.file.string() : ""},
      {"opened", status.opened_number},
      {"window", {width, height}},
      {"picture", {f.width, f.height}},
      {"pixel_size", f.pixel_size},
      {"samples", f.samples},
      {"frame_seconds", f.frame_seconds},
      {"frames_per_second", f.frames_per_second},
      {"resting", status.resting},
      {"frames", window_.frames()},
      {"seconds", glfwGetTime()},
      {"own_frame_seconds", window_.own_seconds()},
      {"display_rate", window_.display_rate()},
      {"interface_scale", window_.scale().interface},
      {"text_size", window_.text_size()},
      {"first_picture_seconds", window_.first_picture_seconds()},
      {"resident_bytes", resident_bytes()}};
  write_text_atomically(file, json_text(json));
}

}  // namespace lumivec
