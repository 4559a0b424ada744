#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "viewer/exposure.h"
#include "viewer/text_format.h"
#include "viewer/window/false_color.h"
#include "viewer/window/key_table.h"
#include "viewer/window/panels.h"
#include "viewer/window/picture_point.h"
#include "viewer/window/record_view.h"

namespace lumivec {
namespace {

constexpr ImGuiWindowFlags bare = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                  ImGuiWindowFlags_NoSavedSettings |
                                  ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                  ImGuiWindowFlags_AlwaysAutoResize;
constexpr float margin = 8.0f;

void draw_help(WindowState& state, const PanelInput& input) {
  ImGui::SetNextWindowPos(ImVec2(input.width * 0.5f, input.height * 0.5f), ImGuiCond_Always,
                          ImVec2(0.5f, 0.5f));
  const float letters = 78.0f * 0.55f * ImGui::GetFontSize();
  ImGui::SetNextWindowSize(
      ImVec2(std::min(letters, input.width - 2.0f * margin), input.height - 4.0f * margin));
  ImGui::SetNextWindowBgAlpha(1.0f);
  ImGui::SetNextWindowFocus();
  bool open = true;
  ImGui::Begin("Keys and mouse (F1)", &open,
               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoSavedSettings);
  std::string_view group;
  for (const KeyRow& row : key_table()) {
    if (row.group != group) {
      if (!group.empty()) ImGui::Spacing();
      group = row.group;
      ImGui::TextColored(ImVec4(1.0f, 0.8f, 0.4f, 1.0f), "%.*s", int(group.size()), group.data());
    }
    ImGui::Text("  %.*s", int(row.keys.size()), row.keys.data());
    ImGui::SameLine(ImGui::GetFontSize() * 0.55f * 28.0f);
    ImGui::TextWrapped("%.*s", int(row.does.size()), row.does.data());
  }
  ImGui::End();
  if (!open) state.show_help = false;
}

void draw_histogram(const PanelInput& input) {
  if (!input.histogram) return;
  const float width = std::min(input.picture_width - 2.0f * margin, 26.0f * ImGui::GetFontSize());
  const float height = 7.0f * ImGui::GetFontSize();
  ImGui::SetNextWindowPos(ImVec2(margin, input.picture_height - margin), ImGuiCond_Always,
                          ImVec2(0.0f, 1.0f));
  ImGui::SetNextWindowBgAlpha(0.8f);
  ImGui::Begin("##histogram", nullptr, bare);
  const ImVec2 from = ImGui::GetCursorScreenPos();
  ImGui::Dummy(ImVec2(width, height));
  ImDrawList* list = ImGui::GetWindowDrawList();
  list->AddRectFilled(from, ImVec2(from.x + width, from.y + height), IM_COL32(10, 10, 10, 255));
  float most = 1.0f;
  for (const auto& counts : input.histogram->counts)
    most = std::max(most, *std::max_element(counts.begin(), counts.end()));
  const std::array<ImU32, 4> colors = {IM_COL32(200, 200, 200, 90), IM_COL32(255, 80, 80, 255),
                                       IM_COL32(80, 230, 80, 255), IM_COL32(100, 140, 255, 255)};
  const float step = width / float(Histogram::bin_count);
  for (std::size_t c = 0; c < colors.size(); ++c) {
    const auto& counts = input.histogram->counts[c];
    for (int i = 0; i < Histogram::bin_count; ++i) {
      const float level = height * counts[std::size_t(i)] / most;
      const float x = from.x + step * float(i), y = from.y + height - level;
      if (c == 0) {
        list->AddRectFilled(ImVec2(x, y), ImVec2(x + step, from.y + height), colors[c]);
      } else if (i > 0) {
        const float last = height * counts[std::size_t(i - 1)] / most;
        list->AddLine(ImVec2(x - 0.5f * step, from.y + height - last), ImVec2(x + 0.5f * step, y),
                      colors[c]);
      }
    }
  }
  const float gray =
      from.x - Histogram::first_stop / (Histogram::last_stop - Histogram::first_stop) * width;
  list->AddLine(ImVec2(gray, from.y), ImVec2(gray, from.y + height), IM_COL32(255, 255, 255, 90));
  ImGui::Text("%+.0f to %+.0f stops from middle grey; black %zu, below %zu, above %zu",
              double(Histogram::first_stop), double(Histogram::last_stop), input.histogram->black,
              input.histogram->below, input.histogram->above);
  ImGui::End();
}

void draw_inspector(const PanelInput& input) {
  const LayerPicture* layers = input.layers;
  ImGui::SetNextWindowPos(ImVec2(margin, margin));
  ImGui::SetNextWindowBgAlpha(0.8f);
  ImGui::Begin("##inspector", nullptr, bare);
  if (!layers || layers->width == 0 || !input.mouse || !input.scene) {
    ImGui::TextUnformatted("Values under the mouse: point at the picture");
    ImGui::End();
    return;
  }
  const int x = std::clamp(int((*input.mouse)[0] * layers->width), 0, layers->width - 1);
  const int y = std::clamp(int((*input.mouse)[1] * layers->height), 0, layers->height - 1);
  const std::size_t pixel = std::size_t(y) * std::size_t(layers->width) + std::size_t(x);
  Color sum(0.0f);
  ImGui::Text("Pixel %d, %d", x, y);
  for (std::size_t t = 0; t < term_count; ++t) {
    const Color& c = layers->layers[t][pixel];
    sum += c;
    ImGui::Text("%-9s %10.5g %10.5g %10.5g", term_names[t].data(), double(c.x), double(c.y),
                double(c.z));
  }
  ImGui::Text("%-9s %10.5g %10.5g %10.5g", "all", double(sum.x), double(sum.y), double(sum.z));
  const float bright = luminance(sum);
  if (bright > 0.0f) {
    ImGui::Text("luminance %10.5g, %+.2f stops from middle grey", double(bright),
                std::log2(double(bright) / double(middle_gray)));
  }
  const int object = layers->surfaces.object[pixel];
  ImGui::Text("%s", object_name(input.scene->scene, object).c_str());
  if (object >= 0) {
    ImGui::Text("material %s", material_name(input.scene->scene, object).c_str());
    const auto depth = double(layers->surfaces.depth[pixel]);
    const V3d p =
        point_seen(layers->camera, layers->width, layers->height, x + 0.5, y + 0.5, depth);
    const V3f n = unpack_normal(layers->surfaces.normal[pixel]);
    ImGui::Text("at %.4g, %.4g, %.4g, depth %.4g", p.x, p.y, p.z, depth);
    ImGui::Text("normal %.2f, %.2f, %.2f", double(n.x), double(n.y), double(n.z));
  }
  ImGui::End();
}

void draw_legend(const PanelInput& input, bool error_map) {
  ImGui::SetNextWindowPos(ImVec2(input.picture_width - margin, margin), ImGuiCond_Always,
                          ImVec2(1.0f, 0.0f));
  ImGui::SetNextWindowBgAlpha(0.8f);
  ImGui::Begin("##legend", nullptr, bare);
  if (error_map) {
    ImGui::Text("Error: black 0, pale yellow %.0f%% and more", 100.0 * double(most_shown_error));
  } else {
    ImGui::TextUnformatted("Stops from middle grey");
    const auto& bands = false_color_bands();
    for (std::size_t i = bands.size(); i-- > 0;) {
      const Color& c = bands[i].color;
      ImGui::ColorButton(bands[i].says, ImVec4(c.x, c.y, c.z, 1.0f), ImGuiColorEditFlags_NoTooltip,
                         ImVec2(ImGui::GetFontSize(), ImGui::GetFontSize()));
      ImGui::SameLine();
      ImGui::TextUnformatted(bands[i].says);
    }
  }
  ImGui::End();
}

void draw_files(WindowState& state, const PanelInput& input) {
  ImGui::SetNextWindowPos(ImVec2(input.picture_width * 0.5f, input.height * 0.3f), ImGuiCond_Always,
                          ImVec2(0.5f, 0.0f));
  ImGui::SetNextWindowSize(
      ImVec2(std::min(input.width - 2.0f * margin, 40.0f * ImGui::GetFontSize()), 0.0f));
  bool open = true;
  ImGui::Begin("Files (Ctrl+O)", &open,
               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                   ImGuiWindowFlags_NoSavedSettings);
  ImGui::TextUnformatted("Drop a glTF file on the window, or open a recent one:");
  for (const std::filesystem::path& file : state.settings.recent) {
    if (ImGui::Selectable(file.string().c_str())) {
      state.wishes.open = file;
      open = false;
    }
  }
  if (state.settings.recent.empty()) ImGui::TextDisabled("there are none yet");
  ImGui::End();
  if (!open) state.show_files = false;
}

void draw_message(WindowState& state, const PanelInput& input, double now) {
  if (state.message.empty() || (!state.message_is_error && now > state.message_until)) {
    state.message.clear();
    return;
  }
  const float width = std::max(input.picture_width - 6.0f * margin, 100.0f);
  ImGui::SetNextWindowPos(ImVec2(input.picture_width * 0.5f, 3.0f * margin), ImGuiCond_Always,
                          ImVec2(0.5f, 0.0f));
  ImGui::SetNextWindowBgAlpha(0.9f);
  if (state.message_is_error)
    ImGui::PushStyleColor(ImGuiCol_WindowBg, ImVec4(0.45f, 0.08f, 0.08f, 1.0f));
  ImGui::Begin("##message", nullptr, bare);
  const float text = ImGui::CalcTextSize(state.message.c_str()).x;
  ImGui::PushTextWrapPos(std::min(text + 2.0f * margin, width));
  ImGui::TextUnformatted(state.message.c_str());
  ImGui::PopTextWrapPos();
  if (state.message_is_error && ImGui::Button("Close (Esc)")) state.message.clear();
  ImGui::End();
  if (state.message_is_error) ImGui::PopStyleColor();
}

}  // namespace

void draw_status(const WindowState& state, const PanelInput& input) {
  const float height = status_height(ImGui::GetFontSize());
  ImGui::SetNextWindowPos(ImVec2(0.0f, input.height - height));
  ImGui::SetNextWindowSize(ImVec2(input.width, height));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(margin, 4.0f));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, ImVec2(1.0f, 1.0f));
  ImGui::Begin("##status", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoInputs |
                   ImGuiWindowFlags_NoBringToFrontOnFocus);
  const WindowFigures& f = input.figures;
  std::string text;
  if (!input.doing.empty()) {
    text = input.doing + " ...";
  } else if (!input.scene) {
    text = "Drop a glTF file here, or press Ctrl+O; F1 tells the keys";
  } else {
    char figures[256];
    std::snprintf(figures, sizeof(figures),
                  "%4.1f frames/s  %5.1f ms  %5.1f%% traced  %7.1f samples  %s  %dx%d",
                  f.frames_per_second, 1e3 * f.frame_seconds, 100.0 * f.traced_share, f.samples,
                  format_duration(f.seconds).c_str(), f.width, f.height);
    text = figures;
    if (state.paused) {
      text += "  paused";
    } else if (f.resting) {
      text += "  done";
    }
    if (input.still.running) {
      char still[48];
      std::snprintf(still, sizeof(still), "  still %.0f%%", 100.0 * input.still.fraction);
      text += still;
    }
    char look[64];
    std::snprintf(look, sizeof(look), "  %+.2f stops", state.look.exposure);
    text += look;
    if (state.terms != all_terms) text += "  " + terms_text(state.terms);
  }
  ImGui::TextUnformatted(text.c_str());
  ImGui::End();
  ImGui::PopStyleVar(2);
}

void draw_overlays(WindowState& state, const PanelInput& input, double now) {
  if (state.show_records && state.knobs.light_vectors) draw_records(input);
  if (state.show_records && state.picked && state.picked->light)
    draw_incident_light(*state.picked->light, input);
  if (state.show_histogram) draw_histogram(input);
  if (state.show_inspector) draw_inspector(input);
  const bool light = state.layer == Layer::light;
  if (light && state.error_map) {
    draw_legend(input, true);
  } else if (light && state.look.mode == DisplayMode::false_color) {
    draw_legend(input, false);
  }
  if (state.show_files) draw_files(state, input);
  draw_message(state, input, now);
  if (state.show_help) draw_help(state, input);
}

}  // namespace lumivec
