#include "viewer/window/engine_thread.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>

#include "integrator/seconds_since.h"
#include "viewer/scene_summary.h"
#include "viewer/window/picture_point.h"

namespace lumivec {
namespace {

// Layers cost as much as five pictures to put together, so there are not many a second.
constexpr double seconds_between_layers = 0.2;
constexpr double layers_share = 0.05;  // of the time, at most

// The middle of an instance's shape, object space.
V3d center_of(const Scene& scene, int instance) {
  const int mesh = scene.instances[std::size_t(instance)].mesh;
  if (mesh < 0) return V3d(0.0);  // spheres lie around their origin
  Imath::Box3f bounds;
  for (const V3f& position : scene.meshes[std::size_t(mesh)].positions) bounds.extendBy(position);
  return bounds.isEmpty() ? V3d(0.0) : V3d(bounds.center());
}

std::string loading(const SceneSource& source) {
  return "loading " + source.file.filename().string();
}

}  // namespace

// What belongs to the thread alone.
class EngineThread::Worker {
 public:
  Worker(TripleBuffer<EnginePicture>& pictures, TripleBuffer<LayerPicture>& layers)
      : pictures_(pictures), layers_(layers) {}

  // Throws what WalkEngine throws, and keeps the old scene then.
  void set_scene(std::shared_ptr<const LoadedScene> scene, std::uint64_t number,
                 const ViewRequest& view) {
    auto engine = make_engine(scene->scene, view, knobs_.light_vectors);
    engine_ = std::move(engine);
    compared_.reset();
    edited_.reset();
    scene_ = std::move(scene);
    scene_number_ = number;
    begin(view);
  }

  // The scene as the user has changed it. The first change makes an engine on a copy that can be
  // changed under it.
  void change_scene(const ScenePatch& patch, const SceneChanges& changes, std::uint64_t number,
                    const ViewRequest& view) {
    if (edited_) {
      apply_patch(patch, *edited_);
      engine_->update(changes);
      if (compared_) compared_->update(changes);
    } else {
      auto edited = std::make_unique<Scene>(scene_->scene);
      apply_patch(patch, *edited);
      engine_ = make_engine(*edited, view, knobs_.light_vectors);
      compared_.reset();
      edited_ = std::move(edited);
      begin(view);
    }
    scene_number_ = number;
    samples_ = 0.0;
    fresh_ = true;
  }

  bool has_scene() const { return engine_ != nullptr; }
  Imath::Box3d bounds() const { return world_bounds(traced()); }
  // EnginePicture::change from now on.
  void count_change(std::uint64_t change) { change_ = change; }

  void set_knobs(const EngineKnobs& knobs, const ViewRequest& view) {
    if (knobs == knobs_) return;
    if (knobs.threads != knobs_.threads) {
      limit_.reset();
      if (knobs.threads > 0) {
        limit_.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(knobs.threads));
      }
    }
    knobs_ = knobs;
    if (!scene_) return;
    engine_ = make_engine(traced(), view, knobs_.light_vectors);
    compared_.reset();
    begin(view);
  }

  bool has_work(const ViewRequest& view, bool changed) const {
    if (!engine_ || view.scene != scene_number_ || view.width <= 0 || view.height <= 0)
      return false;
    if (gave_up_ && !changed) return false;
    return changed || fresh_ || samples_ < view.rest_samples ||
           (view.layers && (layers_of_ != number_ || view.records != records_published_));
  }

  // Not again before something else is asked for.
  void give_up() { gave_up_ = true; }

  void advance(const ViewRequest& view) {
    gave_up_ = false;
    fit(view);
    const bool moved = !last_ || !same_view(*last_, view.camera);
    if (moved) samples_ = 0.0;
    last_ = view.camera;
    fresh_ = false;

    EnginePicture& picture = pictures_.back();
    const double share = view.compare ? 0.5 : 1.0;
    picture.figures =
        engine_->advance(view.camera, share * view.frame_time, view.terms, picture.pixels);
    if (view.compare) {
      if (!compared_) compared_ = make_engine(traced(), view, false);
      compared_->advance(view.camera, share * view.frame_time, view.terms, picture.compared);
    } else {
      compared_.reset();
      picture.compared.clear();
    }
    samples_ += double(picture.figures.traced) / (double(view.width) * double(view.height));
    describe(view, picture);
    if (view.layers && (seconds_since(layers_at_) >
                            std::max(seconds_between_layers, layers_seconds_ / layers_share) ||
                        (samples_ >= view.rest_samples && !moved))) {
      publish_layers(view);
    }
    pictures_.publish();
  }

 private:
  const Scene& traced() const { return edited_ ? *edited_ : scene_->scene; }

  std::unique_ptr<WalkEngine> make_engine(const Scene& scene, const ViewRequest& view,
                                          bool light_vectors) const {
    RenderSettings settings;
    settings.cache_error = knobs_.error;
    settings.threads = knobs_.threads;
    settings.seed = knobs_.seed;
    settings.terms = all_terms;  // what is shown is chosen afterwards
    settings.width = std::max(view.width, 1);
    settings.height = std::max(view.height, 1);
    return std::make_unique<WalkEngine>(scene, settings, WalkMode{Reuse::shading, light_vectors});
  }

  void begin(const ViewRequest& view) {
    width_ = std::max(view.width, 1);
    height_ = std::max(view.height, 1);
    last_.reset();
    samples_ = 0.0;
    fresh_ = true;
  }

  void fit(const ViewRequest& view) {
    if (view.width == width_ && view.height == height_) return;
    width_ = view.width;
    height_ = view.height;
    engine_->resize(width_, height_);
    if (compared_) compared_->resize(width_, height_);
    last_.reset();
  }

  void describe(const ViewRequest& view, EnginePicture& picture) {
    picture.scene = scene_number_;
    picture.number = ++number_;
    picture.change = change_;
    picture.knobs = knobs_;
    picture.width = width_;
    picture.height = height_;
    picture.camera = view.camera;
    picture.terms = view.terms;
    picture.pivot = engine_->pivot();
    picture.samples = samples_;
    picture.records = engine_->statistics().records;
    picture.cache_bytes = engine_->statistics().cache_bytes;
    picture.caches = engine_->caches();
    if (view.pick.number != pick_.number) pick_ = answer(view);
    picture.pick = pick_;
  }

  PickAnswer answer(const ViewRequest& view) const {
    PickAnswer pick;
    pick.number = view.pick.number;
    const int x = std::clamp(int(view.pick.x * width_), 0, width_ - 1);
    const int y = std::clamp(int(view.pick.y * height_), 0, height_ - 1);
    const std::size_t pixel = std::size_t(y) * std::size_t(width_) + std::size_t(x);
    const VisibleSurfaces& seen = engine_->surfaces();
    if (seen.object[pixel] < 0) return pick;
    pick.object = seen.object[pixel];
    pick.center = center_of(scene_->scene, pick.object);
    pick.point =
        point_seen(view.camera, width_, height_, x + 0.5, y + 0.5, double(seen.depth[pixel]));
    if (const std::optional<IncidentLight> light = engine_->incident_light(x, y))
      pick.light = std::make_shared<const IncidentLight>(*light);
    return pick;
  }

  void publish_layers(const ViewRequest& view) {
    const Clock::time_point start = Clock::now();
    LayerPicture& layers = layers_.back();
    layers.scene = scene_number_;
    layers.width = width_;
    layers.height = height_;
    layers.camera = view.camera;
    for (std::size_t t = 0; t < term_count; ++t)
      engine_->layer(static_cast<Term>(t), layers.layers[t]);
    layers.surfaces = engine_->surfaces();
    layers.records.clear();
    if (view.records) layers.records = engine_->records();
    records_published_ = view.records;
    layers_.publish();
    layers_at_ = Clock::now();
    layers_seconds_ = std::chrono::duration<double>(layers_at_ - start).count();
    layers_of_ = number_;
  }

  TripleBuffer<EnginePicture>& pictures_;
  TripleBuffer<LayerPicture>& layers_;
  std::optional<tbb::global_control> limit_;
  EngineKnobs knobs_;
  std::shared_ptr<const LoadedScene> scene_;
  std::uint64_t scene_number_ = 0, change_ = 0;
  std::unique_ptr<Scene> edited_;  // what engines look at once the user has changed something
  std::unique_ptr<WalkEngine> engine_, compared_;
  int width_ = 1, height_ = 1;
  std::optional<Camera> last_;
  double samples_ = 0.0;
  bool fresh_ = false;  // nothing has been shown of this engine
  bool gave_up_ = false;
  std::uint64_t number_ = 0, layers_of_ = 0;
  bool records_published_ = false;  // with the last layers
  PickAnswer pick_;
  Clock::time_point layers_at_ = {};
  double layers_seconds_ = 0.0;  // that the last ones took
};

EngineThread::EngineThread(std::function<void()> on_news)
    : on_news_(std::move(on_news)), thread_([this] { run(); }) {}

EngineThread::~EngineThread() {
  {
    const std::lock_guard lock(mutex_);
    orders_.stop = true;
  }
  wake_.notify_one();
  thread_.join();
}

void EngineThread::open(const SceneSource& source, bool keep_camera) {
  {
    const std::lock_guard lock(mutex_);
    orders_.open = source;
    orders_.keep_camera = keep_camera;
    status_.doing = loading(source);
  }
  wake_.notify_one();
}

std::uint64_t EngineThread::change(const ScenePatch& patch, const SceneChanges& changes,
                                   std::uint64_t opened) {
  std::uint64_t number = 0;
  {
    const std::lock_guard lock(mutex_);
    if (opened != status_.opened_number) return orders_.change;
    if (!orders_.patch) orders_.changes = {};
    orders_.patch = patch;
    orders_.changes.light |= changes.light;
    for (const int instance : changes.moved) {
      std::vector<int>& moved = orders_.changes.moved;
      if (std::find(moved.begin(), moved.end(), instance) == moved.end()) moved.push_back(instance);
    }
    number = ++orders_.change;
  }
  wake_.notify_one();
  return number;
}

void EngineThread::request(const ViewRequest& request) {
  {
    const std::lock_guard lock(mutex_);
    ViewRequest& view = orders_.view;
    if (view.scene == request.scene && same_view(view.camera, request.camera) &&
        view.width == request.width && view.height == request.height &&
        view.terms == request.terms && view.frame_time == request.frame_time &&
        view.rest_samples == request.rest_samples && view.layers == request.layers &&
        view.records == request.records && view.compare == request.compare &&
        view.pick == request.pick) {
      return;
    }
    view = request;
    orders_.view_changed = true;
  }
  wake_.notify_one();
}

void EngineThread::set_knobs(const EngineKnobs& knobs) {
  {
    const std::lock_guard lock(mutex_);
    if (orders_.knobs == knobs) return;
    orders_.knobs = knobs;
    orders_.view_changed = true;
  }
  wake_.notify_one();
}

EngineStatus EngineThread::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void EngineThread::run() {
  Worker worker(pictures_, layers_);
  const auto tell = [this](const std::function<void(EngineStatus&)>& change) {
    {
      const std::lock_guard lock(mutex_);
      change(status_);
    }
    on_news_();
  };
  const auto fail = [&](const std::string& problem) {
    tell([&](EngineStatus& status) {
      if (!orders_.open) status.doing.clear();
      status.error = problem;
      ++status.error_number;
    });
  };
  while (true) {
    Orders orders;
    {
      std::unique_lock lock(mutex_);
      const auto wanted = [&] {
        return orders_.stop || orders_.open || orders_.patch ||
               worker.has_work(orders_.view, orders_.view_changed);
      };
      if (!wanted()) {
        status_.resting = true;
        lock.unlock();
        on_news_();
        lock.lock();
        wake_.wait(lock, wanted);
      }
      status_.resting = false;
      if (orders_.stop) return;
      orders = orders_;
      // Changes of the scene there is wait for whether another one can be opened.
      if (orders.open) {
        orders_.open.reset();
        orders.patch.reset();
      } else if (orders.patch) {
        orders_.patch.reset();
      } else {
        orders_.view_changed = false;
      }
    }
    bool is_new = true;  // the scene, or what it holds
    try {
      std::uint64_t number = 0;
      {
        const std::lock_guard lock(mutex_);
        number = status_.scene_number + 1;
      }
      if (orders.open) {
        tell([&](EngineStatus& status) { status.doing = loading(*orders.open); });
        const std::shared_ptr<const LoadedScene> scene = load_shared_scene(*orders.open);
        worker.set_knobs(orders.knobs, orders.view);
        worker.set_scene(scene, number, orders.view);
        tell([&](EngineStatus& status) {
          if (!orders_.open) status.doing.clear();
          status.scene = scene;
          status.bounds = scene->bounds;
          status.scene_number = number;
          status.error.clear();
          status.keep_camera = orders.keep_camera;
          ++status.opened_number;
          orders_.patch.reset();  // it was of the scene before
          worker.count_change(orders_.change);
        });
        continue;  // the window may want to see the new scene from somewhere else
      }
      if (orders.patch && worker.has_scene()) {
        worker.set_knobs(orders.knobs, orders.view);
        worker.change_scene(*orders.patch, orders.changes, number, orders.view);
        worker.count_change(orders.change);
        const std::optional<Imath::Box3d> bounds =
            orders.changes.moved.empty() ? std::nullopt : std::optional(worker.bounds());
        tell([&](EngineStatus& status) {
          status.scene_number = number;
          if (bounds) status.bounds = *bounds;
        });
        continue;
      }
      is_new = false;
      worker.set_knobs(orders.knobs, orders.view);
      if (worker.has_work(orders.view, orders.view_changed)) {
        worker.advance(orders.view);
        on_news_();
      }
    } catch (const std::bad_alloc&) {
      if (!is_new) worker.give_up();
      fail("out of memory; choose larger pixels or a smaller window");
    } catch (const std::exception& error) {
      if (!is_new) worker.give_up();
      fail(error.what());
    }
  }
}

}  // namespace lumivec
