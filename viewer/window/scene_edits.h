// Changes of lights, materials and places that the user tries out in the window: gathered in a
// patch of the scene, undone and redone; neither the scene nor the file is ever written.
#pragma once

#include <variant>
#include <vector>

#include "integrator/live_tracer.h"
#include "viewer/window/scene_patch.h"

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
  // Of another scene: what was done to the last one is forgotten.
  void begin() { *this = SceneEdits(); }

  // Edits of the same thing that follow one another within a gesture are one to undo: they have the
  // same number, other than 0.
  void apply(const SceneEdit& edit, std::uint64_t gesture);
  // False: there is nothing to undo or redo.
  bool undo();
  bool redo();

  // What all of it comes to.
  const ScenePatch& patch() const { return patch_; }
  // Of the last call of apply, undo or redo that did anything.
  const SceneChanges& changes() const { return changes_; }

  std::size_t done() const { return done_.size(); }
  std::size_t undone() const { return undone_.size(); }

 private:
  void set(const SceneEdit& edit, bool forward);

  std::vector<SceneEdit> done_, undone_;
  std::uint64_t gesture_ = 0;  // of the last edit done; 0: none goes on with it
  ScenePatch patch_;
  SceneChanges changes_;
};

}  // namespace lumivec
