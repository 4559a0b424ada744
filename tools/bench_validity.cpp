// What each part of the hessian validity is worth: the error of the indirect term with the part
// left out, against that with all parts, at an equal number of records and at equal time. The
// paper's criteria stand beside them.
//
// Equal records: the error that the cache aims at, or the paper's bound on variation, is searched
// for that gives the wanted number. That error also decides how often a record is refined, so what
// making the records took is told too.
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "loader/load_scene.h"
#include "tools/bench_program.h"
#include "tools/knob_search.h"
#include "tools/reference_options.h"
#include "tools/term_errors.h"
#include "tools/timed_render.h"
#include "viewer/text_format.h"

namespace lumivec {
namespace {

constexpr const char* program = "bench_validity";
constexpr double record_tolerance = 0.03;
// Below, records take minutes; above, they cover the scene. The search begins where they are cheap.
constexpr KnobRange error_range = {0.04, 0.001, 4.0};
constexpr KnobRange variation_range = {0.3, 0.003, 100.0};

struct Variant {
  const char* name;
  bool ValidityParts::*left_out;  // null: none
  Validity validity = Validity::hessian;
};
constexpr Variant variants[] = {
    {"all parts", nullptr},
    {"no hessian", &ValidityParts::hessian},
    {"no gradient", &ValidityParts::gradient},
    {"no neighbour clamp", &ValidityParts::neighbour_clamp},
    {"no leak guard", &ValidityParts::leak_guard},
    {"no footprint clamp", &ValidityParts::footprint_clamp},
    {"paper", nullptr, Validity::paper},
};

struct Options {
  std::string scene = "cornell_box_1";
  int records = 4000;
  int samples = 64;
  double seconds = 10.0;
  ReferenceOptions reference;
  std::string json;
};

struct Measured {
  TimedRender render;
  TermError error;
  double knob = 0.0;  // 0: none was searched
};

RenderSettings settings_of(const Variant& variant, const Options& options) {
  RenderSettings settings = picture_settings(options.reference);
  settings.integrator = Integrator::light_vectors;
  settings.validity = variant.validity;
  settings.terms = 1u << indirect_layer;
  if (variant.left_out != nullptr) settings.validity_parts.*variant.left_out = false;
  return settings;
}

void set_knob(RenderSettings& settings, double knob) {
  if (settings.validity == Validity::paper) {
    settings.paper.max_variation = static_cast<float>(knob);
  } else {
    settings.cache_error = knob;
  }
}

Measured measure(const Scene& scene, const Reference& reference, const RenderSettings& settings) {
  Measured m;
  m.render = timed_render(scene, settings);
  m.error = term_errors(term_pictures(m.render.picture), reference.pictures,
                        reference.noise)[indirect_layer];
  return m;
}

Measured at_equal_records(const Scene& scene, const Reference& reference, const Variant& variant,
                          const Options& options) {
  RenderSettings settings = settings_of(variant, options);
  const KnobRange& range = variant.validity == Validity::paper ? variation_range : error_range;
  // The cache is filled before the picture is sampled: one sample shows how many records it has.
  settings.samples = 1;
  const auto count = [&](double knob) {
    set_knob(settings, knob);
    return static_cast<double>(timed_render(scene, settings).statistics.records);
  };
  const KnobFound found = find_knob(count, range, options.records, record_tolerance);
  set_knob(settings, found.knob);
  settings.samples = options.samples;
  Measured m = measure(scene, reference, settings);
  m.knob = found.knob;
  return m;
}

Measured at_equal_time(const Scene& scene, const Reference& reference, const Variant& variant,
                       const Options& options) {
  RenderSettings settings = settings_of(variant, options);
  settings.seconds = options.seconds;
  return measure(scene, reference, settings);
}

// Of the variant's error to that with all parts: above 1, the part is worth having.
double ratio(double error, double all) {
  return all > 0.0 ? error / all : std::numeric_limits<double>::quiet_NaN();
}

void print_line(const Variant& variant, const Measured& m, const Measured& all,
                const Options& options) {
  const double off = static_cast<double>(m.render.statistics.records) / options.records - 1.0;
  const bool missed = m.knob > 0.0 && std::abs(off) > record_tolerance;
  const char mark = m.error.below_noise ? '*' : ' ';
  std::printf("%-20s %8llu%c %9s %11s %8.2f %8.1f %10.4g%c %8.3f %10.4g%c %8.3f\n", variant.name,
              static_cast<unsigned long long>(m.render.statistics.records), missed ? '!' : ' ',
              m.knob > 0.0 ? format_number(m.knob, 3).c_str() : "-",
              format_count(m.render.statistics.gather_paths).c_str(), m.render.core_seconds,
              m.render.samples_per_pixel, m.error.rmse, mark, ratio(m.error.rmse, all.error.rmse),
              m.error.relmse, mark, ratio(m.error.relmse, all.error.relmse));
  std::fflush(stdout);
}

nlohmann::json measured_json(const Variant& variant, const Measured& m, const Measured& all) {
  nlohmann::json json = cost_json(m.render);
  json["variant"] = variant.name;
  json["rmse"] = m.error.rmse;
  json["relmse"] = m.error.relmse;
  json["below_noise"] = m.error.below_noise;
  json["rmse_over_all_parts"] = ratio(m.error.rmse, all.error.rmse);
  json["relmse_over_all_parts"] = ratio(m.error.relmse, all.error.relmse);
  if (m.knob > 0.0) json[variant.validity == Validity::paper ? "variation" : "error"] = m.knob;
  return json;
}

using Measurement = Measured (*)(const Scene&, const Reference&, const Variant&, const Options&);

nlohmann::json compare(const std::string& title, Measurement measurement, const Scene& scene,
                       const Reference& reference, const Options& options) {
  std::printf("%s\n%-20s %9s %9s %11s %8s %8s %11s %8s %11s %8s\n", title.c_str(), "", "records ",
              "knob", "paths", "core s", "samples", "RMSE ", "ratio", "relMSE ", "ratio");
  nlohmann::json json = nlohmann::json::array();
  std::optional<Measured> all;
  for (const Variant& variant : variants) {
    try {
      const Measured m = measurement(scene, reference, variant, options);
      if (!all) all = m;  // the first has all parts
      print_line(variant, m, *all, options);
      json.push_back(measured_json(variant, m, *all));
    } catch (const RenderError& e) {
      std::fprintf(stderr, "%s: %s is not available: %s\n", program, variant.name, e.what());
      if (!all) throw;  // nothing to compare with
      json.push_back({{"variant", variant.name}, {"not_available", e.what()}});
    }
  }
  std::printf("\n");
  return json;
}

int run(int argc, char** argv) {
  CLI::App app(
      "What each part of the reuse criteria is worth: the error of indirect light without it, at "
      "an "
      "equal number of records and at equal time.\n"
      "Ratios are to the error with all parts; * marks errors below the reference's noise, ! a "
      "number of records that no setting brought within 3% of the wanted one.");
  Options options;
  app.add_option("--scene", options.scene, "a glTF file or a shipped scene's name")
      ->capture_default_str();
  app.add_option("--records", options.records, "of all variants, where they are equal")
      ->capture_default_str()
      ->check(CLI::Range(1, 100'000'000));
  app.add_option("--samples", options.samples, "a pixel, where records are equal")
      ->capture_default_str()
      ->check(CLI::Range(1, max_picture_samples));
  app.add_option("--time", options.seconds, "seconds of each render, where times are equal")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 1e6));
  add_json_option(app, options.json);
  add_reference_options(app, options.reference);
  CLI11_PARSE(app, argc, argv);

  const std::filesystem::path file = find_scene(options.scene);
  const Scene scene = load_benchmark_scene(file);
  const Reference reference = obtain_reference(program, scene, file, options.reference);
  const ReferenceNoise& noise = reference.noise[indirect_layer];
  std::printf("%s, %dx%d, indirect light; noise of the reference: RMSE %.3g, relMSE %.3g\n\n",
              file.stem().c_str(), options.reference.size.width, options.reference.size.height,
              noise.rmse, noise.relmse);
  nlohmann::json json = {{"scene", file.stem().string()},
                         {"width", options.reference.size.width},
                         {"height", options.reference.size.height},
                         {"threads", options.reference.threads},
                         {"records", options.records},
                         {"samples", options.samples},
                         {"seconds", options.seconds},
                         {"noise", {{"rmse", noise.rmse}, {"relmse", noise.relmse}}}};
  json["equal_records"] = compare("at " + std::to_string(options.records) + " records and " +
                                      std::to_string(options.samples) + " samples a pixel",
                                  at_equal_records, scene, reference, options);
  write_json(options.json, json);
  json["equal_time"] = compare("in " + format_number(options.seconds) + " seconds", at_equal_time,
                               scene, reference, options);
  write_json(options.json, json);
  return 0;
}

}  // namespace
}  // namespace lumivec

int main(int argc, char** argv) {
  return lumivec::run_benchmark(lumivec::program, argc, argv, lumivec::run);
}
