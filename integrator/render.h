// Renders a still: Scene to Framebuffer, by unbiased path tracing.
#pragma once

#include <functional>

#include "integrator/check_settings.h"
#include "integrator/framebuffer.h"
#include "integrator/settings.h"
#include "loader/scene.h"

namespace lumivec {

struct RenderProgress {
  double fraction = 0.0;      // of the work, by the limit that is nearest, [0, 1]
  double seconds = 0.0;       // spent sampling
  double seconds_left = 0.0;  // estimated
  double samples = 0.0;       // a pixel, so far
  double error = -1.0;        // own estimate of √relMSE, as a fraction; < 0: none yet
};

// Called a few times a second from one of the rendering threads, never from two at once. False ends
// the render, which then returns what it has.
using ProgressCallback = std::function<bool(const RenderProgress&)>;

// Renders scene as seen by camera. Same scene, camera, settings and seed: same framebuffer, bit for
// bit, whatever the number of threads, unless the limit is time. Throws RenderError.
Framebuffer render(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                   RenderStatistics& statistics, const ProgressCallback& progress = {});

}  // namespace lumivec
