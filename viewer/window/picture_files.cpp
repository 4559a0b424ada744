#include "viewer/window/picture_files.h"

#include <unistd.h>

#include <fstream>

#include "viewer/still_writer.h"
#include "viewer/window/new_files.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

bool is_srgb(const DisplayOptions& display) {
  return display.display.starts_with("sRGB");
}

std::string stem_of(const LoadedScene& scene) {
  return scene.source.file.stem().string();
}

Color sum_of(const Framebuffer& picture, std::uint32_t terms, std::size_t pixel) {
  Color sum(0.0f);
  for (std::size_t t = 0; t < std::size_t(term_count); ++t) {
    if (terms >> t & 1u) sum += picture.terms[t][pixel];
  }
  return sum;
}

}  // namespace

fs::path write_screenshot(const fs::path& folder, const Picture& pixels, const ShownPicture& shown,
                          const WindowFigures& figures) {
  StillHeader header;
  header.scene = shown.scene.source.file.string();
  header.settings = settings_text(shown);
  header.samples = figures.samples;
  header.seconds = figures.seconds;
  NewFiles files(folder, stem_of(shown.scene), {".png"});
  write_displayed(files.file(0), pixels, {8, is_srgb(shown.display)}, header);
  files.keep();
  return files.file(0);
}

void start_still(BackgroundRender& render, const std::shared_ptr<const LoadedScene>& scene,
                 const ShownPicture& shown, const fs::path& folder,
                 const std::function<void()>& on_news) {
  const WindowState& state = shown.state;
  const StillWish still = state.still;
  RenderSettings settings;
  settings.width = shown.size.width;
  settings.height = shown.size.height;
  settings.samples = still.samples;
  settings.integrator = still.path_tracing ? Integrator::path : Integrator::light_vectors;
  settings.cache_error = state.knobs.error;
  settings.terms = all_terms;
  settings.seed = state.knobs.seed;
  settings.threads = state.knobs.threads;
  // What is displayed of it: neither the window's method nor its maps.
  WindowState plain = state;
  plain.knobs.light_vectors = !still.path_tracing;
  plain.look.mode = DisplayMode::view;
  plain.look.channel = Channel::color;
  plain.layer = Layer::light;
  plain.wipe = plain.error_map = false;
  StillHeader header;
  header.scene = scene->source.file.string();
  header.settings = "--spp " + std::to_string(still.samples) + " " +
                    settings_text({shown.scene, shown.patch, plain, shown.display, shown.size});
  header.samples = still.samples;
  const auto finish = [still, header, folder, stem = stem_of(*scene), terms = state.terms,
                       display = shown.display, exposure = state.look.exposure](
                          const Framebuffer& picture, const RenderStatistics& statistics) {
    StillHeader made = header;
    made.seconds = statistics.seconds_sample;
    std::vector<std::string> extensions;
    if (still.exr) extensions.emplace_back(".exr");
    if (still.png) extensions.emplace_back(".png");
    NewFiles files(folder, stem, extensions);
    std::string written;
    if (still.exr) {
      write_exr(files.file(0), picture, {all_terms, ExrPrecision::half, terms}, made);
      written = files.file(0).string();
    }
    if (still.png) {
      const fs::path& png = files.file(extensions.size() - 1);
      Picture displayed(picture.width, picture.height);
      for (std::size_t i = 0; i < displayed.pixels.size(); ++i)
        displayed.pixels[i] = sum_of(picture, terms, i);
      DisplayTransform(display).apply(displayed, exposure);
      write_displayed(png, displayed, {8, is_srgb(display)}, made);
      written += (written.empty() ? "" : " and ") + png.string();
    }
    files.keep();
    return written + " written";
  };
  render.start(scene, shown.patch, state.camera.camera(), settings, finish, on_news);
}

std::uint64_t resident_bytes() {
  std::ifstream in("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  if (!(in >> all >> resident)) return 0;
  return resident * std::uint64_t(sysconf(_SC_PAGESIZE));
}

}  // namespace lumivec
