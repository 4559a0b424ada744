// A render that goes on while the window is used.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "integrator/render.h"
#include "viewer/window/loaded_scene.h"
#include "viewer/window/scene_patch.h"

namespace lumivec {

class BackgroundRender {
 public:
  // What becomes of the picture; called on the render's thread. Returns a line for the user. What
  // it throws ends the render as a failure.
  using Finish = std::function<std::string(const Framebuffer&, const RenderStatistics&)>;

  BackgroundRender() = default;
  ~BackgroundRender();
  BackgroundRender(const BackgroundRender&) = delete;
  BackgroundRender& operator=(const BackgroundRender&) = delete;

  // Of the scene with the patch. Ends a render that is going on, without its Finish. on_news is
  // called on the render's thread when progress is made and when it ends. Returns the render's
  // number.
  int start(std::shared_ptr<const LoadedScene> scene, const ScenePatch& patch, const Camera& camera,
            const RenderSettings& settings, Finish finish, std::function<void()> on_news);
  // Waits until the render has noticed.
  void cancel();

  struct State {
    bool running = false;
    double fraction = 0.0;  // done
    double seconds_left = 0.0;
    int ended = 0;        // number of the last render that ended by itself; 0: none has
    bool failed = false;  // that one
    std::string said;     // what that one has to say
  };
  State state() const;

 private:
  std::thread thread_;
  std::atomic<bool> cancelled_ = false;
  int number_ = 0;  // of the last render that was started
  mutable std::mutex mutex_;
  State state_;
};

}  // namespace lumivec
