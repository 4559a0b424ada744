// Speed against error: each method renders each scene for a time, twice that, and so on, and every
// picture is compared term by term with a converged one by path tracing.
//
// Methods take turns at each time, so that what else the machine does meets all alike, and
// core-seconds are compared, which other programs take no part in. Every render starts anew: a
// point of a curve is what a user gets for that time.
#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>

#include "loader/load_scene.h"
#include "tools/bench_program.h"
#include "tools/curve_plot.h"
#include "tools/error_curve.h"
#include "tools/reference_options.h"
#include "tools/term_errors.h"
#include "tools/timed_render.h"
#include "viewer/atomic_file.h"
#include "viewer/text_format.h"

namespace lumivec {
namespace {

constexpr const char* program = "bench_error";

struct Method {
  const char* name;
  Integrator integrator;
  Validity validity;
};
constexpr Method methods[] = {
    {"path", Integrator::path, Validity::hessian},
    {"light-vectors-paper", Integrator::light_vectors, Validity::paper},
    {"light-vectors-hessian", Integrator::light_vectors, Validity::hessian}};

struct Options {
  std::vector<std::string> scenes = {"cornell_box_1", "cornell_box_2", "sphere_flake"};
  std::vector<std::string> methods;
  double first = 1.0;  // seconds
  int doublings = 6;
  double target = 0.0;  // relMSE; 0: the scene's
  ReferenceOptions reference;
  std::string json, plot;
};

// Caustics of a thousand glass spheres take path tracing far longer.
double target_of(const std::string& scene, const Options& options) {
  if (options.target > 0.0) return options.target;
  return scene.starts_with("sphere_flake") ? 0.005 : 0.001;
}

// All renders of one method.
struct Series {
  Method method;
  std::string refusal;  // why it is not available; empty: it is
  std::vector<CurvePoint> sum, indirect;
  nlohmann::json renders = nlohmann::json::array();
};

void print_header(const std::string& scene, const Options& options, const Reference& reference) {
  std::printf("%s, %dx%d; reference of %d samples a pixel, %s\n", scene.c_str(),
              options.reference.size.width, options.reference.size.height,
              options.reference.samples, reference.was_kept ? "kept from before" : "rendered");
  std::printf("%-22s %7s %8s %8s %8s %8s %-7s", "", "wall s", "core s", "samples", "records",
              "cache", "");
  for (std::size_t i = 0; i < layer_count; ++i) {
    std::printf(" %9s ", std::string(error_layer_name(i)).c_str());
  }
  std::printf("\n%-66s %-7s", "reference", "relMSE");
  for (const ReferenceNoise& n : reference.noise) std::printf(" %9.3g ", n.relmse);
  std::printf("\n%-66s %-7s", "", "RMSE");
  for (const ReferenceNoise& n : reference.noise) std::printf(" %9.3g ", n.rmse);
  std::printf("\n");
}

void print_render(const char* method, const TimedRender& render, const TermErrors& errors) {
  std::printf("%-22s %7.2f %8.2f %8.1f %8s %8s %-7s", method, render.wall_seconds,
              render.core_seconds, render.samples_per_pixel,
              std::to_string(render.statistics.records).c_str(),
              format_bytes(render.statistics.cache_bytes).c_str(), "relMSE");
  for (const TermError& e : errors) std::printf(" %9.3g%c", e.relmse, e.below_noise ? '*' : ' ');
  std::printf("\n%-66s %-7s", "", "RMSE");
  for (const TermError& e : errors) std::printf(" %9.3g%c", e.rmse, e.below_noise ? '*' : ' ');
  std::printf("\n");
  std::fflush(stdout);
}

void add_render(const Scene& scene, const Reference& reference, const Options& options,
                double seconds, Series& series) {
  RenderSettings settings = picture_settings(options.reference);
  settings.integrator = series.method.integrator;
  settings.validity = series.method.validity;
  settings.seconds = seconds;
  try {
    const TimedRender render = timed_render(scene, settings);
    const TermErrors errors =
        term_errors(term_pictures(render.picture), reference.pictures, reference.noise);
    print_render(series.method.name, render, errors);
    series.sum.push_back({render.core_seconds, errors[sum_layer].relmse});
    series.indirect.push_back({render.core_seconds, errors[indirect_layer].relmse});
    nlohmann::json json = cost_json(render);
    json["seconds"] = seconds;
    json["errors"] = term_errors_json(errors);
    series.renders.push_back(json);
  } catch (const RenderError& e) {
    series.refusal = e.what();
    std::fprintf(stderr, "%s: %s is not available: %s\n", program, series.method.name, e.what());
  }
}

const Series* find_path(const std::vector<Series>& all) {
  const auto path = std::find_if(all.begin(), all.end(), [](const Series& s) {
    return s.method.integrator == Integrator::path;
  });
  return path == all.end() ? nullptr : &*path;
}

void print_targets(const std::vector<Series>& all, const Reference& reference, double target) {
  const Series* path = find_path(all);
  std::printf("core-seconds to a relMSE of %g%8s %8s %10s %8s\n", target, "sum", "faster",
              "indirect", "faster");
  for (const Series& s : all) {
    if (!s.refusal.empty()) continue;
    const CostToReach sum = cost_to_reach(s.sum, target);
    const CostToReach indirect = cost_to_reach(s.indirect, target);
    const CostToReach none;
    const CostToReach path_sum = path ? cost_to_reach(path->sum, target) : none;
    const CostToReach path_indirect = path ? cost_to_reach(path->indirect, target) : none;
    const auto faster = [&](const CostToReach& by_path, const CostToReach& own) {
      return &s == path ? std::string("1") : cost_ratio_text(by_path, own);
    };
    std::printf("  %-29s %8s %8s %10s %8s\n", s.method.name, cost_text(sum).c_str(),
                faster(path_sum, sum).c_str(), cost_text(indirect).c_str(),
                faster(path_indirect, indirect).c_str());
  }
  for (const std::size_t layer : {sum_layer, indirect_layer}) {
    if (reference.noise[layer].relmse < target) continue;
    std::printf("  the reference's own noise in %s is above that; it needs more samples\n",
                std::string(error_layer_name(layer)).c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

nlohmann::json to_target_json(const CostToReach& path, const CostToReach& own) {
  nlohmann::json json = {{"kind", cost_kind_name(own.kind)}};
  if (own.kind == CostToReach::Kind::unknown) return json;
  json["core_seconds"] = own.cost;
  if (path.kind != CostToReach::Kind::unknown) json["path_over_this"] = cost_ratio(path, own);
  return json;
}

nlohmann::json series_json(const std::vector<Series>& all, double target) {
  const Series* path = find_path(all);
  const auto to_target = [&](std::vector<CurvePoint> Series::*points, const Series& s) {
    return to_target_json(path ? cost_to_reach(path->*points, target) : CostToReach(),
                          cost_to_reach(s.*points, target));
  };
  nlohmann::json json = nlohmann::json::array();
  for (const Series& s : all) {
    nlohmann::json one = {{"method", s.method.name}, {"renders", s.renders}};
    if (s.refusal.empty()) {
      one["to_target"] = {{"sum", to_target(&Series::sum, s)},
                          {"indirect", to_target(&Series::indirect, s)}};
    } else {
      one["not_available"] = s.refusal;
    }
    json.push_back(one);
  }
  return json;
}

void add_panels(const std::string& scene, const std::vector<Series>& all,
                const Reference& reference, double target, std::vector<PlotPanel>& panels) {
  const auto add = [&](const std::string& what, std::vector<CurvePoint> Series::*points,
                       std::size_t layer) {
    PlotPanel panel = {scene + ", " + what,          "core-seconds", "relMSE", {}, target,
                       reference.noise[layer].relmse};
    for (const Series& s : all) {
      if (!(s.*points).empty()) panel.lines.push_back({s.method.name, s.*points});
    }
    panels.push_back(panel);
  };
  add("sum of all terms", &Series::sum, sum_layer);
  add("indirect", &Series::indirect, indirect_layer);
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("--scene", options.scenes, "a glTF file or a shipped scene's name; repeatable")
      ->capture_default_str()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  std::vector<std::string> names;
  for (const Method& m : methods) names.emplace_back(m.name);
  options.methods = names;
  app.add_option("--method", options.methods, "repeatable")
      ->capture_default_str()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(CLI::IsMember(names));
  app.add_option("--first", options.first, "seconds of the first render")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 1e6));
  app.add_option("--doublings", options.doublings, "renders of twice the time each after the first")
      ->capture_default_str()
      ->check(CLI::Range(0, 20));
  app.add_option("--target", options.target,
                 "relMSE whose cost is told; default: 0.005 for sphere_flake, 0.001 for others")
      ->check(CLI::Range(1e-12, 1e6));
  app.add_option_function<std::string>(
         "--plot",
         [&](const std::string& file) {
           check_writable(file);
           options.plot = file;
         },
         "draw the curves into this SVG file")
      ->type_name("FILE.svg");
  add_json_option(app, options.json);
  add_reference_options(app, options.reference);
}

int run(int argc, char** argv) {
  CLI::App app(
      "Error of each term against time, by path tracing and by light vectors.\n"
      "Errors are relMSE and RMSE against a reference, whose own noise is taken off; * marks those "
      "below that noise, < costs that are at most so much, ~ those extrapolated by 1/time from the "
      "last render.");
  Options options;
  add_options(app, options);
  CLI11_PARSE(app, argc, argv);

  nlohmann::json scenes = nlohmann::json::array();
  std::vector<PlotPanel> panels;
  for (const std::string& name : options.scenes) {
    const std::filesystem::path file = find_scene(name);
    const std::string scene_name = file.stem().string();
    const Scene scene = load_benchmark_scene(file);
    const Reference reference = obtain_reference(program, scene, file, options.reference);
    const double target = target_of(scene_name, options);
    std::vector<Series> all;
    for (const Method& m : methods) {
      if (std::find(options.methods.begin(), options.methods.end(), m.name) !=
          options.methods.end()) {
        all.push_back({m, {}, {}, {}});
      }
    }
    print_header(scene_name, options, reference);
    double seconds = options.first;
    for (int i = 0; i <= options.doublings; ++i, seconds *= 2.0) {
      for (Series& s : all) {
        if (s.refusal.empty()) add_render(scene, reference, options, seconds, s);
      }
    }
    print_targets(all, reference, target);
    // After each scene: a run that is stopped leaves what it found.
    scenes.push_back({{"scene", scene_name},
                      {"target", target},
                      {"reference",
                       {{"samples", options.reference.samples},
                        {"core_seconds", reference.core_seconds},
                        {"kept_from_before", reference.was_kept},
                        {"noise", term_noise_json(reference.noise)}}},
                      {"methods", series_json(all, target)}});
    write_json(options.json, {{"width", options.reference.size.width},
                              {"height", options.reference.size.height},
                              {"threads", options.reference.threads},
                              {"first_seconds", options.first},
                              {"doublings", options.doublings},
                              {"scenes", scenes}});
    add_panels(scene_name, all, reference, target, panels);
    if (!options.plot.empty()) write_text_atomically(options.plot, plot_svg(panels, 2));
  }
  return 0;
}

}  // namespace
}  // namespace lumivec

int main(int argc, char** argv) {
  return lumivec::run_benchmark(lumivec::program, argc, argv, lumivec::run);
}
