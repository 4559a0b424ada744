#include "viewer/window/scene_edits.h"

namespace lumivec {
namespace {

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

void SceneEdits::set(const SceneEdit& edit, bool forward) {
  const auto value = [forward](const auto& e) { return forward ? e.after : e.before; };
  if (const auto* m = std::get_if<MaterialEdit>(&edit)) {
    patch_.materials[m->index] = value(*m);
  } else if (const auto* l = std::get_if<LightEdit>(&edit)) {
    patch_.lights[l->index] = value(*l);
  } else if (const auto* p = std::get_if<PlaceEdit>(&edit)) {
    patch_.places[p->index] = value(*p);
  } else if (const auto* e = std::get_if<EnvironmentEdit>(&edit)) {
    patch_.environment = value(*e);
  }
  changes_ = changes_of(edit);
}

void SceneEdits::apply(const SceneEdit& edit, std::uint64_t gesture) {
  undone_.clear();
  const bool goes_on = gesture != 0 && gesture == gesture_ && !done_.empty();
  if (!goes_on || !join(done_.back(), edit)) done_.push_back(edit);
  gesture_ = gesture;
  set(edit, true);
}

bool SceneEdits::undo() {
  if (done_.empty()) return false;
  gesture_ = 0;
  undone_.push_back(done_.back());
  done_.pop_back();
  set(undone_.back(), false);
  return true;
}

bool SceneEdits::redo() {
  if (undone_.empty()) return false;
  gesture_ = 0;
  done_.push_back(undone_.back());
  undone_.pop_back();
  set(done_.back(), true);
  return true;
}

}  // namespace lumivec
