#include "viewer/commands/render.h"

#include <OpenImageIO/imageio.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>

#include "integrator/render.h"
#include "integrator/seconds_since.h"
#include "viewer/atomic_file.h"
#include "viewer/errors.h"
#include "viewer/exposure.h"
#include "viewer/interrupt.h"
#include "viewer/json_text.h"
#include "viewer/machine.h"
#include "viewer/progress.h"
#include "viewer/render_report.h"
#include "viewer/still_writer.h"
#include "viewer/text_format.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

// Warnings go to the report, and to stderr unless they would be unwanted there.
class Warnings {
 public:
  Warnings(std::vector<std::string>& all, bool quiet) : all_(all), quiet_(quiet) {}

  void add(const std::string& warning) {
    constexpr std::size_t shown = 10;  // a broken export has hundreds of a kind
    all_.push_back(warning);
    if (quiet_ || all_.size() > shown + 1) return;
    std::cerr << "lumivec: warning: "
              << (all_.size() <= shown ? warning : "and more; lumivec info lists them all") << '\n';
  }

 private:
  std::vector<std::string>& all_;
  bool quiet_;
};

bool is_displayed(const fs::path& file) {
  return still_format(file) != StillFormat::exr;
}

// Everything that can be known to fail later fails here, before time is spent.
void check_outputs(const RenderOptions& options) {
  for (const fs::path& file : options.outputs) check_writable(file);
  if (!options.statistics.empty()) check_writable(options.statistics);
}

void check_picture_size(const RenderOptions& options, const RenderSettings& settings) {
  constexpr int largest_jpeg_side = 65500;
  for (const fs::path& file : options.outputs) {
    if (still_format(file) == StillFormat::jpeg &&
        std::max(settings.width, settings.height) > largest_jpeg_side) {
      throw UsageError(file.string() + ": JPEG ends at " + std::to_string(largest_jpeg_side) +
                       " pixels a side; use .png or .exr");
    }
  }
  // Of Framebuffer, and of the copy that is displayed.
  constexpr std::uint64_t pixel_bytes = (term_count + 1) * sizeof(Color) + 2 * sizeof(V3f) +
                                        sizeof(float) + 2 * sizeof(std::uint32_t) + sizeof(Color);
  const std::uint64_t bytes =
      std::uint64_t(settings.width) * std::uint64_t(settings.height) * pixel_bytes;
  const std::uint64_t memory = physical_memory_bytes();
  if (memory > 0 && bytes > memory) {
    throw CommandError("--size: a picture of " + std::to_string(settings.width) + "x" +
                       std::to_string(settings.height) + " takes " + format_bytes(bytes) +
                       " and this machine has " + format_bytes(memory) + "; choose a smaller one");
  }
}

ProgressStyle progress_style(bool quiet) {
  if (quiet) return ProgressStyle::none;
  return error_output_is_terminal() ? ProgressStyle::bar : ProgressStyle::lines;
}

Framebuffer sample(const RenderOptions& options, const Scene& scene, const Camera& camera,
                   const InterruptGuard& interrupt, RenderReport& report) {
  ProgressPrinter printer(std::cerr, progress_style(options.quiet), error_output_columns());
  const auto on_progress = [&](const RenderProgress& progress) {
    printer.update(progress);
    return !interrupt.requested();
  };
  try {
    Framebuffer framebuffer =
        render(scene, camera, report.settings, report.statistics, on_progress);
    printer.clear();
    return framebuffer;
  } catch (...) {
    printer.clear();
    throw;
  }
}

Picture beauty_picture(const Framebuffer& framebuffer) {
  Picture picture(framebuffer.width, framebuffer.height);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) picture.pixels[i] = framebuffer.beauty(i);
  return picture;
}

// Writes one file; display is set if any output needs it.
void write_output(const fs::path& file, const RenderOptions& options,
                  const Framebuffer& framebuffer, const Picture& displayed, bool is_srgb,
                  const StillHeader& header, Warnings& warnings) {
  if (is_displayed(file)) {
    write_displayed(file, displayed, {options.png_bits, is_srgb}, header);
    return;
  }
  const ExrOptions exr = {options.settings.terms, options.precision};
  const std::uint64_t clamped = write_exr(file, framebuffer, exr, header);
  if (clamped > 0) {
    warnings.add(file.string() + ": " + format_count(clamped) +
                 " pixels are brighter than 65504, the most that half precision holds; " +
                 "use --float to keep them");
  }
}

// Writes every output that can be written. Returns the first failure's text, empty if there was
// none.
std::string write_outputs(const RenderOptions& options, const Framebuffer& framebuffer,
                          const DisplayTransform* display, RenderReport& report,
                          Warnings& warnings) {
  StillHeader header;
  header.scene = options.scene_file.string();
  header.settings = options.command;
  header.samples = samples_per_pixel(report.statistics, report.settings);
  header.seconds = report.statistics.seconds_sample;

  Picture displayed;
  report.exposure = options.exposure;
  if (display) {
    displayed = beauty_picture(framebuffer);
    if (options.automatic_exposure) report.exposure = automatic_exposure(displayed.pixels);
    display->apply(displayed, report.exposure);
    report.display = display->display();
    report.view = display->view();
  }
  std::string failure;
  for (const fs::path& file : options.outputs) {
    try {
      write_output(file, options, framebuffer, displayed, display && display->is_srgb(), header,
                   warnings);
      report.outputs.push_back(file);
    } catch (const CommandError& error) {
      if (failure.empty()) failure = error.what();
    }
  }
  return failure;
}

}  // namespace

int run_render(const RenderOptions& options) {
  const Clock::time_point start = Clock::now();
  const InterruptGuard interrupt;
  RenderReport report;
  report.scene_file = options.scene_file;
  report.command = options.command;
  report.settings = options.settings;
  Warnings warnings(report.warnings, options.quiet);

  std::optional<tbb::global_control> limit;
  if (options.settings.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism,
                  std::size_t(options.settings.threads));
    OIIO::attribute("threads", options.settings.threads);
  }

  check_outputs(options);
  std::optional<DisplayTransform> display;
  if (std::any_of(options.outputs.begin(), options.outputs.end(), is_displayed)) {
    display.emplace(options.display);
  } else if (options.automatic_exposure || options.exposure != 0.0) {
    warnings.add("--exposure: changes displayed pictures alone, and there is none");
  }

  LoadReport loading;
  Scene scene = load_lit_scene(
      options.scene_file, options.load, options.environment,
      [&](const std::string& warning) { warnings.add(warning); }, loading);
  pose(scene, options.pose);
  const Camera camera = choose_camera(scene, options.camera);
  report.scene_name = scene.name;
  report.camera = camera.name;
  const PictureSize size = options.size ? *options.size : size_for(camera);
  report.settings.width = size.width;
  report.settings.height = size.height;
  check_picture_size(options, report.settings);
  report.seconds_load = seconds_since(start);

  const Framebuffer framebuffer = sample(options, scene, camera, interrupt, report);
  report.interrupted = interrupt.requested();
  if (report.interrupted && report.statistics.samples == 0) {
    std::cerr << "lumivec: interrupted before the first sample; nothing is written" << std::endl;
    return exit_interrupted;
  }

  const Clock::time_point write_start = Clock::now();
  const std::string failure =
      write_outputs(options, framebuffer, display ? &*display : nullptr, report, warnings);
  report.seconds_write = seconds_since(write_start);
  report.seconds_total = seconds_since(start);
  if (!options.statistics.empty()) {
    write_text_atomically(options.statistics, json_text(render_json(report)));
  }
  if (!options.quiet) std::cout << render_summary(report) << std::flush;
  if (!failure.empty()) throw CommandError(failure);
  return report.interrupted ? exit_interrupted : exit_success;
}

}  // namespace lumivec
