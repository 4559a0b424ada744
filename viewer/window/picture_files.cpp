#include "viewer/window/picture_files.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "viewer/camera_text.h"
#include "viewer/errors.h"
#include "viewer/still_writer.h"
#include "viewer/text_format.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

bool is_srgb(const DisplayOptions& display) {
  return display.display.starts_with("sRGB");
}

std::string stem_of(const LoadedScene& scene) {
  return scene.source.file.stem().string();
}

}  // namespace

fs::path free_name(const fs::path& folder, const std::string& stem, const std::string& extension) {
  constexpr int most = 9999;
  for (int i = 1; i <= most; ++i) {
    char number[16];
    std::snprintf(number, sizeof(number), "_%04d", i);
    const fs::path file = folder / (stem + number + extension);
    std::error_code error;
    if (!fs::exists(fs::symlink_status(file, error))) return file;
  }
  throw CommandError(folder.string() + ": holds 9999 pictures of this scene; move some away");
}

std::string settings_text(const WindowState& state, const DisplayOptions& display) {
  std::string text = "--camera " + camera_text(state.camera.camera(), state.camera.pivot()) +
                     " --terms " + terms_text(state.terms) + " --exposure " +
                     format_number(state.look.exposure) + " --display '" + display.display +
                     "' --view '" + display.view + "'";
  if (!display.look.empty()) text += " --look '" + display.look + "'";
  if (!display.config.empty()) text += " --ocio '" + display.config + "'";
  return text;
}

fs::path write_screenshot(const fs::path& folder, const Picture& shown, const LoadedScene& scene,
                          const WindowState& state, const DisplayOptions& display,
                          const WindowFigures& figures) {
  const fs::path file = free_name(folder, stem_of(scene), ".png");
  StillHeader header;
  header.scene = scene.source.file.string();
  header.settings = settings_text(state, display);
  header.samples = figures.samples;
  header.seconds = figures.seconds;
  write_displayed(file, shown, {8, is_srgb(display)}, header);
  return file;
}

void start_still(BackgroundRender& render, const std::shared_ptr<const LoadedScene>& scene,
                 const WindowState& state, const DisplayOptions& display, const fs::path& folder,
                 const PictureSize& size, const std::function<void()>& on_news) {
  const StillWish& still = state.still;
  RenderSettings settings;
  settings.width = size.width;
  settings.height = size.height;
  settings.samples = still.samples;
  settings.integrator = still.path_tracing ? Integrator::path : Integrator::light_vectors;
  settings.cache_error = state.knobs.error;
  settings.terms = state.terms;
  settings.seed = state.knobs.seed;
  settings.threads = state.knobs.threads;
  StillHeader header;
  header.scene = scene->source.file.string();
  header.settings = settings_text(state, display) + " --spp " + std::to_string(still.samples);
  header.samples = still.samples;
  const fs::path exr = still.exr ? free_name(folder, stem_of(*scene), ".exr") : fs::path();
  const fs::path png = still.png ? free_name(folder, stem_of(*scene), ".png") : fs::path();
  const double exposure = state.look.exposure;
  const auto finish = [=](const Framebuffer& picture, const RenderStatistics& statistics) {
    StillHeader made = header;
    made.seconds = statistics.seconds_sample;
    std::string written;
    if (!exr.empty()) {
      write_exr(exr, picture, {settings.terms, ExrPrecision::half}, made);
      written = exr.string();
    }
    if (!png.empty()) {
      Picture shown(picture.width, picture.height);
      for (std::size_t i = 0; i < shown.pixels.size(); ++i) shown.pixels[i] = picture.beauty(i);
      DisplayTransform(display).apply(shown, exposure);
      write_displayed(png, shown, {8, is_srgb(display)}, made);
      written += (written.empty() ? "" : " and ") + png.string();
    }
    return written + (written.empty() ? "" : " written");
  };
  render.start(scene, state.camera.camera(), settings, finish, on_news);
}

std::uint64_t resident_bytes() {
  std::ifstream in("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  if (!(in >> all >> resident)) return 0;
  return resident * std::uint64_t(sysconf(_SC_PAGESIZE));
}

}  // namespace lumivec
