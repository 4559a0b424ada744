#include "viewer/window/background_render.h"

#include <exception>
#include <new>
#include <optional>
#include <utility>

namespace lumivec {

BackgroundRender::~BackgroundRender() {
  stop();
}

void BackgroundRender::cancel_locked() {
  if (job_) job_->cancelled = true;
  next_.reset();
  state_.running = false;
}

void BackgroundRender::cancel() {
  const std::lock_guard lock(mutex_);
  cancel_locked();
}

void BackgroundRender::stop() {
  {
    const std::lock_guard lock(mutex_);
    cancel_locked();
    stopping_ = true;
  }
  changed_.notify_one();
  if (thread_.joinable()) thread_.join();
}

BackgroundRender::State BackgroundRender::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

int BackgroundRender::start(std::shared_ptr<const LoadedScene> scene, const ScenePatch& patch,
                            const Camera& camera, const RenderSettings& settings, Finish finish,
                            std::function<void()> on_news) {
  auto job = std::make_shared<Job>();
  job->scene = std::move(scene);
  job->patch = patch;
  job->camera = camera;
  job->settings = settings;
  job->finish = std::move(finish);
  job->on_news = std::move(on_news);
  int number = 0;
  {
    const std::lock_guard lock(mutex_);
    cancel_locked();
    number = job->number = ++number_;
    next_ = std::move(job);
    state_.running = true;
    state_.fraction = 0.0;
    state_.seconds_left = 0.0;
  }
  if (!thread_.joinable()) thread_ = std::thread([this] { work(); });
  changed_.notify_one();
  return number;
}

void BackgroundRender::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return stopping_ || next_; });
    if (stopping_) return;
    job_ = std::exchange(next_, nullptr);
    lock.unlock();
    perform(*job_);
    lock.lock();
    job_.reset();
  }
}

void BackgroundRender::perform(Job& job) {
  const auto progress = [&](const RenderProgress& now) {
    {
      const std::lock_guard lock(mutex_);
      if (job.cancelled) return false;
      state_.fraction = now.fraction;
      state_.seconds_left = now.seconds_left;
    }
    job.on_news();
    return true;
  };
  std::string said;
  bool failed = false;
  try {
    RenderStatistics statistics;
    std::optional<Scene> changed;
    if (!job.patch.empty()) {
      changed = job.scene->scene;
      apply_patch(job.patch, *changed);
    }
    const Scene& traced = changed ? *changed : job.scene->scene;
    const Framebuffer picture = render(traced, job.camera, job.settings, statistics, progress);
    if (job.cancelled) return;
    said = job.finish(picture, statistics);
  } catch (const std::bad_alloc&) {
    failed = true;
    said = "out of memory; choose a smaller picture";
  } catch (const std::exception& error) {
    failed = true;
    said = error.what();
  }
  {
    const std::lock_guard lock(mutex_);
    if (job.cancelled) return;
    state_.running = false;
    state_.failed = failed;
    state_.said = said;
    state_.ended = job.number;
  }
  job.on_news();
}

}  // namespace lumivec
