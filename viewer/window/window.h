// The insides of run_window: one object that the loop, the actions of keys and the replayed events
// share.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <memory>
#include <optional>

#include "viewer/window/background_render.h"
#include "viewer/window/engine_thread.h"
#include "viewer/window/file_watch.h"
#include "viewer/window/frame_pacer.h"
#include "viewer/window/gl_window.h"
#include "viewer/window/gpu_display.h"
#include "viewer/window/key_table.h"
#include "viewer/window/navigator.h"
#include "viewer/window/panels.h"
#include "viewer/window/picture_canvas.h"
#include "viewer/window/shown_settings.h"
#include "viewer/window/thread_time.h"
#include "viewer/window/window_app.h"
#include "viewer/window/window_scale.h"
#include "viewer/window/window_state.h"

namespace lumivec {

class ScriptPlayer;

constexpr int usual_width = 1120, usual_height = 720;  // of a first window, on a usual display

class Window {
 public:
  explicit Window(const WindowOptions& options);
  ~Window();
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;

  int run();

  // ---- for replayed events ----------------------------------------------------------------------
  GLFWwindow* handle() const { return gl_.handle(); }
  WindowState& state() { return state_; }
  const WindowFigures& figures() const { return figures_; }
  EngineStatus status() const { return engine_.status(); }
  const EnginePicture& picture() const { return engine_.picture(); }
  bool still_running() const { return still_.state().running; }
  bool shows_current_view() const;
  bool shows_comparison() const { return shows_current_view() && !picture().compared.empty(); }
  bool shows_records() const {
    return engine_.layers().scene == status_.scene_number && !engine_.layers().records.empty();
  }
  bool picks_answered() const { return pick_seen_ == picks_; }
  bool iconified() const { return iconified_; }
  std::array<int, 2> size() const { return {window_width_, window_height_}; }
  double first_picture_seconds() const { return first_picture_; }
  std::uint64_t frames() const { return frames_; }
  // Processor time a frame of this thread, without what OpenGL's driver takes of it.
  double own_seconds() const {
    return frames_ > 0 ? (thread_seconds() - loop_begun_ - driver_seconds_) / double(frames_) : 0.0;
  }
  double display_rate() const { return display_rate_; }
  const WindowScale& scale() const { return scale_; }
  float text_size() const { return text_size_; }
  std::size_t edits_done() const { return edits_.done(); }
  const ScenePatch& patch() const { return edits_.patch(); }
  // Where the mouse is for the panels, instead of where it really is; and which buttons are down.
  struct ScriptMouse {
    double x = 0.0, y = 0.0;
    std::array<bool, 3> down{};
  };
  std::optional<ScriptMouse> script_mouse;
  // At the end of the next frame: the whole window is written there.
  std::filesystem::path shot_file;
  // In the next frame: the picture is compared with DisplayTransform's; afterwards the largest
  // difference in steps of 1/255, or -1 while it has not been made.
  bool check_display = false;
  double display_difference = -1.0;

  // ---- what GLFW calls --------------------------------------------------------------------------
  void on_key(int key, int action, int modifiers);
  void on_button(int button, int action, int modifiers);
  void on_move(double x, double y);
  void on_wheel(double steps);
  void on_drop(const std::filesystem::path& file);
  void on_focus(bool focused);

 private:
  void perform(const KeyAction& action);
  void perform_view(const KeyAction& action);
  void perform_picture(const KeyAction& action);
  void perform_wishes();
  void send_edits();

  void open(const std::filesystem::path& file, bool keep_camera);
  void follow_engine();
  void take_scene(const EngineStatus& status);
  void take_picture();
  void take_layers();
  void upload_pictures();
  void make_histogram();
  void follow_renders();
  void follow_files();
  void move_eye();
  void ask_engine();
  void render_reference();

  void fit_text();
  void layout();
  void draw();
  void draw_picture();
  void after_picture();  // screenshots and checks of what the picture's part shows
  void draw_interface();
  void write_shot();

  template <class Calls>
  void in_driver(const Calls& calls) {
    const double begun = thread_seconds();
    calls();
    driver_seconds_ += thread_seconds() - begun;
  }

  void say(const std::string& message, bool is_error = false);
  void set_display(const DisplayOptions& display);
  ShownPicture shown_picture(const PictureSize& size) const;  // there is a scene
  void write_path();
  void set_full_screen(bool full);
  double now() const { return glfwGetTime(); }
  bool mouse_on_picture() const;

  const WindowOptions options_;
  WindowState state_;
  std::filesystem::path settings_file_;
  GlWindow gl_;
  std::unique_ptr<GpuDisplay> display_;
  PictureCanvas canvas_;
  EngineThread engine_;
  BackgroundRender still_, reference_render_;
  std::unique_ptr<ScriptPlayer> script_;
  Navigator navigator_;
  FileWatch watch_;
  SceneEdits edits_;

  // What is known of the engine.
  EngineStatus status_;
  std::uint64_t scene_seen_ = 0, opened_seen_ = 0, error_seen_ = 0;
  int stills_seen_ = 0;
  std::uint64_t change_ = 0;  // the last that the engine was sent
  PictureSize asked_;         // of the engine
  std::optional<std::filesystem::path> opening_;
  bool pivot_pending_ = false;
  bool metering_ = false;  // the next picture sets the exposure
  std::uint64_t picks_ = 0, pick_seen_ = 0;
  PickQuestion pick_;

  // The picture's part of the window: screen units, and pixels from the lower left corner.
  int window_width_ = 1, window_height_ = 1;
  int canvas_width_ = 1, canvas_height_ = 1;
  float picture_width_ = 1.0f, picture_height_ = 1.0f;
  Viewport viewport_;
  WindowScale scale_;
  float text_size_ = 0.0f;          // window units; 0: there is none yet
  float text_scale_wanted_ = 0.0f;  // Settings::interface_scale that it is for
  bool iconified_ = false;
  std::array<int, 4> windowed_{};  // place and size before full screen

  WindowFigures figures_;
  double picture_at_ = 0.0, moved_at_ = 0.0, first_picture_ = -1.0;
  std::uint64_t picture_seen_ = 0;
  Histogram histogram_;
  double histogram_at_ = -1.0;
  std::array<double, term_count> shares_{};
  // What has been given to the graphics card: of which picture, and what was made of it.
  struct Uploaded {
    std::uint64_t picture = 0, layers = 0;
    Layer layer = Layer::light;
    bool errors = false;

    bool operator==(const Uploaded&) const = default;
  };
  Uploaded uploaded_;
  std::uint64_t layers_taken_ = 0;
  // A path-traced picture and the view that it is of.
  struct Reference {
    Camera camera;
    std::uint32_t terms = 0;
    std::uint64_t scene = 0;
    int width = 0, height = 0;
    int render = 0;  // BackgroundRender's number; 0: none has been started
    bool ready = false, failed = false;
  };
  std::vector<Color> reference_pixels_;  // of the render's thread until that has ended
  Reference reference_;

  double mouse_x_ = 0.0, mouse_y_ = 0.0;
  double click_at_ = -1.0, click_x_ = 0.0, click_y_ = 0.0;
  bool wipe_drag_ = false;
  bool shift_down_ = false, alt_down_ = false;
  double flown_at_ = -1.0;
  double path_begun_ = -1.0;
  double watched_at_ = 0.0;
  FramePacer pacer_;
  double display_rate_ = 60.0;                      // pictures a second, of the fastest display
  std::uint64_t frames_ = 0;                        // that the window has shown
  double loop_begun_ = 0.0, driver_seconds_ = 0.0;  // thread_seconds
};

}  // namespace lumivec
