#include "viewer/walk/walk_engine.h"

#include <algorithm>
#include <cmath>

#include "integrator/live_photons.h"
#include "integrator/seconds_since.h"

namespace lumivec {
namespace {

// Before any has been measured.
constexpr double first_sample_seconds = 4e-6;
// How much of what is known the last frame's measurement replaces; more where samples have become
// much cheaper, as they do when cached light is there.
constexpr double learning = 0.3;
constexpr double much_cheaper = 0.5, learning_of_much = 0.7;
// Of a frame's time for tracing, records have this share while there are some to make.
constexpr double share_of_records = 0.33;
constexpr double share_of_records_at_rest = 0.55;
// Likewise what there is has this share to become better in, as long as the eye moves.
constexpr double share_of_refining = 0.1;
// And photons this one, as long as there are too few.
constexpr double share_of_photons = 0.06;
// At rest photons are traced as often as a still does, and their noise takes samples of its own.
constexpr double share_of_photons_at_rest = 0.25;
constexpr double share_of_records_beside_photons = 0.4;
// The first picture may take so long, or a frame's time if that is more: without any record its
// samples would be whole paths, which are noisy for long.
constexpr double first_frame_seconds = 0.2;
// However slow a machine is, records have at least this share of a frame's time.
constexpr double least_share_of_records = 0.25;
// A view is at rest after so many frames. From then on frames may take so many times as long: what
// is done once a frame is done less often.
constexpr int frames_to_rest = 8;
constexpr double longer_at_rest = 3.0;
// Samples taken before cached light has become better count like so many at most.
constexpr float most_outdated_samples = 4.0f;
// When cached light is known to a finer error: what is dropped is noise that comes back.
constexpr float most_samples_of_coarser_records = 12.0f;
// Cached light is made for what the eye sees in so many frames if it goes on as it does.
constexpr int frames_ahead = 8;
// Changes of the light show for so long.
constexpr double restless_seconds = 1.0;
// However slow a machine is, at least this share of the pixels is traced in every frame.
constexpr double least_traced_share = 0.01;

RenderSettings with_integrator(RenderSettings settings, const WalkMode& mode) {
  settings.integrator = mode.light_vectors ? Integrator::light_vectors : Integrator::path;
  return settings;
}

}  // namespace

bool same_view(const Camera& a, const Camera& b) {
  return a.camera_to_world == b.camera_to_world && a.kind == b.kind && a.yfov == b.yfov &&
         a.xmag == b.xmag && a.ymag == b.ymag && a.znear == b.znear && a.zfar == b.zfar;
}

WalkEngine::WalkEngine(const Scene& scene, const RenderSettings& settings, const WalkMode& mode)
    : width_(settings.width),
      height_(settings.height),
      mode_(mode),
      tracer_(scene, with_integrator(settings, mode)),
      visibility_(settings.width, settings.height),
      shading_(settings.width, settings.height),
      sample_seconds_(first_sample_seconds) {}

// While the eye moves, samples are what pixels' middles see, so that each belongs to the surface
// that it is kept with; at rest they are spread, which smooths edges.
void WalkEngine::trace_all() {
  requests_.clear();
  const std::size_t pixels = std::size_t(width_) * std::size_t(height_);
  for (std::size_t i = 0; i < pixels; ++i)
    requests_.push_back({static_cast<std::uint32_t>(i), frame_, 1});
  tracer_.trace(requests_, moved_, samples_);
  shading_.add(samples_);
  traced_ = requests_.size();
}

// Samples that were taken before cached light became better are worth less.
void WalkEngine::change_light(const std::function<void()>& change) {
  const unsigned generation = tracer_.generation();
  change();
  if (tracer_.generation() != generation) shading_.doubt_cached(most_samples_of_coarser_records);
}

// The eye goes on as it went from the last frame to this one.
void WalkEngine::expect_view(const Camera& camera) {
  if (!last_ || same_view(*last_, camera) || mode_.reuse == Reuse::nothing) {
    tracer_.expect_view(nullptr);
    return;
  }
  const M44d motion = last_->camera_to_world.inverse() * camera.camera_to_world;
  Camera expected = camera;
  for (int i = 0; i < frames_ahead; ++i) expected.camera_to_world *= motion;
  tracer_.expect_view(&expected);
}

// As a still has, a light path for each sample of a view at rest.
void WalkEngine::gather_photons(double seconds) {
  if (changes_ && seconds_since_change_ < restless_seconds) return;
  PhotonDemand demand = PhotonDemand::grow;
  if (resting_ >= frames_to_rest)
    demand = samples_at_rest_ >= next_map_ ? PhotonDemand::another : PhotonDemand::keep;
  change_light([&] {
    if (tracer_.gather_photons(seconds, demand))
      next_map_ = samples_at_rest_ + LivePhotons::paths_of_map_at_rest;
  });
}

void WalkEngine::improve(double seconds) {
  tracer_.improve(seconds, moved_ ? share_of_refining / share_of_records * seconds : seconds,
                  resting_ >= frames_to_rest);
}

// Points in image space are only guesses of what pixels show.
void WalkEngine::verify_chosen() {
  if (mode_.reuse != Reuse::image) return;
  pixels_.clear();
  for (const LiveRequest& r : requests_) pixels_.push_back(r.pixel);
  visibility_.verify(tracer_, pixels_, others_);
  shading_.clear(others_);
}

void WalkEngine::trace_within(double seconds) {
  const Clock::time_point start = Clock::now();
  const double pixels = static_cast<double>(width_) * static_cast<double>(height_);
  const auto count = static_cast<std::size_t>(
      std::clamp(seconds / sample_seconds_, std::ceil(least_traced_share * pixels), pixels));
  shading_.choose(count, requests_);
  verify_chosen();
  tracer_.trace(requests_, moved_, samples_);
  shading_.add(samples_);
  traced_ = 0;
  for (const LiveRequest& r : requests_) traced_ += r.count;
  if (traced_ == 0) return;
  const double each = seconds_since(start) / static_cast<double>(traced_);
  sample_seconds_ += (each < much_cheaper * sample_seconds_ ? learning_of_much : learning) *
                     (each - sample_seconds_);
}

WalkEngine::Frame WalkEngine::advance(const Camera& camera, double frame_time, std::uint32_t terms,
                                      std::vector<Color>& picture) {
  const Clock::time_point start = Clock::now();
  const RenderStatistics before = tracer_.statistics();
  Frame frame;
  const bool moved = !last_ || changed_ || !same_view(*last_, camera);
  expect_view(camera);
  last_ = camera;
  shading_.expect_changes(changed_ || (changes_ && seconds_since_change_ < restless_seconds));
  if (moved) {
    resting_ = 0;
    samples_at_rest_ = next_map_ = 0;
    tracer_.set_view(camera, width_, height_);
    // Nothing is known before the first frame, little of what else moves, and guesses end with the
    // movement.
    const bool all = frame_ == 0 || changed_ || mode_.reuse == Reuse::nothing;
    if (!all && mode_.reuse == Reuse::image) {
      visibility_.see_projected(tracer_);
      shading_.see_projected(visibility_);
    } else {
      all ? visibility_.see_all(tracer_) : visibility_.see_next(tracer_);
      shading_.see(tracer_, visibility_);
    }
    pivot_ = tracer_.pivot(visibility_.now());
  } else {
    if (moved_) {
      visibility_.see_again(tracer_, others_);
      if (mode_.reuse == Reuse::image) shading_.clear(others_);
    }
    shading_.rest(visibility_.now());
    ++resting_;
  }
  moved_ = moved;
  changed_ = false;
  frame.seconds_view = seconds_since(start);
  const bool rests = resting_ >= frames_to_rest;
  if (rests) frame_time *= longer_at_rest;
  if (frame_ == 0) frame_time = std::max(frame_time, first_frame_seconds);
  if (mode_.reuse != Reuse::nothing) {
    gather_photons((rests ? share_of_photons_at_rest : share_of_photons) * frame_time);
    const double left = frame_time - seconds_since(start) - fixed_seconds_;
    const double least =
        frame_ == 0 ? share_of_records * first_frame_seconds : least_share_of_records * frame_time;
    double share = share_of_records;
    if (rests) {
      share = tracer_.photon_map().entries > 0 ? share_of_records_beside_photons
                                               : share_of_records_at_rest;
    }
    change_light([&] { improve(std::max(least, share * left)); });
    frame.seconds_records = seconds_since(start) - frame.seconds_view;
    trace_within(frame_time - seconds_since(start) - fixed_seconds_);
  } else {
    shading_.forget();
    gather_photons(share_of_photons * frame_time);
    change_light([&] { improve(share_of_records * frame_time); });
    frame.seconds_records = seconds_since(start) - frame.seconds_view;
    trace_all();
  }
  const Clock::time_point traced = Clock::now();
  frame.seconds_samples = seconds_since(start) - frame.seconds_view - frame.seconds_records;
  shading_.resolve(terms, visibility_.now(), picture);
  const double after = seconds_since(traced);
  fixed_seconds_ += learning * (after - fixed_seconds_);
  frame.seconds = seconds_since(start);
  seconds_since_change_ += frame.seconds;
  samples_at_rest_ += traced_;
  ++frame_;

  frame.traced = traced_;
  frame.rays = moved ? visibility_.ray_count() : 0;
  frame.holes = shading_.hole_count();
  frame.mean_age = shading_.mean_age();
  frame.cache_hits = tracer_.statistics().cache_hits - before.cache_hits;
  frame.cache_misses = tracer_.statistics().cache_misses - before.cache_misses;
  return frame;
}

void WalkEngine::resize(int width, int height) {
  width_ = width;
  height_ = height;
  if (last_) tracer_.set_view(*last_, width, height);  // what the next view is compared with
  visibility_ = Visibility(width, height);
  shading_ = ShadingCache(width, height);
  last_.reset();
  frame_ = 0;
}

void WalkEngine::update(const SceneChanges& changes) {
  if (changes.empty()) return;
  tracer_.update(changes);
  shading_.doubt(most_outdated_samples);
  changed_ = changes_ = true;
  seconds_since_change_ = 0.0;
}

WalkEngine::Caches WalkEngine::caches() const {
  const std::size_t pixels = std::size_t(shading_.width()) * std::size_t(shading_.height());
  return {tracer_.record_cache(),
          tracer_.photon_map(),
          {pixels - shading_.hole_count(), shading_.bytes()}};
}

V3d WalkEngine::pivot() const {
  return pivot_;
}

}  // namespace lumivec
