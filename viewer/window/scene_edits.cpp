#include "viewer/window/scene_edits.h"

#include "viewer/scene_summary.h"

namespace lumivec {
namespace {

std::shared_ptr<const LoadedScene> changed(const LoadedScene& scene, const SceneEdit& edit,
                                           bool forward) {
  auto copy = std::make_shared<LoadedScene>(scene);
  const auto value = [forward](const auto& e) { return forward ? e.after : e.before; };
  if (const auto* m = std::get_if<MaterialEdit>(&edit)) {
    copy->scene.materials.at(m->index) = value(*m);
  } else if (const auto* l = std::get_if<LightEdit>(&edit)) {
    copy->scene.lights.at(l->index) = value(*l);
  } else if (const auto* p = std::get_if<PlaceEdit>(&edit)) {
    copy->scene.instances.at(p->index).object_to_world = value(*p);
    copy->bounds = world_bounds(copy->scene);
  } else if (const auto* e = std::get_if<EnvironmentEdit>(&edit)) {
    copy->scene.environment = value(*e);
  }
  return copy;
}

// What the later of two edits of the same thing leaves to undo.
bool join(SceneEdit& last, const SceneEdit& next) {
  const auto joined = [&]<class T>(T*) {
    auto* a = std::get_if<T>(&last);
    const auto* b = std::get_if<T>(&next);
    if (!a || !b) return false;
    if constexpr (requires { a->index; }) {
      if (a->index != b->index) return false;
    }
    a->after = b->after;
    return true;
  };
  return joined(static_cast<MaterialEdit*>(nullptr)) || joined(static_cast<LightEdit*>(nullptr)) ||
         joined(static_cast<PlaceEdit*>(nullptr)) || joined(static_cast<EnvironmentEdit*>(nullptr));
}

}  // namespace

SceneChanges changes_of(const SceneEdit& edit) {
  SceneChanges changes;
  if (const auto* place = std::get_if<PlaceEdit>(&edit)) {
    changes.moved = {int(place->index)};
  } else {
    changes.light = true;
  }
  return changes;
}

std::shared_ptr<const LoadedScene> SceneEdits::apply(const LoadedScene& scene,
                                                     const SceneEdit& edit, std::uint64_t gesture) {
  undone_.clear();
  changes_ = changes_of(edit);
  const bool goes_on = gesture != 0 && gesture == gesture_ && !done_.empty();
  if (!goes_on || !join(done_.back(), edit)) done_.push_back(edit);
  gesture_ = gesture;
  return changed(scene, edit, true);
}

std::shared_ptr<const LoadedScene> SceneEdits::undo(const LoadedScene& scene) {
  if (done_.empty()) return nullptr;
  gesture_ = 0;
  undone_.push_back(done_.back());
  done_.pop_back();
  changes_ = changes_of(undone_.back());
  return changed(scene, undone_.back(), false);
}

std::shared_ptr<const LoadedScene> SceneEdits::redo(const LoadedScene& scene) {
  if (undone_.empty()) return nullptr;
  gesture_ = 0;
  done_.push_back(undone_.back());
  undone_.pop_back();
  changes_ = changes_of(done_.back());
  return changed(scene, done_.back(), true);
}

}  // namespace lumivec
