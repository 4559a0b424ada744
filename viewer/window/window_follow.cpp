// How the window follows its engine, its renders in the background and its files.
#include <algorithm>
#include <cmath>

#include "viewer/errors.h"
#include "viewer/exposure.h"
#include "viewer/window/script_player.h"
#include "viewer/window/window.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

constexpr double watch_interval = 0.25;  // seconds
constexpr double reference_delay = 0.5;  // seconds that a view rests before one is rendered
constexpr int reference_samples = 256;   // a pixel
constexpr std::uint64_t reference_seed = 0x7265660003;  // not the window's noise
constexpr double meter_share = 0.1;  // of what is known, a frame's measurement replaces

}  // namespace

void Window::open(const fs::path& file, bool keep_camera) {
  SceneSource source = status_.scene ? status_.scene->source : options_.scene;
  if (file != source.file && !source.file.empty()) {
    // What was said of the other file alone: which of its scenes, that it is trusted, and its pose.
    source.load.scene.clear();
    source.load.allow_outside_files = false;
    source.pose = {};
  }
  source.file = file;
  opening_ = file;
  engine_.open(source, keep_camera);
}

void Window::follow_engine() {
  status_ = engine_.status();
  if (status_.error_number != error_seen_) {
    error_seen_ = status_.error_number;
    // The window was opened for this scene alone.
    if (!status_.scene && !options_.scene.file.empty() && opening_ == options_.scene.file)
      throw CommandError(status_.error);
    say(status_.error, true);
  }
  if (status_.scene_number != scene_seen_) {
    scene_seen_ = status_.scene_number;
    take_scene(status_);
  }
  if (engine_.take_picture()) take_picture();
  if (engine_.take_layers()) take_layers();
}

void Window::take_scene(const EngineStatus& status) {
  const LoadedScene& scene = *status.scene;
  reference_render_.cancel();
  reference_ = {};
  if (status.opened_number == opened_seen_) return;  // the same file, changed by the user
  const bool first = opened_seen_ == 0;
  opened_seen_ = status.opened_number;
  edits_.begin();
  state_.picked.reset();
  navigator_.set_scale(0.5 * scene.bounds.size().length());
  std::vector<fs::path> files = files_of_scene(scene.source.file);
  files.insert(files.end(), scene.files.begin(), scene.files.end());
  if (scene.source.environment.is_file()) files.push_back(scene.source.environment.name);
  watch_.watch(std::move(files));
  remember_file(state_.settings, scene.source.file);
  glfwSetWindowTitle(gl_.handle(), (scene.source.file.filename().string() + " - lumivec").c_str());
  if (state_.message_is_error) state_.message.clear();
  if (!status.keep_camera || first) {
    const Camera camera = choose_camera(scene.scene, first ? options_.camera : std::string());
    state_.file_camera = 0;
    for (std::size_t i = 0; i < scene.scene.cameras.size(); ++i) {
      if (same_view(scene.scene.cameras[i], camera)) state_.file_camera = int(i);
    }
    state_.camera.take(camera, scene.bounds.isEmpty() ? V3d(0.0) : scene.bounds.center());
    pivot_pending_ = true;
    metering_ = options_.automatic_exposure;
    if (first && !options_.size && state_.settings.width == 0) {
      // As wide as the camera asks.
      const PictureSize wanted = size_for(camera);
      const double aspect = std::clamp(double(wanted.width) / wanted.height, 0.5, 2.4);
      const float bar = status_height(text_size_);
      const double height = usual_height * double(scale_.interface);
      const auto panel = double(panel_width(usual_width * scale_.interface, text_size_));
      const double width = (height - double(bar)) * aspect + (state_.settings.panels ? panel : 0.0);
      glfwSetWindowSize(gl_.handle(), int(width), int(height));
    }
  } else {
    state_.file_camera = std::min(state_.file_camera, int(scene.scene.cameras.size()) - 1);
    say(scene.source.file.filename().string() + " read again");
  }
  if (!scene.warnings.empty()) {
    const std::size_t more = scene.warnings.size() - 1;
    say(scene.warnings.front() +
        (more > 0 ? " (and " + std::to_string(more) + " more; lumivec info lists them)" : ""));
  }
}

void Window::take_picture() {
  const EnginePicture& picture = engine_.picture();
  if (picture.scene != status_.scene_number) return;  // of a scene that is gone
  const double time = now();
  if (first_picture_ < 0.0) first_picture_ = time;
  const double interval = time - picture_at_;
  picture_at_ = time;
  constexpr double pause = 5.0;  // seconds; what took longer was no frame
  if (interval > 0.0 && interval < pause) {
    const double rate = double(picture.number - picture_seen_) / interval;
    double& meter = figures_.frames_per_second;
    meter = meter > 0.0 ? meter + meter_share * (rate - meter) : rate;
  }
  picture_seen_ = picture.number;
  if (picture.samples < figures_.samples || figures_.samples == 0.0) moved_at_ = time;
  const double pixels = double(picture.width) * double(picture.height);
  figures_.frame_seconds = picture.figures.seconds;
  figures_.traced_share = double(picture.figures.traced) / pixels;
  figures_.samples = picture.samples;
  figures_.seconds = time - moved_at_;
  figures_.records = picture.records;
  figures_.cache_bytes = picture.cache_bytes;
  const auto lookups = double(picture.figures.cache_hits + picture.figures.cache_misses);
  figures_.hit_rate = lookups > 0.0 ? double(picture.figures.cache_hits) / lookups : 0.0;
  figures_.width = picture.width;
  figures_.height = picture.height;

  if (pivot_pending_ && same_view(picture.camera, state_.camera.camera())) {
    state_.camera.set_pivot(picture.pivot);
    pivot_pending_ = false;
  }
  if (metering_ && same_view(picture.camera, state_.camera.camera())) {
    metering_ = false;
    state_.look.exposure = automatic_exposure(picture.pixels);
  }
  if (picture.pick.number == picks_ && picture.pick.number != pick_seen_) {
    pick_seen_ = picture.pick.number;
    if (picture.pick.object >= 0) {
      state_.camera.set_pivot(picture.pick.point);
      state_.picked = picture.pick;
      say("Pivot on " + object_name(status_.scene->scene, picture.pick.object));
    } else {
      state_.picked.reset();
      say("Nothing is there");
    }
  }
}

void Window::take_layers() {
  const LayerPicture& layers = engine_.layers();
  if (layers.scene != status_.scene_number) return;
  shares_ = term_shares(layers.layers);
  ++layers_taken_;
}

// What is shown of the light, or of the surfaces, whenever there is something new of it.
void Window::upload_pictures() {
  const EnginePicture& picture = engine_.picture();
  const LayerPicture& layers = engine_.layers();
  if (!status_.scene || picture.scene != status_.scene_number) return;
  const bool light = state_.layer == Layer::light;
  const bool errors = light && state_.error_map && reference_.ready &&
                      reference_.width == picture.width && reference_.height == picture.height &&
                      reference_.terms == picture.terms &&
                      same_view(reference_.camera, picture.camera);
  const Uploaded wanted = {light ? picture.number : 0, light ? 0 : layers_taken_, state_.layer,
                           errors};
  if (wanted == uploaded_) return;
  if (!light) {
    if (layers.scene != status_.scene_number || layers.width == 0) return;
    const Picture surfaces =
        surface_picture(layers.surfaces, layers.width, layers.height, state_.layer);
    display_->upload(0, surfaces.pixels.data(), layers.width, layers.height);
  } else if (errors) {
    const Picture map =
        error_picture(picture.pixels, reference_pixels_, picture.width, picture.height);
    display_->upload(0, map.pixels.data(), picture.width, picture.height);
  } else {
    display_->upload(0, picture.pixels.data(), picture.width, picture.height);
    if (!picture.compared.empty())
      display_->upload(1, picture.compared.data(), picture.width, picture.height);
  }
  uploaded_ = wanted;
  figures_.shows_errors = errors;
  figures_.shows_surfaces = !light;
}

void Window::make_histogram() {
  constexpr double interval = 0.2;  // seconds
  constexpr int stride = 2;         // pixels
  const EnginePicture& picture = engine_.picture();
  if (!state_.show_histogram || picture.width == 0 || now() - histogram_at_ < interval) return;
  histogram_at_ = now();
  histogram_ = histogram(picture.pixels, picture.width, state_.look.exposure, stride);
}

void Window::follow_renders() {
  const BackgroundRender::State still = still_.state();
  if (still.ended != stills_seen_) {
    stills_seen_ = still.ended;
    say(still.said, still.failed);
  }
  const BackgroundRender::State reference = reference_render_.state();
  // One for an earlier view may have ended since that was given up.
  if (reference.ended == reference_.render && reference_.render != 0 && !reference_.ready &&
      !reference_.failed) {
    reference_.ready = !reference.failed;
    reference_.failed = reference.failed;
    if (reference.failed) say(reference.said, true);
  }
}

// The view rests: what it should look like is path-traced meanwhile.
void Window::render_reference() {
  if (!state_.error_map || !status_.scene) {
    if (reference_.render != 0) reference_render_.cancel();
    reference_ = {};  // one that failed is tried again when it is asked for again
    return;
  }
  const EnginePicture& picture = engine_.picture();
  if (picture.width == 0 || picture.scene != status_.scene_number) return;
  const Camera& camera = state_.camera.camera();
  const bool same = reference_.scene == status_.scene_number && reference_.terms == state_.terms &&
                    reference_.width == picture.width && reference_.height == picture.height &&
                    same_view(reference_.camera, camera);
  if (same && reference_.render != 0) return;  // it goes on, is there, or cannot be made
  if (!same_view(picture.camera, camera) || now() - moved_at_ < reference_delay) return;
  reference_render_.cancel();
  reference_ = {};
  RenderSettings settings;
  settings.width = picture.width;
  settings.height = picture.height;
  settings.samples = reference_samples;
  settings.terms = state_.terms;
  settings.threads = state_.knobs.threads;
  settings.seed = state_.knobs.seed ^ reference_seed;
  const int number = reference_render_.start(
      status_.scene, edits_.patch(), camera, settings,
      [this](const Framebuffer& made, const RenderStatistics&) {
        reference_pixels_.resize(made.pixel_count());
        for (std::size_t i = 0; i < reference_pixels_.size(); ++i)
          reference_pixels_[i] = made.beauty(i);
        return std::string();
      },
      [] { glfwPostEmptyEvent(); });
  reference_ = {camera, state_.terms, status_.scene_number, picture.width, picture.height, number,
                false,  false};
}

void Window::follow_files() {
  // While another file is loaded, this one does not come back.
  if (!status_.scene || !status_.doing.empty() || now() - watched_at_ < watch_interval) return;
  watched_at_ = now();
  if (watch_.changed(now())) open(status_.scene->source.file, true);
}

}  // namespace lumivec
