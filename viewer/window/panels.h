// The panels beside the picture and what lies over it, drawn with Dear ImGui. They change the
// state, and say in its wishes what else is to be done.
#pragma once

#include "viewer/window/background_render.h"
#include "viewer/window/histogram.h"
#include "viewer/window/scene_edits.h"
#include "viewer/window/window_state.h"

namespace lumivec {

// What panels read. Pointers may be null where there is nothing yet.
struct PanelInput {
  const LoadedScene* scene = nullptr;
  const ScenePatch* patch = nullptr;  // of the scene; never null with one
  Imath::Box3d bounds;                // of both, world space
  const EnginePicture* picture = nullptr;
  const LayerPicture* layers = nullptr;
  const Histogram* histogram = nullptr;
  std::array<double, term_count> shares{};
  WindowFigures figures;
  BackgroundRender::State still, reference;
  std::string doing;  // of the engine
  // Where the mouse is on the picture, shares from its upper left corner; none: elsewhere.
  std::optional<std::array<double, 2>> mouse;
  float width = 0.0f, height = 0.0f;  // of the window, screen units
  float picture_width = 0.0f;         // likewise, of the part that shows the picture
  float picture_height = 0.0f;
  std::size_t edits_done = 0, edits_undone = 0;
};

// A change of the scene that a panel asks for.
struct EditWish {
  SceneEdit edit;
  std::uint64_t gesture = 0;  // that it is part of
};

float panel_width(float window_width, float text_size);
float status_height(float text_size);

void draw_side_panel(WindowState& state, const PanelInput& input, const DisplayNames& names,
                     std::optional<EditWish>& edit);
void draw_edit_section(WindowState& state, const PanelInput& input, std::optional<EditWish>& edit);
void draw_status(const WindowState& state, const PanelInput& input);
// What arrives at the picked point, by direction.
void draw_incident_light(const IncidentLight& light, const PanelInput& input);
// Help, histogram, inspector, legend, files and messages; now: seconds of the program's clock.
void draw_overlays(WindowState& state, const PanelInput& input, double now);

}  // namespace lumivec
