#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <utility>

#include "viewer/text_format.h"
#include "viewer/window/panels.h"

namespace lumivec {
namespace {

constexpr float panel_letters = 42.0f;  // widths of text that the panel is wide

// Told apart by brightness too, for eyes that do not tell all hues apart.
ImU32 term_color(int term, bool shown) {
  constexpr std::array<std::array<int, 3>, term_count> colors = {
      {{250, 225, 110}, {90, 170, 240}, {235, 130, 40}, {60, 140, 75}, {190, 110, 200}}};
  const auto& c = colors[std::size_t(term)];
  return IM_COL32(c[0], c[1], c[2], shown ? 255 : 70);
}

bool choice(const char* label, const std::vector<std::string>& names, std::string& chosen) {
  bool changed = false;
  if (!ImGui::BeginCombo(label, chosen.c_str())) return false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names[i];
    const bool is_chosen = name == chosen;
    ImGui::PushID(int(i));
    if (ImGui::Selectable(name.empty() ? "of the view" : name.c_str(), is_chosen) && !is_chosen) {
      chosen = name;
      changed = true;
    }
    ImGui::PopID();
  }
  ImGui::EndCombo();
  return changed;
}

// A knob that needs another engine: it takes effect when its slider is let go.
template <class Value>
void take_when_let_go(std::optional<Value>& pending, Value& knob) {
  if (!pending || ImGui::IsItemActive()) return;
  knob = *std::exchange(pending, std::nullopt);
}

// What each term adds to the light of the picture: one bar of five parts. Those that are switched
// off are dim; pointing at one tells which it is.
void draw_stack(const WindowState& state, const PanelInput& input) {
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  const float height = ImGui::GetTextLineHeight() + 6.0f;
  ImGui::Dummy(ImVec2(width, height));
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(from, ImVec2(from.x + width, from.y + height), IM_COL32(10, 10, 10, 255));
  float left = from.x;
  for (std::size_t t = 0; t < std::size_t(term_count); ++t) {
    const float right = left + width * float(input.shares[t]);
    const bool shown = (state.terms >> t & 1u) != 0;
    const ImVec2 low(left, from.y), high(right, from.y + height);
    list->AddRectFilled(low, high, term_color(int(t), shown));
    if (right > left && ImGui::IsMouseHoveringRect(low, high))
      ImGui::SetTooltip("%s %.1f%%", term_names[t].data(), 100.0 * input.shares[t]);
    left = right;
  }
}

void draw_light(WindowState& state, const PanelInput& input) {
  if (!ImGui::CollapsingHeader("Light", ImGuiTreeNodeFlags_DefaultOpen)) return;
  draw_stack(state, input);
  for (int t = 0; t < term_count; ++t) {
    ImGui::PushID(t);
    bool shown = (state.terms >> unsigned(t) & 1u) != 0;
    char label[48];
    std::snprintf(label, sizeof(label), "%d %s", t + 1, term_names[std::size_t(t)].data());
    if (ImGui::Checkbox(label, &shown)) state.toggle_term(t);
    ImGui::SameLine(ImGui::GetFontSize() * 8.5f);
    if (ImGui::SmallButton("solo")) state.solo_term(t);
    ImGui::SameLine();
    const double share = input.shares[std::size_t(t)];
    char text[16];
    std::snprintf(text, sizeof(text), "%.1f%%", 100.0 * share);
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, term_color(t, true));
    ImGui::ProgressBar(float(share), ImVec2(-1.0f, ImGui::GetTextLineHeight() + 4.0f), text);
    ImGui::PopStyleColor();
    ImGui::PopID();
  }
  ImGui::Checkbox("Wipe with path tracing (V)", &state.wipe);
  ImGui::Checkbox("Error map (M)", &state.error_map);
  if (state.error_map && input.reference.running)
    ImGui::ProgressBar(float(input.reference.fraction), ImVec2(-1.0f, 0.0f), "reference");
}

void draw_display(WindowState& state, const DisplayNames& names) {
  if (!ImGui::CollapsingHeader("Display", ImGuiTreeNodeFlags_DefaultOpen)) return;
  auto exposure = float(state.look.exposure);
  if (ImGui::SliderFloat("Exposure", &exposure, -10.0f, 10.0f, "%+.2f stops"))
    state.look.exposure = double(exposure);
  DisplayOptions wanted = names.chosen;
  bool changed = choice("Display", names.displays, wanted.display);
  if (changed) wanted.view.clear();
  changed |= choice("View", names.views, wanted.view);
  if (!names.looks.empty()) {
    std::vector<std::string> looks = {""};
    looks.insert(looks.end(), names.looks.begin(), names.looks.end());
    changed |= choice("Look", looks, wanted.look);
  }
  if (changed) state.wishes.display = wanted;
  int channel = int(state.look.channel);
  if (ImGui::Combo("Channel", &channel, channel_names.data(), int(channel_names.size())))
    state.look.channel = Channel(channel);
  int layer = int(state.layer);
  if (ImGui::Combo("Layer", &layer, layer_names.data(), int(layer_names.size())))
    state.layer = Layer(layer);
  bool bands = state.look.mode == DisplayMode::false_color;
  if (ImGui::Checkbox("False colour (G)", &bands))
    state.look.mode = bands ? DisplayMode::false_color : DisplayMode::view;
  ImGui::SameLine();
  bool nan = state.look.mode == DisplayMode::nan_map;
  if (ImGui::Checkbox("NaN map (N)", &nan))
    state.look.mode = nan ? DisplayMode::nan_map : DisplayMode::view;
  ImGui::Checkbox("Histogram (H)", &state.show_histogram);
  ImGui::SameLine();
  ImGui::Checkbox("Inspector (I)", &state.show_inspector);
  ImGui::Checkbox("Records of cached light (J)", &state.show_records);
}

void draw_camera(WindowState& state, const PanelInput& input) {
  if (!ImGui::CollapsingHeader("Camera")) return;
  if (input.scene) {
    const std::vector<Camera>& cameras = input.scene->scene.cameras;
    const auto name = [&](std::size_t i) {
      return cameras[i].name.empty() ? "camera " + std::to_string(i) : cameras[i].name;
    };
    const auto current = std::min(std::size_t(state.file_camera), cameras.size() - 1);
    if (ImGui::BeginCombo("Of the file", name(current).c_str())) {
      for (std::size_t i = 0; i < cameras.size(); ++i) {
        ImGui::PushID(int(i));  // files may give several the same name
        if (ImGui::Selectable(name(i).c_str(), i == current)) {
          state.file_camera = int(i);
          state.camera.take(cameras[i], state.camera.pivot());
        }
        ImGui::PopID();
      }
      ImGui::EndCombo();
    }
  }
  Camera camera = state.camera.camera();
  if (camera.kind == CameraKind::perspective) {
    constexpr float degrees = 57.29578f;
    float angle = camera.yfov * degrees;
    if (ImGui::SliderFloat("Height", &angle, 5.0f, 140.0f, "%.1f degrees")) {
      camera.yfov = std::clamp(angle, 1.0f, 170.0f) / degrees;
      state.camera.take(camera, state.camera.pivot());
    }
  }
  const V3d eye = state.camera.eye();
  ImGui::Text("Eye %.4g, %.4g, %.4g", eye.x, eye.y, eye.z);
  const V3d pivot = state.camera.pivot();
  ImGui::Text("Pivot %.4g, %.4g, %.4g", pivot.x, pivot.y, pivot.z);
  if (ImGui::Button("Copy")) state.wishes.copy_view = true;
  ImGui::SameLine();
  if (ImGui::Button("Paste")) state.wishes.paste_view = true;
  ImGui::SameLine();
  if (ImGui::Button("Level")) state.camera.level();
  ImGui::TextUnformatted("Kept views: Ctrl+digit, Alt+digit");
  for (std::size_t i = 0; i < state.kept_views.size(); ++i) {
    ImGui::PushID(int(i));
    if (i % 5 != 0) ImGui::SameLine();
    char label[8];
    std::snprintf(label, sizeof(label), "%s%zu", state.kept_views[i] ? "" : "+", i);
    if (ImGui::Button(label, ImVec2(ImGui::GetFontSize() * 2.6f, 0.0f))) {
      if (state.kept_views[i]) {
        state.camera = *state.kept_views[i];
      } else {
        state.kept_views[i] = state.camera;
      }
    }
    ImGui::PopID();
  }
  ImGui::Text("Camera path: %zu keys", state.path_keys.size());
  if (ImGui::Button("Add (K)")) state.path_keys.push_back(state.camera);
  ImGui::SameLine();
  if (ImGui::Button("Play")) state.wishes.path_play = true;
  ImGui::SameLine();
  if (ImGui::Button("Save")) state.wishes.path_save = true;
  ImGui::SameLine();
  if (ImGui::Button("Clear")) state.path_keys.clear();
}

void draw_rendering(WindowState& state, const PanelInput& input) {
  if (!ImGui::CollapsingHeader("Rendering")) return;
  if (ImGui::Button(state.paused ? "Go on" : "Pause")) state.paused = !state.paused;
  ImGui::SameLine();
  if (ImGui::Button("Begin again")) ++state.knobs.restarts;
  int method = state.knobs.light_vectors ? 0 : 1;
  if (ImGui::Combo("Method", &method, "light-vectors\0path\0"))
    state.knobs.light_vectors = method == 0;
  auto error = float(100.0 * state.pending_error.value_or(state.knobs.error));
  if (ImGui::SliderFloat("Error", &error, 0.1f, 20.0f, "%.2f%%", ImGuiSliderFlags_Logarithmic))
    state.pending_error = std::clamp(double(error), 0.01, 100.0) / 100.0;
  take_when_let_go(state.pending_error, state.knobs.error);
  auto time = float(1e3 * state.settings.frame_time);
  if (ImGui::SliderFloat("Frame", &time, 5.0f, 500.0f, "%.0f ms", ImGuiSliderFlags_Logarithmic))
    state.settings.frame_time = std::clamp(double(time), 1.0, 10000.0) / 1e3;
  int threads = state.pending_threads.value_or(state.knobs.threads);
  if (ImGui::SliderInt("Threads", &threads, 0, int(std::thread::hardware_concurrency()),
                       threads == 0 ? "all" : "%d"))
    state.pending_threads = std::clamp(threads, 0, 1024);
  take_when_let_go(state.pending_threads, state.knobs.threads);
  ImGui::SliderInt("Pixel size", &state.settings.pixel_size, 0, 8,
                   state.settings.pixel_size == 0 ? "by itself" : "%d");
  state.settings.pixel_size = std::clamp(state.settings.pixel_size, 0, 16);
  auto rest = float(state.settings.rest_samples);
  if (ImGui::SliderFloat("Rest at", &rest, 1.0f, 65536.0f, "%.0f samples",
                         ImGuiSliderFlags_Logarithmic))
    state.settings.rest_samples = std::clamp(double(rest), 1.0, 1e6);
  ImGui::Text("Caches: %s records, %s", format_count(input.figures.records).c_str(),
              format_bytes(input.figures.cache_bytes).c_str());
  ImGui::Text("Hits in the last frame: %.1f%%", 100.0 * input.figures.hit_rate);
}

void draw_export(WindowState& state, const PanelInput& input) {
  if (!ImGui::CollapsingHeader("Still and files")) return;
  StillWish& still = state.still;
  ImGui::Checkbox("As large as the window", &still.size_follows_window);
  if (!still.size_follows_window) {
    int size[2] = {still.size.width, still.size.height};
    if (ImGui::InputInt2("Pixels", size)) {
      still.size.width = std::clamp(size[0], 1, max_picture_side);
      still.size.height = std::clamp(size[1], 1, max_picture_side);
    }
  }
  if (ImGui::InputInt("Samples", &still.samples))
    still.samples = std::clamp(still.samples, 1, max_picture_samples);
  ImGui::Checkbox("Path tracing", &still.path_tracing);
  ImGui::Checkbox("OpenEXR, all layers", &still.exr);
  ImGui::SameLine();
  ImGui::Checkbox("PNG", &still.png);
  if (input.still.running) {
    const std::string left = format_duration(input.still.seconds_left) + " left";
    ImGui::ProgressBar(float(input.still.fraction), ImVec2(-1.0f, 0.0f), left.c_str());
    if (ImGui::Button("Stop")) state.wishes.cancel_export = true;
  } else if (ImGui::Button("Render (Ctrl+S)")) {
    state.wishes.export_still = true;
  }
  ImGui::SameLine();
  if (ImGui::Button("Screenshot (F12)")) state.wishes.screenshot = true;
  if (ImGui::Button("Reload (F5)")) state.wishes.reload = true;
  ImGui::SameLine();
  if (ImGui::Button("Recent files (Ctrl+O)")) state.show_files = true;
}

}  // namespace

float panel_width(float window_width, float text_size) {
  constexpr float most_share = 0.45f;
  constexpr float letter = 0.55f;  // of the text's height
  return std::min(panel_letters * letter * text_size, most_share * window_width);
}

float status_height(float text_size) {
  return text_size + 8.0f;
}

void draw_side_panel(WindowState& state, const PanelInput& input, const DisplayNames& names,
                     std::optional<EditWish>& edit) {
  const float width = input.width - input.picture_width;
  ImGui::SetNextWindowPos(ImVec2(input.picture_width, 0.0f));
  ImGui::SetNextWindowSize(ImVec2(width, input.picture_height));
  ImGui::Begin("##panel", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   ImGuiWindowFlags_NoNavInputs);
  ImGui::PushItemWidth(-ImGui::GetFontSize() * 6.5f);
  draw_light(state, input);
  draw_display(state, names);
  draw_camera(state, input);
  draw_rendering(state, input);
  draw_edit_section(state, input, edit);
  draw_export(state, input);
  ImGui::PopItemWidth();
  ImGui::End();
}

}  // namespace lumivec
