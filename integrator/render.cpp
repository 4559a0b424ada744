#include "integrator/render.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "integrator/cache_builder.h"
#include "integrator/error_estimate.h"
#include "integrator/film.h"
#include "integrator/light_tracer.h"
#include "integrator/paper_builder.h"
#include "integrator/parallel.h"
#include "integrator/partition.h"
#include "integrator/path_tracer.h"
#include "integrator/relative_error.h"
#include "integrator/sampling.h"
#include "integrator/seconds_since.h"

namespace lumivec {
namespace {

constexpr std::uint32_t default_samples = 64;
// Passes grow up to this, so that a stop or a time limit is never far away.
constexpr std::uint32_t max_pass_samples = 16;
// The first two halves that are compared to estimate the error.
constexpr std::uint32_t first_checkpoint = 8;
// The estimate is off by about a tenth either way: a target is only reached with that to spare.
constexpr double estimate_margin = 0.9;
// Light paths are traced in batches of this many; batches are added up in order, so that threads do
// not show.
constexpr std::uint32_t light_batch = 4096;
constexpr std::uint32_t batches_at_once = 64;
// Light paths of a photon map: so many for each sample that is made with it, within bounds.
constexpr std::uint64_t map_paths_per_sample = 1;
constexpr std::uint64_t least_map_paths = 1 << 16, most_map_paths = 1 << 21;
// Samples a pixel that share a map.
constexpr std::uint32_t most_map_samples = 4;
// With cached light, pixels all have so many samples before any has more.
constexpr std::uint32_t even_samples = 4;
// The share of the whole error that is left to the cache.
constexpr double cache_share = 0.5;
// Limited by time, the cache starts with this error, and gets better by this factor again and
// again.
constexpr double first_timed_error = 0.02;
constexpr double timed_error_step = 0.7;
// Pixels between those that show what a better cache changes.
constexpr int probe_stride = 4;
constexpr double progress_interval = 0.1;  // seconds

// One render from the first pass to the last.
class StillRender {
 public:
  // builder, paper_builder: at most one of them; both null: no cache is used. direct_builder:
  // beside builder, or null.
  StillRender(const TracedScene& scene, const PathTracer& tracer, const LightTracer& light_tracer,
              CacheBuilder* builder, CacheBuilder* direct_builder, PaperBuilder* paper_builder,
              const RenderSettings& settings, RenderStatistics& statistics,
              const ProgressCallback& progress)
      : tracer_(tracer),
        light_tracer_(light_tracer),
        builder_(builder),
        direct_builder_(direct_builder),
        paper_builder_(paper_builder),
        settings_(settings),
        statistics_(statistics),
        progress_(progress),
        film_(settings),
        photons_(scene),
        record_photons_(scene) {
    target_ = settings.samples > 0 ? static_cast<std::uint32_t>(settings.samples)
                                   : (settings.seconds > 0.0 || settings.error > 0.0
                                          ? std::uint32_t{max_picture_samples}
                                          : default_samples);
  }

  void run() {
    start_ = Clock::now();
    std::uint32_t done = 0;
    if (cached()) {
      run_cached();
      done = target_;
    }
    while (done < target_ && !stop_) {
      const std::uint32_t checkpoint = next_checkpoint(done);
      const std::uint32_t pass =
          std::min({std::max(done, 1u), max_pass_samples, target_ - done, checkpoint - done});
      render_pass(done, pass);
      if (stop_) break;
      if (light_tracer_.active()) render_light_pass(pass);
      if (stop_) break;
      done += pass;
      if (done == checkpoint) reach_checkpoint(done);
    }
    const double mean_samples =
        static_cast<double>(statistics_.samples) / static_cast<double>(film_.size());
    statistics_.error_estimate = cached() ? picture_error_ : estimate_.error_at(mean_samples);
    statistics_.seconds_sample = seconds_since(start_);
    statistics_.stopped_early = stopped_by_caller_;
  }

  const Film& film() const { return film_; }
  std::uint64_t photon_bytes() const { return photons_.bytes() + record_photons_.bytes(); }

 private:
  // The cache first, then the picture: everywhere alike to begin with, and after that where it is
  // most in error. Limited by time, the cache is made better as long as it has had less of it than
  // the picture.
  void run_cached() {
    const bool by_time = settings_.seconds > 0.0;
    double cache_error =
        settings_.error > 0.0 ? cache_share * settings_.error : settings_.cache_error;
    if (by_time) cache_error = std::max(cache_error, first_timed_error);
    map_photons(1);
    build_cache(cache_error);
    cache_error_ = cache_error;
    if (stop_ && !stopped_by_caller_)
      stop_ = false;  // out of time: one sample a pixel all the same
    std::uint32_t done = 0;
    const std::uint32_t even = std::min(target_, even_samples);
    while (done < target_ && !stop_) {
      if (by_time && done >= even && cache_should_improve()) {
        cache_error *= timed_error_step;
        const std::vector<Color> before = probe();
        build_cache(cache_error);
        // As if each further step changed as much less as this one was finer.
        cache_error_ = change_since(before) * timed_error_step / (1.0 - timed_error_step);
        if (stop_) break;
      }
      const std::uint32_t left = done < even ? even - done : target_ - done;
      const std::uint32_t most = light_tracer_.active() ? most_map_samples : max_pass_samples;
      const std::uint32_t pass =
          std::min({std::max(done < even ? done : done / 2, 1u), most, left});
      if (done > 0) map_photons(pass);
      if (done < even) {
        render_pass(done, pass);
      } else {
        render_pass_where_needed(pass);
      }
      done += pass;
      if (done <= 1) continue;
      picture_error_ = film_.relative_error();
      if (settings_.error > 0.0 && done >= even && picture_error_ >= 0.0 &&
          picture_error_ <= estimate_margin * settings_.error) {
        break;
      }
    }
  }

  bool cached() const { return builder_ || paper_builder_; }

  // In a render that is limited by time, whether the error of cached light shows beside the noise
  // of samples, and there is time to use what is made.
  bool cache_should_improve() const {
    if (!builder_ || cache_error_ <= picture_error_) return false;
    const double passed = seconds_since(start_);
    return statistics_.seconds_cache < 0.5 * passed &&
           statistics_.seconds_cache < settings_.seconds - passed;
  }

  // One sample of some of the pixels, by the same paths whenever it is asked for: only cached light
  // makes a difference.
  std::vector<Color> probe() const {
    std::vector<std::vector<Color>> of_tiles(std::size_t(film_.tile_count()));
    for_each(of_tiles.size(), [&](std::size_t t) {
      const Tile tile = film_.tile(int(t));
      std::vector<SampleRange> ranges;
      for (int y = 0; y < tile.height; y += probe_stride) {
        for (int x = 0; x < tile.width; x += probe_stride)
          ranges.push_back({static_cast<std::uint32_t>(y * tile.width + x), 0, 1,
                            static_cast<std::uint32_t>(ranges.size()), true});
      }
      std::vector<PixelSums> sums(ranges.size());
      RenderStatistics counts;  // not of the picture
      tracer_.render_ranges(tile, ranges, sums, counts, cache_use_);
      for (const PixelSums& s : sums) {
        Color light(0.0f);
        for (const Color& term : s.terms) light += term;
        of_tiles[t].push_back(light);
      }
    });
    std::vector<Color> all;
    for (const std::vector<Color>& some : of_tiles) all.insert(all.end(), some.begin(), some.end());
    return all;
  }

  // √relMSE of what probe() was against what it is.
  double change_since(const std::vector<Color>& before) const {
    const std::vector<Color> now = probe();
    double sum = 0.0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const double d = double(now[i][c]) - before[i][c];
        sum += relative_to(d * d, double(now[i][c]) * now[i][c]);
      }
    }
    return std::sqrt(sum / (3.0 * static_cast<double>(now.size())));
  }

  // Records for that relative error: their reach follows from it, and how many hemispheres each is
  // the mean of.
  void build_cache(double error) {
    const Clock::time_point begin = Clock::now();
    std::vector<Tile> tiles;
    for (int i = 0; i < film_.tile_count(); ++i) tiles.push_back(film_.tile(i));
    const auto go_on = [this] {
      const std::lock_guard lock(mutex_);
      note_progress(1);
      return !stop_;
    };
    if (paper_builder_) {
      paper_builder_->set_photons(photons());
      paper_builder_->build(go_on, statistics_);
      cache_use_ = paper_builder_->use();
    } else {
      if (direct_builder_) build_direct_cache(tiles, error, go_on);
      builder_->set_error(error);
      builder_->set_photons(photons_for_records(error));
      builder_->set_direct(direct_builder_ ? direct_builder_->use().direct : nullptr);
      builder_->build(tiles, go_on, statistics_);
      builder_->set_photons(photons());
      cache_use_ = builder_->use();
    }
    statistics_.seconds_cache += seconds_since(begin);
  }

  // If it pays.
  void build_direct_cache(const std::vector<Tile>& tiles, double error,
                          const std::function<bool()>& go_on) {
    direct_builder_->set_error(error);
    if (!direct_tried_ && !direct_builder_->try_out(tiles, go_on, statistics_)) {
      direct_builder_ = nullptr;
      return;
    }
    direct_tried_ = true;
    direct_builder_->build(tiles, go_on, statistics_);
  }

  // As many samples as an even pass would take, where they reduce relMSE most: a pixel should have
  // samples in proportion to its relative spread.
  void render_pass_where_needed(std::uint32_t count) {
    const std::vector<float> spread = film_.spread();
    double sum = 0.0, taken = 0.0;
    for (std::size_t i = 0; i < spread.size(); ++i) {
      sum += double(spread[i]);
      taken += film_.pixel(i).samples;
    }
    if (!(sum > 0.0)) return render_pass(film_.pixel(0).samples, count);
    // The larger the level, the larger the pass: halved in until the pass has its size.
    std::vector<std::uint32_t> extra(spread.size());
    const double wanted = double(count) * static_cast<double>(film_.size());
    double low = 0.0, high = 16.0 * (taken + wanted) / sum, level = high;
    constexpr int halvings = 24;
    for (int i = 0; i < halvings; ++i) {
      level = 0.5 * (low + high);
      double planned = 0.0;
      for (std::size_t j = 0; j < spread.size(); ++j) {
        planned += more_samples(film_.pixel(j).samples, level * double(spread[j]));
      }
      (planned < wanted ? low : high) = level;
    }
    double carry = 0.0;
    for (std::size_t i = 0; i < spread.size(); ++i) {
      carry += more_samples(film_.pixel(i).samples, level * double(spread[i]));
      extra[i] = static_cast<std::uint32_t>(std::max(0.0, carry));
      carry -= extra[i];
    }
    for_each_tile(
        [&](const Tile& tile, std::vector<PixelSums>& sums, RenderStatistics& counts) {
          std::vector<SampleRange> ranges;
          for (int y = 0; y < tile.height; ++y) {
            for (int x = 0; x < tile.width; ++x) {
              const std::size_t i =
                  std::size_t(tile.y + y) * std::size_t(settings_.width) + std::size_t(tile.x + x);
              if (extra[i] == 0) continue;
              const auto pixel = static_cast<std::uint32_t>(y * tile.width + x);
              ranges.push_back({pixel, film_.pixel(i).samples, extra[i], pixel});
            }
          }
          if (!ranges.empty()) tracer_.render_ranges(tile, ranges, sums, counts, cache_use_);
        },
        false);
  }

  // A pixel's samples at most grow so many times over in a pass: its spread is an estimate.
  // Photons are the same for all samples of a pass: each pixel has one with every map.
  double more_samples(std::uint32_t has, double should_have) const {
    constexpr double most_growth = 4.0;
    const double least = light_tracer_.active() ? 1.0 : 0.0;
    return std::clamp(should_have - has, least, std::max(least, (most_growth - 1.0) * has));
  }

  // Powers of two, where halves can be compared.
  static std::uint32_t next_checkpoint(std::uint32_t done) {
    std::uint32_t checkpoint = first_checkpoint / 2;
    while (checkpoint <= done) checkpoint *= 2;
    return checkpoint;
  }

  void reach_checkpoint(std::uint32_t done) {
    if (estimate_.samples() > 0 && done == 2 * estimate_.samples()) {
      const double error = estimate_.compare(film_);
      if (settings_.error > 0.0) {
        const double ratio = error / (estimate_margin * settings_.error);
        const double needed = done * ratio * ratio;
        // Up to the next checkpoint the estimate can be trusted to say how many samples are
        // missing.
        if (needed < 2.0 * done)
          target_ =
              std::min(target_, std::max(done, static_cast<std::uint32_t>(std::ceil(needed))));
      }
    }
    estimate_.remember(film_, done);
  }

  void render_pass(std::uint32_t first_sample, std::uint32_t count) {
    for_each_tile(
        [&](const Tile& tile, std::vector<PixelSums>& sums, RenderStatistics& counts) {
          tracer_.render_tile(tile, first_sample, count, sums, counts, cache_use_);
        },
        first_sample == 0);
  }

  template <typename Sample>
  void for_each_tile(const Sample& sample, bool first_pass) {
    for_each(std::size_t(film_.tile_count()), [&](std::size_t i) {
      if (stop_) return;
      const Tile tile = film_.tile(int(i));
      std::vector<PixelSums> sums(std::size_t(tile.width) * std::size_t(tile.height));
      RenderStatistics counts;
      sample(tile, sums, counts);
      film_.add(tile, sums, first_pass);
      const std::lock_guard lock(mutex_);
      statistics_.add_counts(counts);
      note_progress(first_pass ? 0 : 1);
    });
  }

  // As many light paths as the pass had eye paths, for the picture. A pass that is stopped leaves
  // out the batches it did not begin.
  void render_light_pass(std::uint32_t count) {
    const std::uint64_t end = film_.light_paths() + std::uint64_t(count) * film_.size();
    while (film_.light_paths() < end && !stop_) {
      const std::uint64_t begin = film_.light_paths();
      const std::uint64_t paths =
          std::min(end - begin, std::uint64_t{light_batch} * batches_at_once);
      trace_light_batches<Splat>(begin, paths, [&](const std::vector<Splat>& splats) {
        for (const Splat& splat : splats) film_.add(splat);
      });
      film_.add_light_paths(paths);
    }
  }

  // Light paths for a pass of so many samples a pixel, for the caches.
  void map_photons(std::uint32_t samples) {
    if (!light_tracer_.active()) return;
    const std::uint64_t paths =
        std::clamp(map_paths_per_sample * samples * film_.size(), least_map_paths, most_map_paths);
    map_photons(photons_, paths, map_number_++, PhotonMap::usual_gather_stride);
  }

  // Light paths for records of that relative error. All records see the same: what these are off
  // does not average out between them, as it does between passes.
  const PhotonMap* photons_for_records(double error) {
    const double finer = (0.01 / error) * (0.01 / error);
    if (finer <= 1.0 || !light_tracer_.active()) return photons();
    const double paths = finer * static_cast<double>(std::max(least_map_paths, film_.size()));
    const double stride = std::max(1.0, double(PhotonMap::usual_gather_stride) / finer);
    map_photons(record_photons_,
                static_cast<std::uint64_t>(std::min(paths, double(most_map_paths))), 0,
                static_cast<std::uint32_t>(stride));
    return &record_photons_;
  }

  void map_photons(PhotonMap& map, std::uint64_t wanted, std::uint32_t number,
                   std::uint32_t gather_stride) {
    std::vector<Photon> photons;
    std::uint64_t traced = 0;
    // A map that would take too much memory is made of fewer paths.
    const std::uint64_t most_photons = settings_.cache_bytes / (4 * sizeof(Photon));
    while (traced < wanted && photons.size() <= most_photons && !stop_) {
      const std::uint64_t paths =
          std::min(wanted - traced, std::uint64_t{light_batch} * batches_at_once);
      trace_light_batches<Photon>(map_paths_ + traced, paths, [&](const std::vector<Photon>& some) {
        photons.insert(photons.end(), some.begin(), some.end());
      });
      traced += paths;
    }
    map_paths_ += traced;
    statistics_.photons += photons.size();
    map.build(std::move(photons), traced, number, 1.0f, gather_stride);
  }
  const PhotonMap* photons() const { return light_tracer_.active() ? &photons_ : nullptr; }

  // Light paths [begin, begin + count), at most batches_at_once batches. take: is called with what
  // each batch brings, in order.
  template <typename Item, typename Take>
  void trace_light_batches(std::uint64_t begin, std::uint64_t count, const Take& take) {
    const auto batches = static_cast<std::uint32_t>((count + light_batch - 1) / light_batch);
    std::vector<std::vector<Item>> items(batches);
    for_each(batches, [&](std::size_t i) {
      const std::uint64_t first = begin + std::uint64_t{i} * light_batch;
      const auto size =
          static_cast<std::uint32_t>(std::min(std::uint64_t{light_batch}, begin + count - first));
      RenderStatistics counts;
      light_tracer_.trace(first, size, items[i], counts);
      const std::lock_guard lock(mutex_);
      statistics_.add_counts(counts);
    });
    for (const std::vector<Item>& batch : items) take(batch);
    const std::lock_guard lock(mutex_);
    note_progress(1);
  }

  // Called with the mutex held.
  void note_progress(std::uint32_t first_sample) {
    const double seconds = seconds_since(start_);
    if (settings_.seconds > 0.0 && seconds >= settings_.seconds && first_sample > 0) stop_ = true;
    if (!progress_ || seconds - last_progress_ < progress_interval) return;
    last_progress_ = seconds;
    RenderProgress p;
    p.seconds = seconds;
    p.samples = static_cast<double>(statistics_.samples) / static_cast<double>(film_.size());
    p.error = estimate_.error_at(p.samples);
    p.fraction = p.samples / static_cast<double>(target_);
    if (settings_.seconds > 0.0) p.fraction = std::max(p.fraction, seconds / settings_.seconds);
    if (settings_.error > 0.0 && p.error > 0.0) {
      const double ratio = settings_.error / p.error;
      p.fraction = std::max(p.fraction, ratio * ratio);
    }
    p.fraction = std::min(p.fraction, 1.0);
    p.seconds_left = p.fraction > 0.0 ? seconds * (1.0 - p.fraction) / p.fraction : 0.0;
    if (!progress_(p)) {
      stop_ = true;
      stopped_by_caller_ = true;
    }
  }

  const PathTracer& tracer_;
  const LightTracer& light_tracer_;
  CacheBuilder* const builder_;
  CacheBuilder* direct_builder_;
  bool direct_tried_ = false;
  PaperBuilder* const paper_builder_;
  CacheUse cache_use_;
  double picture_error_ = -1.0;
  double cache_error_ = 0.0;  // of cached light, as nominal or, later, as measured
  const RenderSettings& settings_;
  RenderStatistics& statistics_;
  const ProgressCallback& progress_;
  Film film_;
  PhotonMap photons_,
      record_photons_;           // what pixels see, and what records do if that is too coarse
  std::uint64_t map_paths_ = 0;  // light paths of all maps so far
  std::uint32_t map_number_ = 0;
  ErrorEstimate estimate_;
  std::uint32_t target_ = 0;
  Clock::time_point start_;
  double last_progress_ = 0.0;
  std::atomic<bool> stop_{false};
  bool stopped_by_caller_ = false;
  std::mutex mutex_;
};

}  // namespace

Framebuffer render(const Scene& scene, const Camera& camera, const RenderSettings& settings,
                   RenderStatistics& statistics, const ProgressCallback& progress) {
  check(settings);
  statistics = RenderStatistics();
  const int threads =
      settings.threads > 0 ? settings.threads : tbb::this_task_arena::max_concurrency();
  tbb::task_arena arena(threads);
  Framebuffer result;
  arena.execute([&] {
    const Clock::time_point start = Clock::now();
    const TracedScene traced(scene, threads);
    Lights lights(traced);
    const CameraView view(camera, traced, settings.width, settings.height);
    const std::vector<BoundingSphere> casters =
        caustic_casters(traced, settings.specular_roughness);
    const bool photons = settings.integrator == Integrator::light_vectors;
    if (!casters.empty()) lights.leave_caustics_to_light_paths(photons);
    const LightTracer light_tracer(traced, lights, view, settings, casters);
    const PathTracer tracer(traced, lights, view, settings);
    statistics.seconds_prepare = seconds_since(start);
    const bool direct = settings.validity_parts.direct_cache && !lights.environment().black() &&
                        (settings.terms & (term_bit(Term::direct) | term_bit(Term::indirect))) != 0;
    const std::uint64_t cache_bytes = settings.cache_bytes / (direct ? 2 : 1);
    IrradianceCache cache(traced, settings.validity_parts, cache_bytes);
    IrradianceCache direct_cache(traced, settings.validity_parts, cache_bytes);
    std::optional<CacheBuilder> builder, direct_builder;
    PaperCache paper_cache(settings.paper, settings.cache_bytes);
    std::optional<PaperBuilder> paper_builder;
    if (settings.integrator == Integrator::light_vectors) {
      if (settings.validity == Validity::paper) {
        paper_builder.emplace(tracer, traced, settings, paper_cache);
      } else {
        builder.emplace(tracer, traced, settings, cache);
        if (direct) direct_builder.emplace(tracer, traced, settings, direct_cache, Term::direct);
      }
    }
    StillRender still(traced, tracer, light_tracer, builder ? &*builder : nullptr,
                      direct_builder ? &*direct_builder : nullptr,
                      paper_builder ? &*paper_builder : nullptr, settings, statistics, progress);
    still.run();
    statistics.records = cache.size() + direct_cache.size() + paper_cache.size();
    statistics.cache_bytes =
        cache.bytes() + direct_cache.bytes() + paper_cache.bytes() + still.photon_bytes();
    result = still.film().resolve(traced.origin());
  });
  return result;
}

}  // namespace lumivec
