#include "viewer/render_report.h"

#include <nlohmann/json.hpp>
#include <numeric>

#include "viewer/machine.h"
#include "viewer/option_values.h"
#include "viewer/text_format.h"
#include "viewer/version.h"

namespace lumivec {
namespace {

double rays_per_second(const RenderStatistics& statistics) {
  return statistics.seconds_sample > 0.0 ? double(ray_count(statistics)) / statistics.seconds_sample
                                         : 0.0;
}

std::string dropped_text(const RenderStatistics& statistics) {
  std::string text;
  for (std::size_t t = 0; t < term_names.size(); ++t) {
    if (statistics.dropped[t] == 0) continue;
    text += (text.empty() ? "" : ", ") + format_count(statistics.dropped[t]) + " " +
            std::string(term_names[t]);
  }
  return text;
}

nlohmann::json paper_json(const PaperParameters& paper) {
  return {{"max_variation", paper.max_variation},
          {"min_normal_cosine", paper.min_normal_cosine},
          {"min_direction_cosine", paper.min_direction_cosine},
          {"needed_records", paper.needed_records},
          {"seeds", paper.seeds},
          {"samples", paper.samples},
          {"max_records", paper.max_records}};
}

}  // namespace

std::uint64_t ray_count(const RenderStatistics& statistics) {
  return statistics.rays_camera + statistics.rays_scatter + statistics.rays_shadow;
}

double samples_per_pixel(const RenderStatistics& statistics, const RenderSettings& settings) {
  const double pixels = double(settings.width) * double(settings.height);
  return pixels > 0.0 ? double(statistics.samples) / pixels : 0.0;
}

std::string render_summary(const RenderReport& report) {
  const RenderStatistics& s = report.statistics;
  std::string text = std::to_string(report.settings.width) + "x" +
                     std::to_string(report.settings.height) + ", " +
                     format_number(samples_per_pixel(s, report.settings)) + " samples a pixel in " +
                     format_duration(s.seconds_sample) + ", " +
                     format_number(rays_per_second(s) * 1e-6, 3) + " Mrays/s";
  if (report.interrupted) text += ", interrupted";
  text += "\nload " + format_duration(report.seconds_load) + ", prepare " +
          format_duration(s.seconds_prepare) + ", sample " + format_duration(s.seconds_sample) +
          ", write " + format_duration(report.seconds_write) + ", memory " +
          format_bytes(peak_memory_bytes()) + "\n";
  if (s.error_estimate >= 0.0) {
    text += "estimated relative error " + format_number(s.error_estimate * 100.0, 3) + "%\n";
  }
  if (const std::string dropped = dropped_text(s); !dropped.empty()) {
    text += "dropped samples that were not finite: " + dropped + "\n";
  }
  for (const std::filesystem::path& output : report.outputs) text += output.string() + "\n";
  return text;
}

nlohmann::json render_json(const RenderReport& report) {
  const RenderStatistics& s = report.statistics;
  const RenderSettings& settings = report.settings;
  nlohmann::json dropped;
  for (std::size_t t = 0; t < term_names.size(); ++t) {
    dropped[std::string(term_names[t])] = s.dropped[t];
  }
  nlohmann::json light_vectors;
  for (std::size_t f = 0; f < light_vector_form_names.size(); ++f) {
    light_vectors[std::string(light_vector_form_names[f])] = s.light_vectors[f];
  }
  std::vector<std::string> terms;
  std::vector<std::string> outputs;
  for (std::size_t t = 0; t < term_names.size(); ++t) {
    if (settings.terms >> t & 1u) terms.emplace_back(term_names[t]);
  }
  for (const std::filesystem::path& output : report.outputs) outputs.push_back(output.string());

  nlohmann::json json = {{"software", software_name()},
                         {"command", report.command},
                         {"scene",
                          {{"file", report.scene_file.string()},
                           {"name", report.scene_name},
                           {"camera", report.camera}}},
                         {"settings",
                          {{"width", settings.width},
                           {"height", settings.height},
                           {"filter", filter_name(settings.filter)},
                           {"integrator", integrator_names[std::size_t(settings.integrator)]},
                           {"validity", validity_names[std::size_t(settings.validity)]},
                           {"paper", paper_json(settings.paper)},
                           {"samples", settings.samples},
                           {"seconds", settings.seconds},
                           {"error", settings.error},
                           {"terms", terms},
                           {"threads", settings.threads},
                           {"seed", settings.seed},
                           {"specular_roughness", settings.specular_roughness},
                           {"max_depth", settings.max_depth}}},
                         {"seconds",
                          {{"load", report.seconds_load},
                           {"prepare", s.seconds_prepare},
                           {"sample", s.seconds_sample},
                           {"write", report.seconds_write},
                           {"total", report.seconds_total}}},
                         {"rays",
                          {{"camera", s.rays_camera},
                           {"scatter", s.rays_scatter},
                           {"shadow", s.rays_shadow},
                           {"per_second", rays_per_second(s)}}},
                         {"samples",
                          {{"total", s.samples},
                           {"per_pixel", samples_per_pixel(s, settings)},
                           {"light_paths", s.light_paths},
                           {"photons", s.photons},
                           {"dropped", dropped}}},
                         {"cache",
                          {{"records", s.records},
                           {"bytes", s.cache_bytes},
                           {"paths", s.gather_paths},
                           {"hits", s.cache_hits},
                           {"misses", s.cache_misses},
                           {"visibility_rays", s.rays_visibility},
                           {"light_vectors", light_vectors},
                           {"seconds", s.seconds_cache}}},
                         {"error_estimate", nullptr},
                         {"interrupted", report.interrupted},
                         {"peak_memory_bytes", peak_memory_bytes()},
                         {"outputs", outputs},
                         {"warnings", report.warnings}};
  if (s.error_estimate >= 0.0) json["error_estimate"] = s.error_estimate;
  if (!report.display.empty()) {
    json["display"] = {
        {"exposure", report.exposure}, {"name", report.display}, {"view", report.view}};
  }
  return json;
}

}  // namespace lumivec
