// The engine of the walk on a thread of its own: the window says what it wants to see and takes
// the latest picture there is; neither waits for the other. Scenes are loaded there too, so that
// the window answers meanwhile, and one that cannot be loaded leaves the old one in place.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "integrator/live_tracer.h"
#include "integrator/settings.h"
#include "integrator/visible_surfaces.h"
#include "viewer/walk/walk_engine.h"
#include "viewer/window/loaded_scene.h"
#include "viewer/window/scene_patch.h"
#include "viewer/window/triple_buffer.h"

namespace lumivec {

constexpr std::uint32_t all_terms = (1u << term_count) - 1;

// A question what is at a place of the picture, shares of its width and height from the upper left
// corner. A new number makes a new question.
struct PickQuestion {
  std::uint64_t number = 0;
  double x = 0.0, y = 0.0;

  bool operator==(const PickQuestion&) const = default;
};
struct PickAnswer {
  std::uint64_t number = 0;
  int object = -1;                             // index into Scene::instances; -1: nothing is there
  V3d point{0.0};                              // world space
  V3d center{0.0};                             // of the object, in its own space
  std::shared_ptr<const IncidentLight> light;  // that arrives there; null: nothing is there
};

struct ViewRequest {
  std::uint64_t scene = 0;  // that it is about: EngineStatus::scene_number; waits for it
  Camera camera;
  int width = 0, height = 0;  // pixels; 0: nothing is to be seen
  std::uint32_t terms = all_terms;
  double frame_time = 0.033;  // seconds
  // Work on a view that rests ends at so many samples a pixel; 0: once it is seen at all.
  double rest_samples = 4096.0;
  bool layers = false;   // are they wanted, now and then?
  bool records = false;  // with them?
  bool compare = false;  // is a path-traced picture wanted too?
  PickQuestion pick;
};

// What needs another engine.
struct EngineKnobs {
  double error = 0.01;  // RenderSettings::cache_error
  bool light_vectors = true;
  int threads = 0;  // 0: all processors
  std::uint64_t seed = 0;
  int restarts = 0;  // another number: begin again

  bool operator==(const EngineKnobs&) const = default;
};

struct EnginePicture {
  std::uint64_t scene = 0;  // EngineStatus::scene_number
  std::uint64_t number = 0;
  std::uint64_t change = 0;  // EngineThread::change: the last one that it shows
  EngineKnobs knobs;         // of the engine that made it
  int width = 0, height = 0;
  Camera camera;
  std::uint32_t terms = 0;
  std::vector<Color> pixels;    // radiance of those terms
  std::vector<Color> compared;  // the same by path tracing; empty unless asked for
  WalkEngine::Frame figures;
  V3d pivot{0.0};        // WalkEngine::pivot
  double samples = 0.0;  // a pixel, mean, since the view came to rest
  std::uint64_t records = 0, cache_bytes = 0;
  WalkEngine::Caches caches;
  PickAnswer pick;
};

// One view in full; made a few times a second.
struct LayerPicture {
  std::uint64_t scene = 0;
  int width = 0, height = 0;
  Camera camera;
  std::array<std::vector<Color>, term_count> layers;  // radiance
  VisibleSurfaces surfaces;
  std::vector<RecordMark> records;  // if they were asked for
};

struct EngineStatus {
  std::string doing;                         // "loading FILE"; empty: nothing that takes long
  std::string error;                         // of the last thing that failed; empty: none
  std::uint64_t error_number = 0;            // counts them
  std::shared_ptr<const LoadedScene> scene;  // as the file has it
  Imath::Box3d bounds;                       // of the scene as the user has changed it, world space
  std::uint64_t scene_number = 0;            // counts scenes and changes of them
  std::uint64_t opened_number = 0;           // counts files that were opened
  bool keep_camera = false;                  // as the last of them was asked for
  bool resting = false;                      // there is nothing to do
};

class EngineThread {
 public:
  // on_news is called on the thread when there is something new to show.
  explicit EngineThread(std::function<void()> on_news);
  ~EngineThread();  // within about a frame's time
  EngineThread(const EngineThread&) = delete;
  EngineThread& operator=(const EngineThread&) = delete;

  // keep_camera: for the status once it is open.
  void open(const SceneSource& source, bool keep_camera = false);
  // The scene there is, changed by the user: patch is all that differs from the file's, `changes`
  // what has become different by this call. Cached light is kept where it can be. `opened` is the
  // status's opened_number that the patch is of: has no effect once another file is open. Returns a
  // number that EnginePicture::change reaches once this is seen, or no longer waited for. Takes no
  // longer for a large scene than for a small one.
  std::uint64_t change(const ScenePatch& patch, const SceneChanges& changes, std::uint64_t opened);
  void request(const ViewRequest& request);
  void set_knobs(const EngineKnobs& knobs);

  // For one thread, the window's.
  bool take_picture() { return pictures_.take(); }
  const EnginePicture& picture() const { return pictures_.front(); }
  bool take_layers() { return layers_.take(); }
  const LayerPicture& layers() const { return layers_.front(); }

  EngineStatus status() const;

 private:
  struct Orders {
    std::optional<SceneSource> open;
    bool keep_camera = false;  // when it is open
    std::optional<ScenePatch> patch;
    SceneChanges changes;  // since the patch that the thread knows
    std::uint64_t change = 0;
    ViewRequest view;
    EngineKnobs knobs;
    bool view_changed = false;
    bool stop = false;
  };
  class Worker;

  void run();

  std::function<void()> on_news_;
  mutable std::mutex mutex_;  // held for moments, never while anything is computed
  std::condition_variable wake_;
  Orders orders_;
  EngineStatus status_;
  TripleBuffer<EnginePicture> pictures_;
  TripleBuffer<LayerPicture> layers_;
  std::thread thread_;
};

}  // namespace lumivec
