#include "tools/timed_render.h"

#include <sys/resource.h>

#include <chrono>
#include <nlohmann/json.hpp>

namespace lumivec {
namespace {

double process_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

TimedRender timed_render(const Scene& scene, const RenderSettings& settings) {
  using Clock = std::chrono::steady_clock;
  TimedRender result;
  const double core_start = process_seconds();
  const Clock::time_point start = Clock::now();
  result.picture = render(scene, scene.cameras[0], settings, result.statistics);
  result.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
  result.core_seconds = process_seconds() - core_start;
  result.samples_per_pixel = static_cast<double>(result.statistics.samples) /
                             static_cast<double>(result.picture.pixel_count());
  return result;
}

nlohmann::json cost_json(const TimedRender& render) {
  return {{"wall_seconds", render.wall_seconds},
          {"core_seconds", render.core_seconds},
          {"samples_per_pixel", render.samples_per_pixel},
          {"records", render.statistics.records},
          {"cache_bytes", render.statistics.cache_bytes},
          {"gather_paths", render.statistics.gather_paths}};
}

}  // namespace lumivec
