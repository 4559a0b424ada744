// What keys, the mouse and panels bring about.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/exposure.h"
#include "viewer/window/script_player.h"
#include "viewer/window/window.h"

namespace lumivec {
namespace {

constexpr double exposure_step = 0.25;  // stops
constexpr double most_stops = 64.0;
constexpr int most_pixel_size = 8;
constexpr double double_click_seconds = 0.4, double_click_reach = 5.0;  // screen units
constexpr double wipe_reach = 6.0;                                      // likewise

std::optional<Navigator::Held> held_key(int key) {
  switch (key) {
    case GLFW_KEY_W:
      return Navigator::forward;
    case GLFW_KEY_S:
      return Navigator::back;
    case GLFW_KEY_A:
      return Navigator::left;
    case GLFW_KEY_D:
      return Navigator::right;
    case GLFW_KEY_E:
      return Navigator::up;
    case GLFW_KEY_Q:
      return Navigator::down;
    default:
      return std::nullopt;
  }
}

template <class Enum>
Enum next_of(Enum value, std::size_t count) {
  return Enum((std::size_t(value) + 1) % count);
}

}  // namespace

void Window::on_key(int key, int action, int modifiers) {
  const bool down = action != GLFW_RELEASE;
  if (key == GLFW_KEY_LEFT_SHIFT || key == GLFW_KEY_RIGHT_SHIFT) shift_down_ = down;
  if (key == GLFW_KEY_LEFT_ALT || key == GLFW_KEY_RIGHT_ALT) alt_down_ = down;
  const auto held = held_key(key);
  if (held && !down) navigator_.hold(*held, false);
  if (!down || ImGui::GetIO().WantTextInput) return;
  if (held && (modifiers & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) == 0) {
    navigator_.hold(*held, true);
    path_begun_ = -1.0;
    return;
  }
  const auto found = find_action(key, modifiers);
  if (!found) return;
  const bool repeats = found->action == Action::brighter || found->action == Action::darker;
  if (action == GLFW_REPEAT && !repeats) return;
  perform(*found);
}

bool Window::mouse_on_picture() const {
  return !ImGui::GetIO().WantCaptureMouse && mouse_x_ >= 0.0 && mouse_y_ >= 0.0 &&
         mouse_x_ < double(picture_width_) && mouse_y_ < double(picture_height_);
}

void Window::on_button(int button, int action, int modifiers) {
  if (action == GLFW_RELEASE) {
    navigator_.end_drag();
    wipe_drag_ = false;
    return;
  }
  if (!mouse_on_picture()) return;
  path_begun_ = -1.0;
  using Drag = Navigator::Drag;
  Drag drag = Drag::none;
  if (button == GLFW_MOUSE_BUTTON_LEFT) {
    const double line = double(state_.wipe_place) * double(picture_width_);
    if (state_.wipe && std::abs(mouse_x_ - line) < wipe_reach) {
      wipe_drag_ = true;
      return;
    }
    const bool twice = now() - click_at_ < double_click_seconds &&
                       std::hypot(mouse_x_ - click_x_, mouse_y_ - click_y_) < double_click_reach;
    click_at_ = twice ? -1.0 : now();
    click_x_ = mouse_x_;
    click_y_ = mouse_y_;
    if (twice) {
      pick_ = {++picks_, mouse_x_ / double(picture_width_), mouse_y_ / double(picture_height_)};
      return;
    }
    drag = (modifiers & GLFW_MOD_SHIFT) != 0     ? Drag::pan
           : (modifiers & GLFW_MOD_CONTROL) != 0 ? Drag::dolly
                                                 : Drag::orbit;
  } else if (button == GLFW_MOUSE_BUTTON_MIDDLE) {
    drag = Drag::pan;
  } else if (button == GLFW_MOUSE_BUTTON_RIGHT) {
    drag = Drag::look;
  }
  navigator_.begin_drag(drag, mouse_x_ / double(picture_height_),
                        mouse_y_ / double(picture_height_));
}

void Window::on_move(double x, double y) {
  mouse_x_ = x;
  mouse_y_ = y;
  if (wipe_drag_) {
    state_.wipe_place = std::clamp(float(x) / picture_width_, 0.0f, 1.0f);
    return;
  }
  navigator_.drag_to(x / double(picture_height_), y / double(picture_height_), state_.camera);
}

void Window::on_wheel(double steps) {
  if (mouse_on_picture()) navigator_.wheel(steps, state_.camera);
}

void Window::on_drop(const std::filesystem::path& file) {
  open(file, false);
}

void Window::on_focus(bool focused) {
  if (focused) return;
  navigator_.let_go();
  navigator_.end_drag();
  shift_down_ = alt_down_ = wipe_drag_ = false;
}

void Window::perform(const KeyAction& action) {
  Wishes& wishes = state_.wishes;
  switch (action.action) {
    case Action::toggle_term:
      state_.toggle_term(action.index);
      break;
    case Action::solo_term:
      state_.solo_term(action.index);
      break;
    case Action::every_term:
      state_.terms = all_terms;
      break;
    case Action::wipe:
      state_.wipe = !state_.wipe;
      break;
    case Action::error_map:
      state_.error_map = !state_.error_map;
      break;
    case Action::pause:
      state_.paused = !state_.paused;
      break;
    case Action::restart:
      ++state_.knobs.restarts;
      break;
    case Action::larger_text:
    case Action::smaller_text: {
      constexpr float step = 1.125f;
      float& size = state_.settings.interface_scale;
      if (!(size > 0.0f)) size = scale_.interface;
      size *= action.action == Action::larger_text ? step : 1.0f / step;
      size = std::clamp(size, least_interface_scale, most_interface_scale);
      break;
    }
    case Action::finer:
      state_.settings.pixel_size = std::max(1, figures_.pixel_size - 1);
      break;
    case Action::coarser:
      state_.settings.pixel_size = std::min(most_pixel_size, figures_.pixel_size + 1);
      break;
    case Action::undo:
      wishes.undo = true;
      break;
    case Action::redo:
      wishes.redo = true;
      break;
    case Action::reload:
      wishes.reload = true;
      break;
    case Action::recent_files:
      state_.show_files = !state_.show_files;
      break;
    case Action::screenshot:
      wishes.screenshot = true;
      break;
    case Action::export_still:
      wishes.export_still = true;
      break;
    case Action::help:
      state_.show_help = !state_.show_help;
      break;
    case Action::panels:
      state_.settings.panels = !state_.settings.panels;
      break;
    case Action::full_screen:
      set_full_screen(!glfwGetWindowMonitor(gl_.handle()));
      break;
    case Action::close:
      if (state_.show_help || state_.show_files) {
        state_.show_help = state_.show_files = false;
      } else {
        state_.message.clear();
        path_begun_ = -1.0;
      }
      break;
    case Action::quit:
      state_.quit = true;
      break;
    default:
      perform_view(action);
      perform_picture(action);
      break;
  }
}

void Window::perform_view(const KeyAction& action) {
  const LoadedScene* scene = status_.scene.get();
  const auto show_camera = [&](int step) {
    if (!scene) return;
    const auto count = int(scene->scene.cameras.size());
    state_.file_camera = ((state_.file_camera + step) % count + count) % count;
    const Camera& camera = scene->scene.cameras[std::size_t(state_.file_camera)];
    state_.camera.take(camera, state_.camera.pivot());
    pivot_pending_ = true;
    if (step != 0)
      say("Camera " + (camera.name.empty() ? std::to_string(state_.file_camera) : camera.name));
  };
  switch (action.action) {
    case Action::frame_all:
      if (scene) state_.camera.frame(status_.bounds, double(picture_width_ / picture_height_));
      break;
    case Action::home:
      show_camera(0);
      break;
    case Action::next_camera:
      show_camera(1);
      break;
    case Action::previous_camera:
      show_camera(-1);
      break;
    case Action::level:
      state_.camera.level();
      break;
    case Action::look_from:
    case Action::look_from_opposite: {
      const int opposite = action.action == Action::look_from_opposite ? 1 : 0;
      state_.camera.look_from_axis(ViewAxis(2 * action.index + opposite));
      break;
    }
    case Action::store_view:
      state_.kept_views[std::size_t(action.index)] = state_.camera;
      say("View " + std::to_string(action.index) + " kept");
      break;
    case Action::recall_view:
      if (state_.kept_views[std::size_t(action.index)]) {
        state_.camera = *state_.kept_views[std::size_t(action.index)];
      } else {
        say("There is no view " + std::to_string(action.index) + "; Ctrl+" +
            std::to_string(action.index) + " keeps one");
      }
      break;
    case Action::copy_view:
      state_.wishes.copy_view = true;
      break;
    case Action::paste_view:
      state_.wishes.paste_view = true;
      break;
    case Action::toggle_projection: {
      Camera camera = state_.camera.camera();
      const double half = std::tan(0.5 * double(camera.yfov));
      const double depth = std::max(state_.camera.distance(), 1e-6);
      if (camera.kind == CameraKind::perspective) {
        camera.kind = CameraKind::orthographic;
        camera.ymag = float(depth * half);
        camera.xmag = camera.ymag;
      } else {
        camera.kind = CameraKind::perspective;
      }
      state_.camera.take(camera, state_.camera.pivot());
      break;
    }
    case Action::path_key:
      state_.path_keys.push_back(state_.camera);
      say("Camera path: " + std::to_string(state_.path_keys.size()) + " keys");
      break;
    case Action::path_play:
      state_.wishes.path_play = true;
      break;
    case Action::path_save:
      state_.wishes.path_save = true;
      break;
    default:
      break;
  }
}

void Window::perform_picture(const KeyAction& action) {
  DisplayLook& look = state_.look;
  const auto toggle = [&](DisplayMode mode) {
    look.mode = look.mode == mode ? DisplayMode::view : mode;
  };
  switch (action.action) {
    case Action::brighter:
      look.exposure = std::min(look.exposure + exposure_step, most_stops);
      break;
    case Action::darker:
      look.exposure = std::max(look.exposure - exposure_step, -most_stops);
      break;
    case Action::exposure_zero:
      look.exposure = 0.0;
      break;
    case Action::exposure_auto:
      if (engine_.picture().width > 0) look.exposure = automatic_exposure(engine_.picture().pixels);
      break;
    case Action::next_channel:
      look.channel = next_of(look.channel, channel_names.size());
      say(channel_names[std::size_t(look.channel)]);
      break;
    case Action::next_layer:
      state_.layer = next_of(state_.layer, layer_names.size());
      say(layer_names[std::size_t(state_.layer)]);
      break;
    case Action::false_color:
      toggle(DisplayMode::false_color);
      break;
    case Action::nan_map:
      toggle(DisplayMode::nan_map);
      break;
    case Action::histogram:
      state_.show_histogram = !state_.show_histogram;
      histogram_at_ = -1.0;
      break;
    case Action::inspector:
      state_.show_inspector = !state_.show_inspector;
      break;
    case Action::records:
      state_.show_records = !state_.show_records;
      break;
    default:
      break;
  }
}

}  // namespace lumivec
