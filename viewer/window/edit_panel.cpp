#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/window/panels.h"

namespace lumivec {
namespace {

// One edit at a time; a gesture is one thing to undo.
class Editor {
 public:
  Editor(std::optional<EditWish>& wish, std::uint64_t gesture) : wish_(wish), gesture_(gesture) {}

  template <class Edit, class Value>
  void change(std::size_t index, const Value& before, const Value& after) {
    Edit edit;
    if constexpr (requires { edit.index; }) edit.index = index;
    edit.before = before;
    edit.after = after;
    wish_.emplace(edit, gesture_);
  }

 private:
  std::optional<EditWish>& wish_;
  std::uint64_t gesture_;
};

// A gesture lasts while one item is held; the frame that takes hold of it belongs to it.
void count_gestures(WindowState& state) {
  const ImGuiID held = ImGui::GetActiveID();
  if (held == 0 || (state.held_item != 0 && held != state.held_item)) ++state.gesture;
  state.held_item = held;
}

// A colour of any strength as a colour up to 1 and a factor.
bool edit_light(const char* label, Color& value) {
  float strength = std::max({value.x, value.y, value.z, 0.0f});
  const float scale = strength > 0.0f ? 1.0f / strength : 0.0f;
  Color tint = strength > 0.0f ? value * scale : Color(1.0f);
  ImGui::PushID(label);
  bool changed = ImGui::ColorEdit3("Colour", &tint.x,
                                   ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs);
  const bool changed_tint = changed;
  ImGui::SameLine();
  if (!changed_tint) {
    const float step = std::max(strength, 0.1f) * 0.01f;
    changed |= ImGui::DragFloat(label, &strength, step, 0.0f, 1e9f, "%.4g");
  }
  ImGui::PopID();
  if (changed) value = tint * std::max(strength, 0.0f);
  return changed;
}

void draw_material(const Material& before, int index, Editor& editor) {
  Material m = before;
  const auto changed = [&](bool is_changed) {
    if (is_changed) editor.change<MaterialEdit>(std::size_t(index), before, m);
  };
  changed(ImGui::ColorEdit3("Base", &m.base_color.x, ImGuiColorEditFlags_Float));
  changed(ImGui::SliderFloat("Roughness", &m.roughness, 0.0f, 1.0f, "%.3f",
                             ImGuiSliderFlags_AlwaysClamp));
  changed(ImGui::SliderFloat("Metallic", &m.metallic, 0.0f, 1.0f, "%.3f",
                             ImGuiSliderFlags_AlwaysClamp));
  changed(ImGui::SliderFloat("Specular", &m.specular, 0.0f, 1.0f, "%.3f",
                             ImGuiSliderFlags_AlwaysClamp));
  changed(ImGui::SliderFloat("Clear coat", &m.clearcoat, 0.0f, 1.0f, "%.3f",
                             ImGuiSliderFlags_AlwaysClamp));
  changed(ImGui::SliderFloat("Transmission", &m.transmission, 0.0f, 1.0f, "%.3f",
                             ImGuiSliderFlags_AlwaysClamp));
  changed(edit_light("Emission", m.emission));
}

// What is typed and dragged stays as it is while the transform is what it makes: angles taken from
// the transform would jump where several mean the same.
void draw_place(WindowState& state, const Imath::Box3d& bounds, const M44d& before, int index,
                Editor& editor) {
  ObjectPlace& place = state.picked_place;
  if (transform_of(place) != before) place = place_of(before);
  const auto edit = [](const char* label, V3d& value, float step, const char* format) {
    float numbers[3] = {float(value.x), float(value.y), float(value.z)};
    const auto shown = std::to_array(numbers);
    if (!ImGui::DragFloat3(label, numbers, step, 0.0f, 0.0f, format)) return false;
    for (int i = 0; i < 3; ++i) {
      if (numbers[i] != shown[std::size_t(i)] && std::isfinite(numbers[i]))
        value[i] = double(numbers[i]);
    }
    return true;
  };
  ObjectPlace wanted = place;
  const float step = float(bounds.size().length()) * 1e-3f;
  bool changed = edit("Place", wanted.place, step, "%.4g");
  changed |= edit("Turn", wanted.turn, 0.5f, "%.1f");
  changed |= edit("Size", wanted.size, 0.01f, "%.4g");
  if (!changed) return;
  // What has no extent cannot be traced; it stays on its side of zero.
  constexpr double least_size = 1e-4;
  for (int i = 0; i < 3; ++i) {
    const double sign = place.size[i] < 0.0 ? -1.0 : 1.0;
    wanted.size[i] = sign * std::max(sign * wanted.size[i], least_size);
  }
  // It turns and grows about its middle, wherever its origin is.
  if (wanted.turn != place.turn || wanted.size != place.size)
    wanted.place += state.picked->center * before - state.picked->center * transform_of(wanted);
  const M44d after = transform_of(wanted);
  if (after == before) return;
  place = wanted;
  editor.change<PlaceEdit>(std::size_t(index), before, after);
}

void draw_lights(const Scene& scene, const ScenePatch& patch, Editor& editor) {
  constexpr std::size_t most = 16;  // more belong in a modeller
  for (std::size_t i = 0; i < std::min(scene.lights.size(), most); ++i) {
    ImGui::PushID(int(i));
    const Light& before = patch.light(scene, i);
    Light light = before;
    const std::string name = light.name.empty() ? "Light " + std::to_string(i) : light.name;
    if (edit_light(name.c_str(), light.intensity)) editor.change<LightEdit>(i, before, light);
    ImGui::PopID();
  }
}

void draw_environment(const Environment& before, Editor& editor) {
  Environment sky = before;
  if (sky.image < 0 && sky.radiance == Color(0.0f)) {
    if (ImGui::Button("Light it with a sky")) {
      sky.radiance = Color(0.5f);
      editor.change<EnvironmentEdit>(0, before, sky);
    }
    return;
  }
  if (edit_light("Sky", sky.radiance)) editor.change<EnvironmentEdit>(0, before, sky);
  if (sky.image < 0) return;
  if (ImGui::SliderAngle("Turn", &sky.rotation, -180.0f, 180.0f))
    editor.change<EnvironmentEdit>(0, before, sky);
}

}  // namespace

void draw_edit_section(WindowState& state, const PanelInput& input, std::optional<EditWish>& edit) {
  if (!ImGui::CollapsingHeader("Lights and materials") || !input.scene) return;
  const Scene& scene = input.scene->scene;
  const ScenePatch& patch = *input.patch;
  count_gestures(state);
  Editor editor(edit, state.gesture);
  const auto instances = int(scene.instances.size());
  const int object = state.picked ? state.picked->object : -1;
  if (object >= 0 && object < instances) {
    ImGui::TextWrapped("%s, material %s", object_name(scene, object).c_str(),
                       material_name(scene, object).c_str());
    const int material = scene.instances[std::size_t(object)].material;
    if (material >= 0)
      draw_material(patch.material(scene, std::size_t(material)), material, editor);
    draw_place(state, input.bounds, patch.place(scene, std::size_t(object)), object, editor);
  } else {
    ImGui::TextWrapped("Double-click an object to change its material.");
  }
  draw_lights(scene, patch, editor);
  draw_environment(patch.sky(scene), editor);
  if (ImGui::Button("Undo (Ctrl+Z)")) state.wishes.undo = true;
  ImGui::SameLine();
  if (ImGui::Button("Redo (Ctrl+Y)")) state.wishes.redo = true;
  ImGui::SameLine();
  ImGui::Text("%zu changes", input.edits_done);
}

}  // namespace lumivec
