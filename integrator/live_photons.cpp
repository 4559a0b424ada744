#include "integrator/live_photons.h"

#include <algorithm>
#include <chrono>

#include "integrator/parallel.h"
#include "integrator/seconds_since.h"

namespace lumivec {
namespace {

constexpr std::uint64_t map_paths = LivePhotons::paths_of_map_at_rest;
// Before the first picture, and while the scene changes.
constexpr std::uint64_t hurried_map_paths = map_paths / 8;
// The wide map is used whenever it has grown so many times over, up to a path for each pixel, as a
// still has, within bounds.
constexpr std::uint64_t map_growth = 2;
constexpr std::uint64_t most_map_paths = 1 << 19;
// Light paths that are traced before time is looked at again, and those of a thread.
constexpr std::uint64_t map_slice = 1024;
constexpr std::uint32_t map_batch = 256;

}  // namespace

LivePhotons::LivePhotons(const TracedScene& scene, std::uint64_t bytes)
    : most_photons_(bytes / sizeof(Photon)),
      wide_(std::make_unique<PhotonMap>(scene)),
      narrow_(std::make_unique<PhotonMap>(scene)),
      next_(std::make_unique<PhotonMap>(scene)) {}

void LivePhotons::trace(std::uint64_t paths, GrowingMap& map) const {
  std::vector<std::vector<Photon>> batches(paths / map_batch);
  for_each(batches.size(), [&](std::size_t i) {
    RenderStatistics counts;
    tracer_->trace(map.first + map.traced + i * map_batch, map_batch, batches[i], counts);
  });
  map.traced += paths;
  for (const std::vector<Photon>& some : batches)
    map.photons.insert(map.photons.end(), some.begin(), some.end());
}

void LivePhotons::build(PhotonMap& map, GrowingMap from, std::uint32_t number) const {
  // As many photons in a disc as those of a still, which has a path for each pixel.
  const auto pixels = static_cast<float>(pixels_), paths = static_cast<float>(from.traced);
  map.build(std::move(from.photons), from.traced, number, std::max(1.0f, pixels / paths));
}

void LivePhotons::restart(const LightTracer& tracer, std::size_t pixels, tbb::task_arena& arena,
                          RenderStatistics& statistics) {
  stop();
  tracer_ = &tracer;
  pixels_ = pixels;
  in_use_ = nullptr;
  if (!tracer.active()) return;
  arena.execute([&] { trace(hurried_map_paths, growing_wide_); });
  statistics.photons += growing_wide_.photons.size();
  used_paths_ = growing_wide_.traced;
  build(*wide_, growing_wide_, 0);
  in_use_ = wide_.get();
}

void LivePhotons::stop() {
  if (building_.valid()) building_.get();
  growing_wide_ = {};
  growing_narrow_.reset();
  narrow_maps_ = 0;
  used_paths_ = 0;
}

PhotonChange LivePhotons::take_what_is_built() {
  building_.get();
  std::unique_ptr<PhotonMap>& place = building_narrow_ ? narrow_ : wide_;
  std::swap(place, next_);
  in_use_ = place.get();
  return building_narrow_ ? PhotonChange::another : PhotonChange::better;
}

void LivePhotons::build_beside(GrowingMap from, std::uint32_t number,
                               RenderStatistics& statistics) {
  statistics.photons += from.photons.size();
  building_narrow_ = number > 0;
  building_ = std::async(std::launch::async, [this, from = std::move(from), number]() mutable {
    build(*next_, std::move(from), number);
  });
}

PhotonChange LivePhotons::gather(double seconds, PhotonDemand demand, tbb::task_arena& arena,
                                 RenderStatistics& statistics) {
  if (!in_use_) return PhotonChange::none;
  const Clock::time_point start = Clock::now();
  PhotonChange change = PhotonChange::none;
  if (building_.valid()) {
    // A view that rests has nothing better to do.
    const std::chrono::duration<double> patience(demand == PhotonDemand::another ? seconds : 0.0);
    if (building_.wait_for(patience) != std::future_status::ready) return change;
    change = take_what_is_built();
  }
  if (demand == PhotonDemand::grow && narrow_maps_ > 0) {
    narrow_maps_ = 0;
    growing_narrow_.reset();
    if (in_use_ != wide_.get()) change = PhotonChange::another;
    in_use_ = wide_.get();
  }
  const auto trace_up_to = [&](std::uint64_t paths, GrowingMap& map) {
    arena.execute([&] {
      while (map.traced < paths && seconds_since(start) < seconds) trace(map_slice, map);
    });
    return map.traced >= paths;
  };
  const std::uint64_t enough =
      demand == PhotonDemand::grow ? std::clamp(pixels_, map_paths, most_map_paths) : map_paths;
  if (used_paths_ < enough && growing_wide_.photons.size() < most_photons_) {
    const std::uint64_t wanted = std::min(map_growth * used_paths_, enough);
    if (!trace_up_to(wanted, growing_wide_)) return change;
    used_paths_ = growing_wide_.traced;
    build_beside(growing_wide_, 0, statistics);
    return change;
  }
  if (!growing_narrow_ && demand == PhotonDemand::another && change == PhotonChange::none) {
    growing_narrow_ = {most_map_paths + narrow_maps_ * map_paths, 0, {}};
    ++narrow_maps_;
  }
  if (!growing_narrow_ || !trace_up_to(map_paths, *growing_narrow_)) return change;
  // Discs shrink with the paths of all maps, as those of a still.
  const auto number =
      static_cast<std::uint32_t>(narrow_maps_ * map_paths / std::max(pixels_, map_paths));
  build_beside(std::move(*growing_narrow_), std::max(number, 1u), statistics);
  growing_narrow_.reset();
  return change;
}

std::size_t LivePhotons::size() const {
  return in_use_ ? in_use_->size() : 0;
}

std::size_t LivePhotons::bytes() const {
  return wide_->bytes() + narrow_->bytes() + growing_wide_.photons.capacity() * sizeof(Photon);
}

}  // namespace lumivec
