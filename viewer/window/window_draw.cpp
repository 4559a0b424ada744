// How the window is laid out and drawn.
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/errors.h"
#include "viewer/still_writer.h"
#include "viewer/window/picture_files.h"
#include "viewer/window/script_player.h"
#include "viewer/window/window.h"

namespace lumivec {
namespace {

constexpr Color background(0.05f);

}  // namespace

void Window::layout() {
  GLFWwindow* window = gl_.handle();
  iconified_ = glfwGetWindowAttrib(window, GLFW_ICONIFIED) == GLFW_TRUE;
  glfwGetWindowSize(window, &window_width_, &window_height_);
  glfwGetFramebufferSize(window, &canvas_width_, &canvas_height_);
  if (canvas_width_ <= 0 || canvas_height_ <= 0 || window_width_ <= 0 || window_height_ <= 0) {
    iconified_ = true;
    return;
  }
  const auto width = float(window_width_), height = float(window_height_);
  picture_width_ =
      std::floor(width - (state_.settings.panels ? panel_width(width, text_size_) : 0.0f));
  picture_height_ = std::floor(height - status_height(text_size_));
  const float scale_x = float(canvas_width_) / width, scale_y = float(canvas_height_) / height;
  viewport_.width = std::max(1, int(picture_width_ * scale_x));
  viewport_.height = std::max(1, int(picture_height_ * scale_y));
  viewport_.x = 0;
  viewport_.y = canvas_height_ - viewport_.height;
}

void Window::draw() {
  in_driver([&] {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDisable(GL_SCISSOR_TEST);
    glViewport(0, 0, canvas_width_, canvas_height_);
    glClearColor(background.x, background.y, background.z, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    draw_picture();
  });
  after_picture();
  draw_interface();
  if (!shot_file.empty()) write_shot();
}

void Window::draw_picture() {
  const EnginePicture& picture = engine_.picture();
  // A scene's first picture takes a moment, in which the last one's is not shown.
  if (picture.width == 0 || !status_.scene) return;
  DisplayLook look = state_.look;
  const bool light = uploaded_.layer == Layer::light;
  if (!light || uploaded_.errors) look.mode = DisplayMode::encoded;
  look.wipe = light && !uploaded_.errors && state_.wipe && !picture.compared.empty()
                  ? state_.wipe_place
                  : 0.0f;
  // The frames until a window's new shape is followed show the old picture, not a stretched one.
  constexpr int rounding = 4;  // pixels of the picture that its sides may be rounded by
  const Viewport place =
      place_in_room(display_->picture_width(), display_->picture_height(), viewport_.width,
                    viewport_.height, double(rounding * std::max(figures_.pixel_size, 1)));
  canvas_.draw(*display_, viewport_, place, look, background);
}

void Window::after_picture() {
  if (state_.wishes.screenshot) {
    state_.wishes.screenshot = false;
    if (!status_.scene) {
      say("There is no picture yet", true);
      return;
    }
    try {
      const std::filesystem::path file =
          write_screenshot(options_.folder, read_back(viewport_),
                           shown_picture({viewport_.width, viewport_.height}), figures_);
      say(file.string() + " written");
    } catch (const CommandError& error) {
      say(error.what(), true);
    }
  }
  if (check_display && engine_.picture().width > 0) {
    check_display = false;
    const EnginePicture& picture = engine_.picture();
    const Picture shown = read_back(viewport_);
    Picture expected(picture.width, picture.height);
    expected.pixels = picture.pixels;
    DisplayTransform(display_->names().chosen).apply(expected, state_.look.exposure);
    display_difference = 0.0;
    for (int y = 0; y < shown.height; ++y) {
      for (int x = 0; x < shown.width; ++x) {
        const auto row = std::size_t((y + 0.5) * picture.height / shown.height);
        const auto column = std::size_t((x + 0.5) * picture.width / shown.width);
        const Color& e = expected.pixels[row * std::size_t(picture.width) + column];
        const Color& s = shown.pixels[std::size_t(y) * std::size_t(shown.width) + std::size_t(x)];
        for (int c = 0; c < 3; ++c) {
          const double level = std::round(255.0 * std::clamp(double(e[c]), 0.0, 1.0));
          display_difference = std::max(display_difference, std::abs(255.0 * s[c] - level));
        }
      }
    }
  }
}

void Window::draw_interface() {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGuiIO& io = ImGui::GetIO();
#if IMGUI_VERSION_NUM < 18700
  // Older versions ask GLFW where the mouse is; replayed events do not move it.
  if (script_mouse) {
    io.MousePos = ImVec2(float(script_mouse->x), float(script_mouse->y));
    std::copy(script_mouse->down.begin(), script_mouse->down.end(), io.MouseDown);
  }
#endif
  io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
  ImGui::NewFrame();

  PanelInput input;
  input.scene = status_.scene.get();
  input.patch = &edits_.patch();
  input.bounds = status_.bounds;
  input.picture = &engine_.picture();
  input.layers = engine_.layers().scene == status_.scene_number ? &engine_.layers() : nullptr;
  input.histogram = &histogram_;
  input.shares = shares_;
  input.figures = figures_;
  input.still = still_.state();
  input.reference = reference_render_.state();
  input.doing = status_.doing;
  if (mouse_on_picture())
    input.mouse = {mouse_x_ / double(picture_width_), mouse_y_ / double(picture_height_)};
  input.width = float(window_width_);
  input.height = float(window_height_);
  input.picture_width = picture_width_;
  input.picture_height = picture_height_;
  input.edits_done = edits_.done();
  input.edits_undone = edits_.undone();

  std::optional<EditWish> edit;
  if (state_.settings.panels) draw_side_panel(state_, input, display_->names(), edit);
  draw_status(state_, input);
  draw_overlays(state_, input, now());
  if (state_.wipe && state_.layer == Layer::light) {
    const float x = std::round(state_.wipe_place * picture_width_);
    ImDrawList* list = ImGui::GetBackgroundDrawList();
    list->AddLine(ImVec2(x, 0.0f), ImVec2(x, picture_height_), IM_COL32(255, 200, 80, 255));
    list->AddText(ImVec2(x - 5.0f * text_size_, picture_height_ - 2.0f * text_size_),
                  IM_COL32(255, 200, 80, 255), "path  |");
  }
  ImGui::Render();
  in_driver([] { ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData()); });
  if (edit && status_.scene) {
    edits_.apply(edit->edit, edit->gesture);
    send_edits();
  }
}

void Window::write_shot() {
  const Viewport all = {0, 0, canvas_width_, canvas_height_};
  write_displayed(shot_file, read_back(all), {8, true}, StillHeader());
  shot_file.clear();
}

}  // namespace lumivec
