#include "viewer/window/background_render.h"

#include <exception>
#include <new>

namespace lumivec {

BackgroundRender::~BackgroundRender() {
  cancel();
}

void BackgroundRender::cancel() {
  cancelled_ = true;
  if (thread_.joinable()) thread_.join();
  cancelled_ = false;
  const std::lock_guard lock(mutex_);
  state_.running = false;
}

BackgroundRender::State BackgroundRender::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

int BackgroundRender::start(std::shared_ptr<const LoadedScene> scene, const ScenePatch& patch,
                            const Camera& camera, const RenderSettings& settings, Finish finish,
                            std::function<void()> on_news) {
  cancel();
  const int number = ++number_;
  {
    const std::lock_guard lock(mutex_);
    state_.running = true;
    state_.fraction = 0.0;
    state_.seconds_left = 0.0;
  }
  thread_ = std::thread([this, number, scene = std::move(scene), patch, camera, settings,
                         finish = std::move(finish), on_news = std::move(on_news)] {
    const auto progress = [&](const RenderProgress& now) {
      {
        const std::lock_guard lock(mutex_);
        state_.fraction = now.fraction;
        state_.seconds_left = now.seconds_left;
      }
      on_news();
      return !cancelled_;
    };
    std::string said;
    bool failed = false;
    try {
      RenderStatistics statistics;
      std::optional<Scene> changed;
      if (!patch.empty()) {
        changed = scene->scene;
        apply_patch(patch, *changed);
      }
      const Scene& traced = changed ? *changed : scene->scene;
      const Framebuffer picture = render(traced, camera, settings, statistics, progress);
      if (cancelled_) return;
      said = finish(picture, statistics);
    } catch (const std::bad_alloc&) {
      failed = true;
      said = "out of memory; choose a smaller picture";
    } catch (const std::exception& error) {
      failed = true;
      said = error.what();
    }
    if (cancelled_) return;
    {
      const std::lock_guard lock(mutex_);
      state_.running = false;
      state_.failed = failed;
      state_.said = said;
      state_.ended = number;
    }
    on_news();
  });
  return number;
}

}  // namespace lumivec
