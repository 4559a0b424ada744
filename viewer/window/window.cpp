#include "viewer/window/window.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "viewer/errors.h"
#include "viewer/interrupt.h"
#include "viewer/window/camera_keys.h"
#include "viewer/window/script_player.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

constexpr int least_width = 320, least_height = 240;
constexpr float letter_height = 13.0f;  // of Dear ImGui's own font, and its multiples
constexpr double longest_wait = 0.25;   // seconds without any event
constexpr double message_seconds = 5.0;
constexpr double seconds_a_key = 2.0;  // of a camera path that is played

Window& window_of(GLFWwindow* handle) {
  return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

PictureSize first_size(const WindowOptions& options, const WindowSettings& settings) {
  if (options.size) return *options.size;
  if (settings.width > 0 && settings.height > 0) return {settings.width, settings.height};
  return {usual_width, usual_height};
}

WindowScale scale_of(GLFWwindow* window) {
  float content = 1.0f, content_y = 1.0f;
  glfwGetWindowContentScale(window, &content, &content_y);
  int width = 0, dots = 0, unused = 0;
  glfwGetWindowSize(window, &width, &unused);
  glfwGetFramebufferSize(window, &dots, &unused);
  return window_scale(content, width, dots);
}

// A window may be moved from one display to another: none is to be too fast for its frames.
double fastest_display() {
  constexpr double usual = 60.0;  // where a display does not say
  int count = 0, fastest = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    if (mode) fastest = std::max(fastest, mode->refreshRate);
  }
  return fastest > 0 ? double(fastest) : usual;
}

fs::path settings_file(const WindowOptions& options) {
  return options.remember ? settings_place() : fs::path();
}

}  // namespace

Window::Window(const WindowOptions& options)
    : options_(options),
      settings_file_(settings_file(options)),
      gl_([&] {
        if (!settings_file_.empty()) state_.settings = read_settings(settings_file_);
        const PictureSize size = first_size(options, state_.settings);
        return GlWindow(size.width, size.height, "lumivec", true);
      }()),
      engine_([] { glfwPostEmptyEvent(); }) {
  GLFWwindow* window = gl_.handle();
  glfwSetWindowSizeLimits(window, least_width, least_height, GLFW_DONT_CARE, GLFW_DONT_CARE);
  glfwSwapInterval(1);
  constexpr double software_rate = 30.0;
  display_rate_ = fastest_display();
  if (draws_in_software()) display_rate_ = std::min(display_rate_, software_rate);

  DisplayOptions display = options.display;
  try {
    const bool usual = display.config.empty() || display.config == "builtin";
    if (usual && display.display.empty() && display.view.empty()) {
      DisplayOptions remembered = display;
      remembered.display = state_.settings.display;
      remembered.view = state_.settings.view;
      display_ = std::make_unique<GpuDisplay>(remembered);
    }
  } catch (const UsageError&) {
    // The configuration has changed since: its defaults will do.
  }
  if (!display_) display_ = std::make_unique<GpuDisplay>(display);

  state_.look.exposure = options.exposure;
  if (options.terms != 0) state_.terms = options.terms;
  if (options.pixel_size > 0) state_.settings.pixel_size = options.pixel_size;
  state_.knobs.threads = options.threads;
  state_.knobs.seed = options.seed;
  engine_.set_knobs(state_.knobs);

  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int modifiers) {
    window_of(w).on_key(key, action, modifiers);
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int modifiers) {
    window_of(w).on_button(button, action, modifiers);
  });
  glfwSetCursorPosCallback(window,
                           [](GLFWwindow* w, double x, double y) { window_of(w).on_move(x, y); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double y) { window_of(w).on_wheel(y); });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** files) {
    if (count > 0) window_of(w).on_drop(files[0]);
  });
  glfwSetWindowFocusCallback(
      window, [](GLFWwindow* w, int focused) { window_of(w).on_focus(focused == GLFW_TRUE); });

  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  // They call what was there before: what is above.
  ImGui_ImplGlfw_InitForOpenGL(window, true);
  ImGui_ImplOpenGL3_Init("#version 330 core");
  fit_text();

  if (!options.script.empty()) script_ = std::make_unique<ScriptPlayer>(options.script, *this);
  if (!options.scene.file.empty()) {
    opening_ = options.scene.file;
    engine_.open(options.scene);
  }
}

Window::~Window() {
  still_.stop();
  reference_render_.stop();
  display_.reset();
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

// Text and spaces for the display that the window is on, and as large as the user wants them.
void Window::fit_text() {
  const WindowScale scale = scale_of(gl_.handle());
  const float wanted = state_.settings.interface_scale;
  const bool again = text_size_ > 0.0f;
  if (again && scale == scale_ && wanted == text_scale_wanted_) return;
  scale_ = scale;
  text_scale_wanted_ = wanted;
  const float size = wanted > 0.0f ? wanted : scale_.interface;
  // Letters are drawn in dots, so that they are sharp, and laid out in window units.
  ImFontConfig font;
  font.SizePixels = std::round(letter_height * size * scale_.density);
  text_size_ = font.SizePixels / scale_.density;
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  fonts.Clear();
  fonts.AddFontDefault(&font);
  ImGui::GetIO().FontGlobalScale = 1.0f / scale_.density;
  if (again) {
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
  }
  ImGui::GetStyle() = ImGuiStyle();
  ImGui::StyleColorsDark();
  ImGui::GetStyle().ScaleAllSizes(size);
}

int Window::run() {
  const InterruptGuard interrupt;
  loop_begun_ = thread_seconds();
  while (!glfwWindowShouldClose(gl_.handle()) && !state_.quit && !interrupt.requested()) {
    const bool busy = script_ || navigator_.flying() || path_begun_ >= 0.0;
    if (script_ && script_->waiting() && !navigator_.flying() && path_begun_ < 0.0) {
      constexpr double short_wait = 0.02;  // seconds; the engine has the processor meanwhile
      glfwWaitEventsTimeout(short_wait);
    } else if (busy) {
      glfwPollEvents();
    } else {
      glfwWaitEventsTimeout(longest_wait);
    }
    if (script_ && !script_->step()) script_.reset();
    follow_engine();
    follow_renders();
    follow_files();
    fit_text();
    layout();
    move_eye();
    perform_wishes();
    ask_engine();
    render_reference();
    if (iconified_) {
      if (busy) glfwWaitEventsTimeout(0.01);  // nothing is shown that would take its time
      continue;
    }
    in_driver([&] { upload_pictures(); });
    make_histogram();
    draw();
    in_driver([&] { glfwSwapBuffers(gl_.handle()); });
    ++frames_;
    // Drivers may pass over what glfwSwapInterval asks. A script goes on as fast as it can, apart
    // from what it has flying by the clock.
    if (!script_ || navigator_.flying() || path_begun_ >= 0.0) pacer_.wait(display_rate_);
  }
  if (!settings_file_.empty()) {
    if (!glfwGetWindowMonitor(gl_.handle())) {
      // As GLFW takes it for a window to be: it makes it larger by the display's scale.
      int width = 0, height = 0;
      glfwGetWindowSize(gl_.handle(), &width, &height);
      state_.settings.width = int(std::lround(float(width) / scale_.interface));
      state_.settings.height = int(std::lround(float(height) / scale_.interface));
    }
    if (options_.display.config.empty()) {
      state_.settings.display = display_->names().chosen.display;
      state_.settings.view = display_->names().chosen.view;
    }
    write_settings(settings_file_, state_.settings);
  }
  return interrupt.requested() ? exit_interrupted : exit_success;
}

void Window::say(const std::string& message, bool is_error) {
  state_.message = message;
  state_.message_is_error = is_error;
  state_.message_until = now() + message_seconds;
}

void Window::move_eye() {
  if (navigator_.flying()) {
    constexpr double faster = 4.0, slower = 0.25;
    const double factor = (shift_down_ ? faster : 1.0) * (alt_down_ ? slower : 1.0);
    if (flown_at_ >= 0.0) navigator_.fly(now() - flown_at_, factor, state_.camera);
    flown_at_ = now();
  } else {
    flown_at_ = -1.0;
  }
  if (path_begun_ < 0.0) return;
  const double place = (now() - path_begun_) / seconds_a_key;
  state_.camera = camera_between(state_.path_keys, place);
  if (place >= double(state_.path_keys.size() - 1)) path_begun_ = -1.0;
}

void Window::ask_engine() {
  engine_.set_knobs(state_.knobs);
  if (!status_.scene) return;
  constexpr double most_pixels = 600'000.0;  // that an engine follows a moving eye with
  int size = state_.settings.pixel_size;
  if (size == 0) {
    const double pixels = double(viewport_.width) * double(viewport_.height);
    size = std::max(1, int(std::ceil(std::sqrt(pixels / most_pixels) - 0.05)));
  }
  figures_.pixel_size = size;
  ViewRequest request;
  request.scene = status_.scene_number;
  request.camera = state_.camera.camera();
  request.width = iconified_ ? 0 : std::max(1, viewport_.width / size);
  request.height = iconified_ ? 0 : std::max(1, viewport_.height / size);
  request.terms = state_.terms;
  request.frame_time = state_.settings.frame_time;
  // A still has the machine for itself once the view rests.
  const bool idle = state_.paused || still_.state().running;
  request.rest_samples = idle ? 0.0 : state_.settings.rest_samples;
  request.records = state_.show_records;
  request.layers = state_.settings.panels || state_.show_inspector || state_.show_records ||
                   state_.layer != Layer::light;
  request.compare = state_.wipe && state_.layer == Layer::light;
  request.pick = pick_;
  engine_.request(request);
  asked_ = {request.width, request.height};
  figures_.resting = status_.resting;
}

bool Window::shows_current_view() const {
  const EnginePicture& picture = engine_.picture();
  // A scene that has been opened since is yet to be followed.
  return engine_.status().scene_number == status_.scene_number &&
         picture.scene == status_.scene_number && picture.width > 0 &&
         picture.width == asked_.width && picture.height == asked_.height &&
         picture.terms == state_.terms && picture.change >= change_ &&
         picture.knobs == state_.knobs && same_view(picture.camera, state_.camera.camera());
}

int run_window(const WindowOptions& options) {
  Window window(options);
  return window.run();
}

}  // namespace lumivec
