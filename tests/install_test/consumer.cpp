// Renders eight by eight pixels of a shipped scene and prints their mean radiance.
#include <cstdio>

#include "integrator/render.h"
#include "loader/load_scene.h"

int main() {
  lumivec::LoadReport report;
  const lumivec::Scene scene = lumivec::load_scene(SCENE, {}, report);
  lumivec::RenderSettings settings;
  settings.width = settings.height = 8;
  lumivec::RenderStatistics statistics;
  const auto picture = lumivec::render(scene, scene.cameras.front(), settings, statistics);
  lumivec::Color sum(0.0f);
  for (std::size_t i = 0; i < picture.pixel_count(); ++i) sum += picture.beauty(i);
  const float mean = (sum.x + sum.y + sum.z) / (3.0f * float(picture.pixel_count()));
  std::printf("mean radiance %g cd/m2\n", mean);
  return mean > 0.1f && mean < 1.0f ? 0 : 1;  // the box is exposed for a picture as it is
}
