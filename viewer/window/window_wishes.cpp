// What panels and keys wish for beyond changing the state.
#include "viewer/atomic_file.h"
#include "viewer/camera_text.h"
#include "viewer/errors.h"
#include "viewer/text_format.h"
#include "viewer/window/camera_keys.h"
#include "viewer/window/new_files.h"
#include "viewer/window/picture_files.h"
#include "viewer/window/script_player.h"
#include "viewer/window/window.h"

namespace lumivec {

void Window::send_edits() {
  change_ = engine_.change(edits_.patch(), edits_.changes(), opened_seen_);
}

void Window::perform_wishes() {
  Wishes wishes;
  std::swap(wishes, state_.wishes);
  state_.wishes.screenshot = wishes.screenshot;  // when the picture has been drawn
  try {
    if (wishes.open) open(*wishes.open, false);
    if (wishes.reload && status_.scene) open(status_.scene->source.file, true);
    if (wishes.display) display_->set_transform(*wishes.display);
    if (wishes.undo && edits_.undo()) send_edits();
    if (wishes.redo && edits_.redo()) send_edits();
    if (wishes.copy_view) {
      const std::string text = camera_text(state_.camera.camera(), state_.camera.pivot());
      glfwSetClipboardString(gl_.handle(), text.c_str());
      say("Copied: " + text);
    }
    if (wishes.paste_view) {
      const char* text = glfwGetClipboardString(gl_.handle());
      if (!text || !is_camera_text(text))
        throw UsageError("What was copied is no view; write eye=X,Y,Z/target=X,Y,Z");
      const Camera camera = parse_camera_text("paste", text, state_.camera.camera());
      state_.camera.take(camera, state_.camera.pivot());
      pivot_pending_ = true;
    }
    if (wishes.path_play) {
      if (state_.path_keys.size() < 2)
        throw UsageError("A camera path needs two views; K adds one");
      path_begun_ = now();
    }
    if (wishes.path_save) write_path();
    if (wishes.cancel_export) still_.cancel();
    if (wishes.export_still && status_.scene) {
      if (!state_.still.exr && !state_.still.png)
        throw UsageError("Choose OpenEXR or PNG for the still");
      const BackgroundRender::State running = still_.state();
      if (running.running) {
        throw UsageError("A still is being rendered, " + format_fixed(100.0 * running.fraction, 0) +
                         "% of it; wait for it, or stop it in the panel");
      }
      const PictureSize window = {viewport_.width, viewport_.height};
      const PictureSize size = state_.still.size_follows_window ? window : state_.still.size;
      start_still(still_, status_.scene, shown_picture(size), options_.folder,
                  [] { glfwPostEmptyEvent(); });
      say("Rendering a still");
    }
  } catch (const std::exception& error) {
    say(error.what(), true);
  }
}

ShownPicture Window::shown_picture(const PictureSize& size) const {
  return {*status_.scene, edits_.patch(), state_, display_->names().chosen, size};
}

void Window::write_path() {
  if (state_.path_keys.empty()) throw UsageError("A camera path needs a view; K adds one");
  const std::string stem =
      status_.scene ? status_.scene->source.file.stem().string() : std::string("camera");
  NewFiles files(options_.folder, stem + "_path", {".json"});
  write_text_atomically(files.file(0), camera_keys_text(state_.path_keys));
  files.keep();
  say(files.file(0).string() + " written");
}

void Window::set_full_screen(bool full) {
  GLFWwindow* window = gl_.handle();
  if (!full) {
    glfwSetWindowMonitor(window, nullptr, windowed_[0], windowed_[1], windowed_[2], windowed_[3],
                         GLFW_DONT_CARE);
    return;
  }
  GLFWmonitor* monitor = glfwGetPrimaryMonitor();
  const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
  if (!mode) {
    say("This display has no full screen", true);
    return;
  }
  glfwGetWindowPos(window, &windowed_[0], &windowed_[1]);
  glfwGetWindowSize(window, &windowed_[2], &windowed_[3]);
  glfwSetWindowMonitor(window, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

}  // namespace lumivec
