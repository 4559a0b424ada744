#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
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
    wish_ = EditWish{edit, gesture_};
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

void draw_material(const LoadedScene& scene, int index, Editor& editor) {
  const Material& before = scene.scene.materials[std::size_t(index)];
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

void draw_place(const LoadedScene& scene, int index, Editor& editor) {
  const Instance& instance = scene.scene.instances[std::size_t(index)];
  const M44d before = instance.object_to_world;
  float place[3] = {float(before[3][0]), float(before[3][1]), float(before[3][2])};
  const float step = float(scene.bounds.size().length()) * 1e-3f;
  if (!ImGui::DragFloat3("Place", place, step, 0.0f, 0.0f, "%.4g")) return;
  M44d after = before;
  for (int i = 0; i < 3; ++i) {
    if (std::isfinite(place[i])) after[3][i] = double(place[i]);
  }
  editor.change<PlaceEdit>(std::size_t(index), before, after);
}

void draw_lights(const LoadedScene& scene, Editor& editor) {
  const std::vector<Light>& lights = scene.scene.lights;
  constexpr std::size_t most = 16;  // more belong in a modeller
  for (std::size_t i = 0; i < std::min(lights.size(), most); ++i) {
    ImGui::PushID(int(i));
    Light light = lights[i];
    const std::string name = light.name.empty() ? "Light " + std::to_string(i) : light.name;
    if (edit_light(name.c_str(), light.intensity)) editor.change<LightEdit>(i, lights[i], light);
    ImGui::PopID();
  }
}

void draw_environment(const LoadedScene& scene, Editor& editor) {
  const Environment& before = scene.scene.environment;
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
  const LoadedScene& scene = *input.scene;
  count_gestures(state);
  Editor editor(edit, state.gesture);
  const auto instances = int(scene.scene.instances.size());
  const int object = state.picked ? state.picked->object : -1;
  if (object >= 0 && object < instances) {
    ImGui::TextWrapped("%s, material %s", object_name(scene.scene, object).c_str(),
                       material_name(scene.scene, object).c_str());
    const int material = scene.scene.instances[std::size_t(object)].material;
    if (material >= 0) draw_material(scene, material, editor);
    draw_place(scene, object, editor);
  } else {
    ImGui::TextWrapped("Double-click an object to change its material.");
  }
  draw_lights(scene, editor);
  draw_environment(scene, editor);
  if (ImGui::Button("Undo (Ctrl+Z)")) state.wishes.undo = true;
  ImGui::SameLine();
  if (ImGui::Button("Redo (Ctrl+Y)")) state.wishes.redo = true;
  ImGui::SameLine();
  ImGui::Text("%zu changes", input.edits_done);
}

}  // namespace lumivec
