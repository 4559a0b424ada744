#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <numbers>

#include "viewer/commands/common_options.h"
#include "viewer/commands/render.h"
#include "viewer/errors.h"
#include "viewer/still_writer.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

void add_output_options(CLI::App& app, RenderOptions& options) {
  const std::string group = "Output";
  app.add_option_function<std::vector<std::string>>(
         "-o,--output",
         [&options](const std::vector<std::string>& files) {
           options.outputs.assign(files.begin(), files.end());
         },
         "Picture to write: .exr (all layers), .png or .jpg (as displayed); may be repeated")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->group(group);
  add_value_option(
      app, "--size", "WxH|N", "Pixels [height 512, width by the camera's aspect ratio]",
      [&options](const std::string& text) { options.size = parse_size("--size", text); })
      ->group(group);
  app.add_flag_callback(
         "--half", [&options] { options.precision = ExrPrecision::half; },
         "OpenEXR colours in 16 bits (the default); P, Z and id are always 32")
      ->group(group);
  app.add_flag_callback(
         "--float", [&options] { options.precision = ExrPrecision::single; },
         "OpenEXR colours in 32 bits")
      ->group(group);
  add_value_option(app, "--png-bits", "8|16", "Bits a channel of PNG [8]",
                   [&options](const std::string& text) {
                     options.png_bits = std::stoi(parse_word("--png-bits", text, {"8", "16"}));
                   })
      ->group(group);
  add_value_option(app, "--stats", "FILE.json", "Write times, ray counts and settings as JSON",
                   [&options](const std::string& text) { options.statistics = text; })
      ->group(group);
  app.add_flag("-q,--quiet", options.quiet, "Print nothing but errors")->group(group);
}

void add_limit_options(CLI::App& app, RenderSettings& settings) {
  const std::string group = "Limits (whichever comes first; without any, 64 samples a pixel)";
  add_value_option(app, "--spp", "N", "Samples a pixel", [&settings](const std::string& text) {
    settings.samples = int(parse_whole("--spp", text, 1, max_picture_samples));
  })->group(group);
  add_value_option(app, "--time", "SECONDS", "Wall-clock time for sampling",
                   [&settings](const std::string& text) {
                     constexpr double a_year = 365.0 * 86400.0;
                     settings.seconds = parse_number_above("--time", text, 0.0, a_year);
                   })
      ->group(group);
  add_value_option(app, "--error", "PERCENT",
                   "Estimated relative error of the picture: the square root of relMSE",
                   [&settings](const std::string& text) {
                     settings.error = parse_number_above("--error", text, 0.0, 100.0) / 100.0;
                   })
      ->group(group);
}

void add_light_options(CLI::App& app, RenderOptions& options) {
  const std::string group = "Light";
  RenderSettings& settings = options.settings;
  add_value_option(
      app, "--integrator", "NAME",
      "How light is computed: light-vectors (indirect light and caustics cached) or path "
      "(unbiased, slower) [light-vectors]",
      [&options](const std::string& text) {
        const std::string word = parse_word("--integrator", text, {"path", "light-vectors"});
        options.settings.integrator = word == "path" ? Integrator::path : Integrator::light_vectors;
      })
      ->group(group);
  add_value_option(app, "--validity", "NAME",
                   "When light-vectors reuses a record: hessian (by derivatives of the light) or "
                   "paper (by the criteria of 2003, to compare) [hessian]",
                   [&settings](const std::string& text) {
                     const std::string word = parse_word("--validity", text, {"hessian", "paper"});
                     settings.validity = word == "paper" ? Validity::paper : Validity::hessian;
                   })
      ->group(group);
  add_value_option(
      app, "--terms", "LIST",
      "Parts of the light, of emitted,specular,direct,indirect,caustic [all]",
      [&settings](const std::string& text) { settings.terms = parse_terms("--terms", text); })
      ->group(group);
  add_value_option(
      app, "--specular-roughness", "R", "Lobes smoother than this count as specular, [0, 1] [0.15]",
      [&settings](const std::string& text) {
        settings.specular_roughness = float(parse_number("--specular-roughness", text, 0.0, 1.0));
      })
      ->group(group);
  add_value_option(app, "--max-depth", "N",
                   "Scattering events a path may have [0: no limit, Russian roulette only]",
                   [&settings](const std::string& text) {
                     settings.max_depth =
                         int(parse_whole("--max-depth", text, 0, std::numeric_limits<int>::max()));
                   })
      ->group(group);
  add_environment_options(app, options.environment, group);
}

// The method of 2003 (paper_validity.h), for comparisons: not in --help.
void add_paper_options(CLI::App& app, PaperParameters& paper) {
  const std::string hidden;
  add_value_option(app, "--paper-variation", "E", "", [&paper](const std::string& text) {
    constexpr double most = 1e6;
    paper.max_variation = float(parse_number_above("--paper-variation", text, 0.0, most));
  })->group(hidden);
  constexpr double most_cosine = 0.9999;  // at 1 no two places agree
  add_value_option(app, "--paper-curvature", "COSINE", "", [&paper](const std::string& text) {
    paper.min_normal_cosine = float(parse_number("--paper-curvature", text, -1.0, most_cosine));
  })->group(hidden);
  add_value_option(app, "--paper-direction", "COSINE", "", [&paper](const std::string& text) {
    paper.min_direction_cosine = float(parse_number("--paper-direction", text, -1.0, most_cosine));
  })->group(hidden);
  const auto number = [&](const char* name, int least, int& value) {
    add_value_option(app, name, "N", "", [name, least, &value](const std::string& text) {
      constexpr int most = 1 << 30;
      value = int(parse_whole(name, text, std::uint64_t(least), most));
    })->group(hidden);
  };
  number("--paper-needed", 1, paper.needed_records);
  number("--paper-seeds", 0, paper.seeds);
  number("--paper-samples", 1, paper.samples);
  number("--paper-max-records", 0, paper.max_records);
}

// For developers: not in --help.
void add_cache_options(CLI::App& app, RenderSettings& settings) {
  const std::string hidden;
  add_value_option(app, "--cache-error", "PERCENT", "", [&settings](const std::string& text) {
    settings.cache_error = parse_number_above("--cache-error", text, 0.0, 100.0) / 100.0;
  })->group(hidden);
  const auto part = [&](const char* name, bool& value) {
    app.add_flag_callback(name, [&value] { value = false; })->group(hidden);
  };
  part("--no-hessian", settings.validity_parts.hessian);
  part("--no-gradient", settings.validity_parts.gradient);
  part("--no-neighbour-clamp", settings.validity_parts.neighbour_clamp);
  part("--no-leak-guard", settings.validity_parts.leak_guard);
  part("--no-footprint-clamp", settings.validity_parts.footprint_clamp);
  app.add_flag("--direct-cache", settings.validity_parts.direct_cache)->group(hidden);
}

void add_sampling_options(CLI::App& app, RenderSettings& settings) {
  const std::string group = "Sampling";
  add_value_option(
      app, "--filter", "NAME", "Pixel filter: box, tent, gaussian or blackman-harris [box]",
      [&settings](const std::string& text) { settings.filter = parse_filter("--filter", text); })
      ->group(group);
  add_value_option(app, "--seed", "N", "Same seed, same picture [0]",
                   [&settings](const std::string& text) {
                     settings.seed =
                         parse_whole("--seed", text, 0, std::numeric_limits<std::uint64_t>::max());
                   })
      ->group(group);
  add_value_option(app, "--threads", "N", "Processors to use [0: all]",
                   [&settings](const std::string& text) {
                     constexpr std::uint64_t most = 4096;
                     settings.threads = int(parse_whole("--threads", text, 0, most));
                   })
      ->group(group);
}

// The same place under two spellings counts as the same.
fs::path place(const fs::path& file) {
  std::error_code error;
  fs::path canonical = fs::weakly_canonical(fs::absolute(file, error), error);
  return error ? file : canonical;
}

}  // namespace

void add_render_options(CLI::App& app, RenderOptions& options) {
  add_scene_options(app, options.scene_file, options.load);
  add_value_option(
      app, "--camera", "NAME|INDEX|VIEW",
      "Camera of the scene, or eye=X,Y,Z/target=X,Y,Z, with /up=X,Y,Z and /yfov=DEGREES "
      "if wanted [the first]",
      [&options](const std::string& text) { options.camera = text; })
      ->group("Scene");
  add_value_option(app, "--at", "SECONDS", "Pose the scene at this moment of an animation",
                   [&options](const std::string& text) {
                     constexpr double a_year = 365.0 * 86400.0;
                     options.pose.seconds = parse_number("--at", text, 0.0, a_year);
                   })
      ->group("Scene");
  add_value_option(app, "--animation", "NAME|INDEX", "Which animation [the first]",
                   [&options](const std::string& text) { options.pose.animation = text; })
      ->group("Scene");
  add_output_options(app, options);
  add_limit_options(app, options.settings);
  add_light_options(app, options);
  add_sampling_options(app, options.settings);
  add_cache_options(app, options.settings);
  add_paper_options(app, options.settings.paper);
  add_display_options(app, options.automatic_exposure, options.exposure, options.display);
}

void check_render_options(const CLI::App& app, const RenderOptions& options) {
  if (options.scene_file.empty()) {
    throw UsageError("render: no scene is given; write: lumivec render SCENE -o OUT.exr");
  }
  if (options.outputs.empty()) {
    throw UsageError("render: no output is given; add -o OUT.exr, .png or .jpg");
  }
  if (app.count("--animation") && !app.count("--at"))
    throw UsageError("--animation: no moment is given; add --at SECONDS");
  if (app.count("--half") && app.count("--float")) {
    throw UsageError("--half, --float: contradict each other; give one of them");
  }
  if (app.count("--validity") && options.settings.integrator != Integrator::light_vectors) {
    throw UsageError("--validity: path keeps no records; leave out --integrator path");
  }
  for (const char* option : {"--environment-strength", "--environment-rotation"}) {
    if (app.count(option) &&
        (options.environment.name.empty() || options.environment.name == "none")) {
      throw UsageError(std::string(option) +
                       ": there is no environment; add --environment FILE or --environment sky");
    }
  }

  std::vector<fs::path> files = options.outputs;
  bool has_exr = false;
  for (const fs::path& file : files) has_exr |= still_format(file) == StillFormat::exr;
  if (!has_exr && app.count("--float")) {
    throw UsageError("--float: is for OpenEXR and there is no such output; add -o OUT.exr");
  }
  if (app.count("--png-bits") && std::none_of(files.begin(), files.end(), [](const fs::path& f) {
        return still_format(f) == StillFormat::png;
      })) {
    throw UsageError("--png-bits: is for PNG and there is no such output; add -o OUT.png");
  }
  if (!options.statistics.empty()) files.push_back(options.statistics);
  std::vector<fs::path> taken = {place(options.scene_file)};
  if (options.environment.is_file()) taken.push_back(place(options.environment.name));
  const std::size_t inputs = taken.size();
  for (const fs::path& file : files) {
    const auto same = std::find(taken.begin(), taken.end(), place(file));
    if (same != taken.end()) {
      const bool is_input = std::size_t(same - taken.begin()) < inputs;
      throw UsageError(
          file.string() +
          (is_input ? ": is read and would be overwritten" : ": is given twice as an output") +
          "; choose another name");
    }
    taken.push_back(place(file));
  }
}

}  // namespace lumivec
