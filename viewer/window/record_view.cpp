#include "viewer/window/record_view.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "viewer/text_format.h"
#include "viewer/window/picture_point.h"

namespace lumivec {
namespace {

constexpr int corners = 20;           // of an ellipse
constexpr std::size_t most = 6000;    // that are drawn, evenly chosen
constexpr double depth_slack = 0.02;  // share by which a record may seem to lie behind its surface

struct LimitLook {
  const char* name;
  ImU32 color;
};
// In the order of RadiusLimit.
constexpr std::array<LimitLook, radius_limit_count> looks = {{
    {"the light's curvature", IM_COL32(90, 220, 90, 255)},
    {"its gradient", IM_COL32(255, 170, 40, 255)},
    {"distance to what is near", IM_COL32(80, 160, 255, 255)},
    {"no light found", IM_COL32(150, 150, 150, 255)},
    {"a neighbour's reach", IM_COL32(220, 90, 220, 255)},
    {"the size of pixels", IM_COL32(240, 240, 120, 255)},
}};

bool visible(const LayerPicture& layers, const RecordMark& mark, const SeenAt& at) {
  const int x = int(std::floor(at.x)), y = int(std::floor(at.y));
  if (x < 0 || y < 0 || x >= layers.width || y >= layers.height) return false;
  const std::size_t pixel = std::size_t(y) * std::size_t(layers.width) + std::size_t(x);
  if (layers.surfaces.object[pixel] < 0) return false;
  // Around the pixel the surface may be as much deeper as a record reaches.
  const double reach = std::max(mark.half_axis[0].length(), mark.half_axis[1].length());
  const double seen = double(layers.surfaces.depth[pixel]);
  return at.depth <= seen + depth_slack * seen + 0.1 * reach;
}

// What each cache holds, and how often what was looked for was there, in the last frame.
void draw_caches(const PanelInput& input) {
  if (!input.picture || input.picture->width == 0) return;
  const WalkEngine::Caches& caches = input.picture->caches;
  const WalkEngine::Frame& frame = input.picture->figures;
  const auto row = [](const char* name, const CacheSize& size, const std::string& hits) {
    ImGui::Text("%-22s %9s %10s  %s", name, format_count(size.entries).c_str(),
                format_bytes(size.bytes).c_str(), hits.c_str());
  };
  const auto share = [](double part, double whole) {
    return whole > 0.0 ? format_fixed(100.0 * part / whole, 1) + "%" : std::string("-");
  };
  const auto hits = double(frame.cache_hits), misses = double(frame.cache_misses);
  const double pixels = double(input.picture->width) * double(input.picture->height);
  ImGui::TextUnformatted("Cache                    entries     memory  hits");
  row("Records of indirect", caches.records, share(hits, hits + misses));
  row("Photons of caustics", caches.photons, "");
  row("Shading of pixels", caches.shading, share(pixels - double(frame.traced), pixels));
}

}  // namespace

void draw_records(const PanelInput& input) {
  const LayerPicture* layers = input.layers;
  if (!layers || layers->width == 0) return;
  const float scale_x = input.picture_width / float(layers->width);
  const float scale_y = input.picture_height / float(layers->height);
  ImDrawList* list = ImGui::GetBackgroundDrawList();
  list->PushClipRect(ImVec2(0.0f, 0.0f), ImVec2(input.picture_width, input.picture_height));
  std::array<std::size_t, radius_limit_count> counts{};
  std::size_t seen_count = 0, drawn = 0, provisional = 0;
  const std::size_t stride = std::max<std::size_t>(1, (layers->records.size() + most - 1) / most);
  for (std::size_t i = 0; i < layers->records.size(); ++i) {
    const RecordMark& mark = layers->records[i];
    const std::optional<SeenAt> at =
        seen_at(layers->camera, layers->width, layers->height, mark.position);
    if (!at || !visible(*layers, mark, *at)) continue;
    ++seen_count;
    ++counts[std::size_t(mark.limit)];
    provisional += mark.provisional ? 1 : 0;
    if (i % stride != 0) continue;
    ++drawn;
    std::array<ImVec2, corners> outline;
    bool whole = true;
    for (int k = 0; k < corners && whole; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / corners;
      const std::optional<SeenAt> rim =
          seen_at(layers->camera, layers->width, layers->height,
                  mark.position + mark.half_axis[0] * std::cos(angle) +
                      mark.half_axis[1] * std::sin(angle));
      whole = rim.has_value();
      if (whole) outline[std::size_t(k)] = ImVec2(float(rim->x) * scale_x, float(rim->y) * scale_y);
    }
    const ImU32 color = looks[std::size_t(mark.limit)].color;
    if (whole)
      list->AddPolyline(outline.data(), corners, color, ImDrawFlags_Closed,
                        mark.provisional ? 0.7f : 1.3f);
    list->AddCircleFilled(ImVec2(float(at->x) * scale_x, float(at->y) * scale_y), 1.8f, color, 6);
  }
  list->PopClipRect();

  constexpr float margin = 8.0f;
  ImGui::SetNextWindowPos(ImVec2(input.picture_width - margin, input.picture_height - margin),
                          ImGuiCond_Always, ImVec2(1.0f, 1.0f));
  ImGui::SetNextWindowBgAlpha(0.8f);
  ImGui::Begin("##records", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_AlwaysAutoResize);
  draw_caches(input);
  ImGui::Text("Records in sight: %s, drawn: %s", format_count(seen_count).c_str(),
              format_count(drawn).c_str());
  if (provisional > 0) ImGui::Text("%zu thinly drawn ones are to be made better", provisional);
  ImGui::Text("Their reach is limited by");
  for (std::size_t k = 0; k < looks.size(); ++k) {
    ImGui::PushStyleColor(ImGuiCol_Text, looks[k].color);
    ImGui::Text("  %6zu  %s", counts[k], looks[k].name);
    ImGui::PopStyleColor();
  }
  ImGui::End();
}

}  // namespace lumivec
