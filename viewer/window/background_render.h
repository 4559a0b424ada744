// Renders that go on while the window is used, one at a time.
#pragma once

#include <atomic>
#include <condition_variable>
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

  // Of the scene with the patch. Takes the place of a render that is going on, and begins once that
  // has noticed. on_news is called on the render's thread when progress is made and when it ends.
  // Returns the render's number.
  int start(std::shared_ptr<const LoadedScene> scene, const ScenePatch& patch, const Camera& camera,
            const RenderSettings& settings, Finish finish, std::function<void()> on_news);
  // The render that goes on, if any, ends by and by without a word, and without its Finish unless
  // that has begun. Does not wait.
  void cancel();
  // Likewise, and waits until it has; there is no start() after this.
  void stop();

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
  struct Job {
    int number = 0;
    std::shared_ptr<const LoadedScene> scene;
    ScenePatch patch;
    Camera camera;
    RenderSettings settings;
    Finish finish;
    std::function<void()> on_news;
    std::atomic<bool> cancelled = false;
  };

  void work();
  void perform(Job& job);
  void cancel_locked();

  std::thread thread_;
  mutable std::mutex mutex_;  // of all below
  std::condition_variable changed_;
  std::shared_ptr<Job> job_, next_;  // that goes on; that follows
  bool stopping_ = false;
  int number_ = 0;  // of the last render that was started
  State state_;
};

}  // namespace lumivec
