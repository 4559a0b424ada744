// What a render tells of itself: a summary for a person, JSON for a program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "integrator/framebuffer.h"
#include "integrator/settings.h"

namespace lumivec {

struct RenderReport {
  std::filesystem::path scene_file;
  std::string scene_name;
  std::string camera;
  std::string command;
  RenderSettings settings;
  RenderStatistics statistics;
  double seconds_load = 0.0;
  double seconds_write = 0.0;
  double seconds_total = 0.0;
  double exposure = 0.0;  // stops, as applied
  std::string display;    // empty: nothing was displayed
  std::string view;
  std::vector<std::filesystem::path> outputs;  // that were written
  std::vector<std::string> warnings;
  bool interrupted = false;
};

std::uint64_t ray_count(const RenderStatistics& statistics);
double samples_per_pixel(const RenderStatistics& statistics, const RenderSettings& settings);

// A few lines, each ended.
std::string render_summary(const RenderReport& report);

nlohmann::json render_json(const RenderReport& report);

}  // namespace lumivec
