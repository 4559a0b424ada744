// A render and what it cost.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "integrator/render.h"

namespace lumivec {

struct TimedRender {
  Framebuffer picture;
  RenderStatistics statistics;
  double wall_seconds = 0.0;  // of the whole render, preparation included
  double core_seconds = 0.0;  // of the processors, by this process: other programs do not count
  double samples_per_pixel = 0.0;  // mean
};

// By the scene's first camera. Throws RenderError.
TimedRender timed_render(const Scene& scene, const RenderSettings& settings);

// All but the picture.
nlohmann::json cost_json(const TimedRender& render);

}  // namespace lumivec
