// Changes of lights and materials that the user tries out in the window: applied to a copy of the
// scene, undone and redone; the file is never written.
#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "integrator/live_tracer.h"
#include "viewer/window/loaded_scene.h"

namespace lumivec {

struct MaterialEdit {
  std::size_t index = 0;  // into Scene::materials
  Material before, after;
};
struct LightEdit {
  std::size_t index = 0;  // into Scene::lights
  Light before, after;
};
struct PlaceEdit {
  std::size_t index = 0;  // into Scene::instances
  M44d before, after;     // object_to_world
};
struct EnvironmentEdit {
  Environment before, after;
};
using SceneEdit = std::variant<MaterialEdit, LightEdit, PlaceEdit, EnvironmentEdit>;

// What the engine is to know of it.
SceneChanges changes_of(const SceneEdit& edit);

class SceneEdits {
 public:
  // The scene that edits start from; what was done to another one is forgotten.
  void begin() { done_.clear(), undone_.clear(), gesture_ = 0; }

  // The scene with the edit. Edits of the same thing that follow one another within a gesture are
  // one to undo: they have the same number, other than 0.
  std::shared_ptr<const LoadedScene> apply(const LoadedScene& scene, const SceneEdit& edit,
                                           std::uint64_t gesture);
  // Nothing to undo or redo: null.
  std::shared_ptr<const LoadedScene> undo(const LoadedScene& scene);
  std::shared_ptr<const LoadedScene> redo(const LoadedScene& scene);

  // Of the last call of apply, undo or redo that returned a scene.
  const SceneChanges& changes() const { return changes_; }

  std::size_t done() const { return done_.size(); }
  std::size_t undone() const { return undone_.size(); }

 private:
  std::vector<SceneEdit> done_, undone_;
  std::uint64_t gesture_ = 0;  // of the last edit done; 0: none goes on with it
  SceneChanges changes_;
};

}  // namespace lumivec
