// The slice of the cache at the picked point: the faces of its icosahedron, seen from above the
// surface, and the light vectors that stand for them.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "integrator/frame.h"
#include "viewer/exposure.h"
#include "viewer/heat_colors.h"
#include "viewer/window/panels.h"

namespace lumivec {
namespace {

constexpr float margin = 8.0f;
constexpr ImGuiWindowFlags bare = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                  ImGuiWindowFlags_NoSavedSettings |
                                  ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                  ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_AlwaysAutoResize;

ImU32 packed(const Color& c) {
  const auto byte = [](float v) { return int(std::lround(255.0f * std::clamp(v, 0.0f, 1.0f))); };
  return IM_COL32(byte(c.x), byte(c.y), byte(c.z), 255);
}

// Of a direction, seen from straight above the surface: the normal is the disc's middle, the
// horizon its rim. What lies below is moved to the rim.
ImVec2 on_disc(const Frame& frame, const V3f& direction, const ImVec2& middle, float radius) {
  float x = direction.dot(frame.t), y = direction.dot(frame.b);
  const float length = std::sqrt(x * x + y * y);
  if (direction.dot(frame.n) < 0.0f && length > 0.0f) {
    x /= length;
    y /= length;
  }
  return ImVec2(middle.x + radius * x, middle.y - radius * y);
}

}  // namespace

void draw_incident_light(const IncidentLight& light, const PanelInput& input) {
  ImGui::SetNextWindowPos(ImVec2(input.picture_width - margin, margin), ImGuiCond_Always,
                          ImVec2(1.0f, 0.0f));
  ImGui::SetNextWindowBgAlpha(0.8f);
  ImGui::Begin("##incident", nullptr, bare);
  ImGui::TextUnformatted("Indirect light at the picked point");
  const float radius = 6.0f * ImGui::GetFontSize();
  const ImVec2 from = ImGui::GetCursorScreenPos();
  const ImVec2 middle(from.x + radius, from.y + radius);
  ImGui::Dummy(ImVec2(2.0f * radius, 2.0f * radius));
  ImDrawList* list = ImGui::GetWindowDrawList();
  float most = 0.0f;
  for (const IncidentFace& face : light.faces) most = std::max(most, luminance(face.radiance));
  const Frame frame = make_frame(light.normal);
  for (const IncidentFace& face : light.faces) {
    std::array<ImVec2, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = on_disc(frame, face.corners[i], middle, radius);
    // Half of what the eye sees as half, so that a small bright face leaves the others visible.
    const float share = most > 0.0f ? std::cbrt(luminance(face.radiance) / most) : 0.0f;
    list->AddTriangleFilled(corners[0], corners[1], corners[2], packed(heat_color(share)));
  }
  const float line = std::max(1.0f, 0.1f * ImGui::GetFontSize());
  list->AddCircle(middle, radius, IM_COL32(200, 200, 200, 160), 64, 0.5f * line);
  const std::array<ImU32, 3> colors = {IM_COL32(255, 80, 80, 255), IM_COL32(80, 230, 80, 255),
                                       IM_COL32(100, 140, 255, 255)};
  for (std::size_t c = 0; light.records > 0 && c < 3; ++c) {
    const float length = light.vector[c].length();
    if (!(length > 0.0f)) continue;
    const ImVec2 tip = on_disc(frame, light.vector[c] / length, middle, radius);
    list->AddLine(middle, tip, colors[c], line);
    list->AddCircleFilled(tip, 2.0f * line, colors[c], 16);
  }
  const Color faces = light.irradiance_of_faces(), vector = light.irradiance_of_vector();
  ImGui::Text("brightest face %.4g cd/m2", double(most));
  ImGui::Text("faces give  %9.4g %9.4g %9.4g lx", double(faces.x), double(faces.y),
              double(faces.z));
  if (light.records > 0) {
    ImGui::Text("%2d records  %9.4g %9.4g %9.4g lx", light.records, double(vector.x),
                double(vector.y), double(vector.z));
  } else {
    ImGui::TextUnformatted("no record of it is cached here");
  }
  ImGui::End();
}

}  // namespace lumivec
