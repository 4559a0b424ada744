#include "viewer/commands/walk.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "integrator/render.h"
#include "loader/animate.h"
#include "viewer/atomic_file.h"
#include "viewer/errors.h"
#include "viewer/exposure.h"
#include "viewer/flip.h"
#include "viewer/image_error.h"
#include "viewer/interrupt.h"
#include "viewer/json_text.h"
#include "viewer/layered_image.h"
#include "viewer/movie_writer.h"
#include "viewer/still_writer.h"
#include "viewer/text_format.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

struct FrameReport {
  WalkEngine::Frame frame;
  ImageError error;  // of the picture
  double flip = 0.0;
  std::array<ImageError, term_count> term_errors;
  // Mean absolute change of the displayed picture since the frame before, and of the reference's.
  double change = 0.0, reference_change = 0.0;
};

// A frame as it is displayed, and what it should be.
struct Shown {
  Picture picture{0, 0}, reference{0, 0};
};

const char* reuse_name(Reuse reuse) {
  switch (reuse) {
    case Reuse::nothing:
      return "nothing";
    case Reuse::shading:
      return "shading";
    case Reuse::image:
      return "image";
  }
  return "";
}

double mean_change(const Picture& from, const Picture& to) {
  if (from.pixels.size() != to.pixels.size() || to.pixels.empty()) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < to.pixels.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      sum += std::abs(double(to.pixels[i][c]) - double(from.pixels[i][c]));
  }
  return sum / (3.0 * static_cast<double>(to.pixels.size()));
}

fs::path frame_file(const fs::path& folder, int frame, const char* extension) {
  char name[32];
  std::snprintf(name, sizeof(name), "frame_%05d.%s", frame, extension);
  return folder / name;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
    throw CommandError(folder.string() + ": cannot be made: " + error.message());
}

// What tells one walk's reference frames from another's.
nlohmann::json identity(const WalkOptions& options, const std::vector<Camera>& cameras, int width,
                        int height) {
  nlohmann::json views = nlohmann::json::array();
  for (const Camera& c : {cameras.front(), cameras.back()}) {
    nlohmann::json m;
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 3; ++j) m.push_back(c.camera_to_world[i][j]);
    }
    views.push_back(m);
  }
  return {{"scene", fs::weakly_canonical(options.scene_file).string()},
          {"frames", options.frames},
          {"animation", options.animation.value_or("")},
          {"frames_per_second", options.frames_per_second},
          {"size", {width, height}},
          {"environment", options.environment.name.string()},
          {"views", views}};
}

// The folder is this walk's, or empty and becomes it.
void claim_reference(const fs::path& folder, const nlohmann::json& identity) {
  make_folder(folder);
  const fs::path file = folder / "walk.json";
  std::ifstream in(file);
  if (in) {
    if (nlohmann::json::parse(in, nullptr, false) != identity) {
      throw CommandError(folder.string() +
                         ": holds frames of another walk; choose another folder for --reference");
    }
    return;
  }
  if (!fs::is_empty(folder)) {
    throw CommandError(folder.string() +
                       ": is not empty and holds no walk; choose another folder for --reference");
  }
  write_text_atomically(file, json_text(identity));
}

class References {
 public:
  References(const WalkOptions& options, const Scene& scene, const RenderSettings& settings)
      : options_(options), scene_(scene), settings_(settings) {
    settings_.integrator = Integrator::path;
    settings_.samples = options.reference_samples;
    settings_.terms = (1u << term_count) - 1;
    // Not the walk's random numbers: what shares its noise cannot be compared.
    settings_.seed = settings.seed ^ 0x7265660003;
  }

  LayeredImage frame(int number, const Camera& camera) const {
    const fs::path file = frame_file(options_.reference, number, "exr");
    if (!fs::exists(file)) {
      RenderStatistics statistics;
      const Framebuffer picture = render(scene_, camera, settings_, statistics);
      StillHeader header;
      header.scene = options_.scene_file.string();
      header.settings = options_.command;
      header.samples = settings_.samples;
      header.seconds = statistics.seconds_sample;
      write_exr(file, picture, {settings_.terms, ExrPrecision::half}, header);
    }
    return read_layered_image(file);
  }

 private:
  const WalkOptions& options_;
  const Scene& scene_;
  RenderSettings settings_;
};

void compare(const LayeredImage& reference, const Picture& picture, const WalkEngine& engine,
             const WalkOptions& options, const DisplayTransform& display, Shown& last,
             FrameReport& report) {
  Picture expected(picture.width, picture.height), layer(picture.width, picture.height);
  for (std::size_t t = 0; t < term_count; ++t) {
    const Picture& r = reference.layers.at(std::string(term_names[t]));
    engine.layer(static_cast<Term>(t), layer.pixels);
    report.term_errors[t] = image_error(layer, r);
    if ((options.settings.terms & (1u << t)) == 0) continue;
    for (std::size_t i = 0; i < expected.pixels.size(); ++i) expected.pixels[i] += r.pixels[i];
  }
  report.error = image_error(picture, expected);
  Picture shown = picture;
  display.apply(shown, options.exposure);
  display.apply(expected, options.exposure);
  report.flip = mean(flip_map(expected, shown));
  report.change = mean_change(last.picture, shown);
  report.reference_change = mean_change(last.reference, expected);
  last = {std::move(shown), std::move(expected)};
}

double percentile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

nlohmann::json frame_json(const FrameReport& report, bool compared) {
  nlohmann::json json = {{"seconds", report.frame.seconds},
                         {"seconds_view", report.frame.seconds_view},
                         {"seconds_records", report.frame.seconds_records},
                         {"seconds_samples", report.frame.seconds_samples},
                         {"traced", report.frame.traced},
                         {"rays", report.frame.rays},
                         {"filled", report.frame.holes},
                         {"mean_age", report.frame.mean_age},
                         {"cache_hits", report.frame.cache_hits},
                         {"cache_misses", report.frame.cache_misses}};
  if (!compared) return json;
  json["relmse"] = report.error.relmse;
  json["flip"] = report.flip;
  json["change"] = report.change;
  json["reference_change"] = report.reference_change;
  for (std::size_t t = 0; t < term_count; ++t)
    json["terms"][std::string(term_names[t])] = report.term_errors[t].relmse;
  return json;
}

// Of all frames but the first, which has nothing to go by.
nlohmann::json summary(const std::vector<FrameReport>& reports, bool compared) {
  std::vector<double> seconds, relmse, flip, traced, flicker;
  for (std::size_t i = reports.size() > 1 ? 1 : 0; i < reports.size(); ++i) {
    seconds.push_back(reports[i].frame.seconds);
    traced.push_back(static_cast<double>(reports[i].frame.traced));
    relmse.push_back(reports[i].error.relmse);
    flip.push_back(reports[i].flip);
    if (reports[i].reference_change > 0.0)
      flicker.push_back(reports[i].change / reports[i].reference_change);
  }
  nlohmann::json json = {{"first_seconds", reports.front().frame.seconds},
                         {"median_seconds", percentile(seconds, 0.5)},
                         {"99th_percentile_seconds", percentile(seconds, 0.99)},
                         {"median_traced", percentile(traced, 0.5)}};
  if (compared) {
    json["median_relmse"] = percentile(relmse, 0.5);
    json["median_flip"] = percentile(flip, 0.5);
    json["worst_flip"] = percentile(flip, 1.0);
    if (!flicker.empty()) {
      json["median_change_ratio"] = percentile(flicker, 0.5);
      json["worst_change_ratio"] = percentile(flicker, 1.0);
    }
  }
  return json;
}

bool is_movie(const fs::path& file) {
  return file.extension() == ".mp4";
}

// Of an animation that is played again and again.
double moment(const Animation& animation, double seconds) {
  const double length = animation_length(animation);
  return length > 0.0 ? std::fmod(seconds, length) : 0.0;
}

SceneChanges scene_changes(const Scene& scene, const PoseChanges& posed) {
  SceneChanges changes;
  changes.light = !posed.lights.empty();
  for (std::size_t i = 0; i < scene.instances.size() && !posed.meshes.empty(); ++i) {
    if (std::binary_search(posed.meshes.begin(), posed.meshes.end(), scene.instances[i].mesh))
      changes.deformed.push_back(static_cast<int>(i));
  }
  std::set_difference(posed.instances.begin(), posed.instances.end(), changes.deformed.begin(),
                      changes.deformed.end(), std::back_inserter(changes.moved));
  return changes;
}

}  // namespace

int run_walk(const WalkOptions& options) {
  const InterruptGuard interrupt;
  std::vector<std::string> warnings;
  std::optional<tbb::global_control> limit;
  if (options.settings.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism,
                  std::size_t(options.settings.threads));
  }
  if (!options.statistics.empty()) check_writable(options.statistics);
  if (!options.output.empty() && !is_movie(options.output)) make_folder(options.output);
  const DisplayTransform display(options.display);
  LoadReport loading;
  const auto warn = [&](const std::string& warning) {
    warnings.push_back(warning);
    if (!options.quiet) std::cerr << "lumivec: warning: " << warning << '\n';
  };
  Scene scene =
      load_lit_scene(options.scene_file, options.load, options.environment, warn, loading);
  flatten_cameras(scene, options.scene_file, warn);
  const Camera camera = choose_camera(scene, options.camera);
  RenderSettings settings = options.settings;
  const PictureSize size = options.size ? *options.size : size_for(camera);
  settings.width = size.width;
  settings.height = size.height;

  std::optional<std::size_t> animation;
  if (options.animation) {
    animation = choose_animation(scene, "--animation", *options.animation);
    pose_scene(scene, *animation, 0.0);
  }

  // What the eye looks at first is what an orbit goes around.
  V3d pivot;
  {
    LiveTracer tracer(scene, [&] {
      RenderSettings s = settings;
      s.integrator = Integrator::path;
      return s;
    }());
    tracer.set_view(camera, 1, 1);
    VisibleSurfaces seen;
    tracer.see(seen);
    pivot = tracer.pivot(seen);
  }
  const std::vector<Camera> cameras = camera_path(options.path, camera, pivot, options.frames);
  const bool compared = !options.reference.empty();
  if (compared)
    claim_reference(options.reference, identity(options, cameras, size.width, size.height));

  RenderSettings traced = settings;
  traced.terms = (1u << term_count) - 1;  // what is shown is chosen afterwards
  WalkEngine engine(scene, traced, options.walk_mode());
  const References references(options, scene, settings);
  Picture picture(size.width, size.height);
  double exposure = options.exposure;
  std::vector<FrameReport> reports;
  Shown last_shown;
  int reference_frame = 0;
  std::optional<MovieWriter> movie;
  if (is_movie(options.output))
    movie.emplace(options.output, size.width, size.height, options.frames_per_second);
  for (int i = 0; i < options.frames && !interrupt.requested(); ++i) {
    const Camera& view = cameras[std::size_t(i)];
    FrameReport report;
    double update_seconds = 0.0;
    if (animation && i > 0) {
      const PoseChanges posed = pose_scene(
          scene, *animation, moment(scene.animations[*animation], i / options.frames_per_second));
      const auto start = std::chrono::steady_clock::now();
      engine.update(scene_changes(scene, posed));
      update_seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    report.frame = engine.advance(view, std::max(options.frame_time - update_seconds, 0.0),
                                  options.settings.terms, picture.pixels);
    report.frame.seconds += update_seconds;
    if (i == 0 && options.automatic_exposure) exposure = automatic_exposure(picture.pixels);
    // A resting eye has one reference.
    if (i == 0 || animation || !same_view(view, cameras[std::size_t(i) - 1])) reference_frame = i;
    if (compared)
      compare(references.frame(reference_frame, view), picture, engine, options, display,
              last_shown, report);
    if (!options.output.empty()) {
      Picture shown = picture;
      display.apply(shown, exposure);
      if (movie) {
        movie->add(shown);
      } else {
        StillHeader header;
        header.scene = options.scene_file.string();
        header.settings = options.command;
        write_displayed(frame_file(options.output, i, "png"), shown, {8, display.is_srgb()},
                        header);
      }
    }
    reports.push_back(report);
  }
  if (reports.empty()) return exit_interrupted;
  if (movie) movie->finish();

  const nlohmann::json figures = summary(reports, compared);
  if (!options.statistics.empty()) {
    nlohmann::json frames = nlohmann::json::array();
    for (const FrameReport& report : reports) frames.push_back(frame_json(report, compared));
    write_text_atomically(options.statistics,
                          json_text({{"command", options.command},
                                     {"mode", options.mode},
                                     {"reuse", reuse_name(options.walk_mode().reuse)},
                                     {"size", {size.width, size.height}},
                                     {"frame_time", options.frame_time},
                                     {"summary", figures},
                                     {"records", engine.statistics().records},
                                     {"cache_bytes", engine.statistics().cache_bytes},
                                     {"warnings", warnings},
                                     {"frames", frames}}));
  }
  if (!options.quiet) {
    std::printf(
        "%zu frames, %s: first %.1f ms, median %.1f ms, 99%% %.1f ms; %.0f samples a frame\n",
        reports.size(), options.mode.c_str(), 1e3 * double(figures["first_seconds"]),
        1e3 * double(figures["median_seconds"]), 1e3 * double(figures["99th_percentile_seconds"]),
        double(figures["median_traced"]));
    if (compared) {
      std::printf("median relMSE %.4g, median FLIP %.4f, worst %.4f, last relMSE %.4g\n",
                  double(figures["median_relmse"]), double(figures["median_flip"]),
                  double(figures["worst_flip"]), reports.back().error.relmse);
      if (figures.contains("median_change_ratio")) {
        std::printf("change between frames against the reference's: median %.2f, worst %.2f\n",
                    double(figures["median_change_ratio"]), double(figures["worst_change_ratio"]));
      }
    }
    std::fflush(stdout);
  }
  return interrupt.requested() ? exit_interrupted : exit_success;
}

}  // namespace lumivec
