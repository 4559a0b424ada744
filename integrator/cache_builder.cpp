#include "integrator/cache_builder.h"

#include <ImathBoxAlgo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "integrator/bsdf_color.h"
#include "integrator/parallel.h"
#include "integrator/sampling.h"
#include "integrator/sobol.h"

namespace lumivec {
namespace {

constexpr int first_stride = 32;  // pixels
// The area that a record's budget is stated for (irradiance_cache.h): a disc with this share of the
// scene's radius.
constexpr float budget_radius = 0.1f;
// Paths of a record at an error of 1%; their number grows as the inverse square of the error. They
// go through as many cells as are needed, or through the finest again and again.
constexpr double paths_at_one_percent = 1536.0;
constexpr std::array<HemisphereCells, 3> fineness = {{{8, 24}, {12, 32}, {16, 48}}};
// The first hemisphere says how far a record reaches, and is forgotten: what whole paths brought is
// noisy, and what ended in records of such paths is too.
constexpr HemisphereCells first_cells = fineness[0];
constexpr std::uint32_t most_passes = 4096;
// Records whose own noise is still above so many times the error take up to so many times more.
constexpr double most_noise = 4.0;
constexpr std::uint32_t noisy_growth = 16;
// Records darker than this share of their mean are judged as if they had it.
constexpr float dark_share = 0.02f;
// Those that have met no light at all after so many times their hemispheres are dark.
constexpr std::uint32_t dark_growth = 4;
// A place wants a record of its own unless those around it have this weight together.
constexpr float wanted_weight = 0.4f;
// Pixels make do with less: what lies between places that were asked for.
constexpr float needed_weight = 0.05f;
// Places with less than this are gaps that the bounds on neighbours' reach have opened.
constexpr float gap_weight = 0.15f;
// What gathering paths see of a record may be blurred over this angle, radians: an eighth of that
// between neighbouring paths, √(2π / cells).
constexpr float gather_spread = 0.0125f;
// Below so many records paths are traced to their own ends: the cache has seen too little.
constexpr std::uint32_t fewest_to_end_in = 512;
// Records that a change has outdated and that are made anew before others are added.
constexpr std::size_t renewed_first = 32;
// Records that are made at a time when time is short.
constexpr std::size_t hurried_batch_size = 8;

// The first records, of one hemisphere each, must have errors below this share of their mean
// brightness, but for so many.
constexpr double most_trial_noise = 0.1;
constexpr double most_noisy_share = 0.25;

// Light stays where it was; the record is to be made anew.
void move(const Imath::M44f& motion, IrradianceRecord& record, RecordRequest& place) {
  const auto turned = [&](const V3f& v) {
    V3f to;
    motion.multDirMatrix(v, to);
    return to.normalized();
  };
  place.point.position = record.position = record.position * motion;
  place.point.normal = turned(place.point.normal);
  place.point.geometric_normal = turned(place.point.geometric_normal);
  record.normal = turned(record.normal);
  record.axis = turned(record.axis);
}

float brightness(const IrradianceRecord& r) {
  return mean(r.light.irradiance(r.normal));
}

}  // namespace

CacheBuilder::CacheBuilder(const PathTracer& tracer, const TracedScene& scene,
                           const RenderSettings& settings, IrradianceCache& cache, Term term)
    : tracer_(tracer), settings_(settings), cache_(cache), scene_(scene), term_(term) {
  set_error(settings.cache_error);
}

void CacheBuilder::set_error(double error) {
  const float radius = budget_radius * scene_.radius();
  budget_ = static_cast<float>(error) * pi * radius * radius;
  const double paths = paths_at_one_percent * (0.01 / error) * (0.01 / error);
  HemisphereCells cells = fineness.back();
  for (std::size_t i = fineness.size(); i-- > 0;) {
    if (fineness[i].count() >= paths) cells = fineness[i];
  }
  // Hemispheres of other cells are not averaged with these; finer ones are good enough as they are.
  if (cells.count() > cells_.count()) {
    for (std::uint32_t i = 0; i < cache_.size(); ++i) cache_.edit(i).passes = 0;
  }
  cells_ = cells;
  const double passes = std::ceil(paths / cells_.count());
  passes_ = static_cast<std::uint32_t>(std::clamp(passes, 1.0, double(most_passes)));
  most_variance_ = static_cast<float>(most_noise * most_noise * error * error);
  cache_.set_error(error);
  gather_.emplace(tracer_, scene_, settings_.validity_parts, budget_, term_);
}

CacheUse CacheBuilder::path_ends() const {
  CacheUse ends = use();
  ends.budget *= slack_;
  if (cache_.size() < fewest_to_end_in) ends.indirect = nullptr;
  ends.spread = gather_spread;
  return ends;
}

CacheUse CacheBuilder::use() const {
  CacheUse use;
  if (term_ == Term::direct) {
    use.direct = &cache_;
  } else {
    use.indirect = &cache_;
    use.direct = direct_;
  }
  use.photons = photons_;
  use.budget = budget_;
  use.needed_weight = needed_weight;
  return use;
}

// round: of what the record goes through, so that none repeats another's random numbers.
std::uint32_t CacheBuilder::record_seed(std::uint32_t record, std::uint32_t round) const {
  constexpr std::uint32_t record_stream = 0x7ec02du;  // apart from the pixels' random numbers
  const std::uint32_t seed = hash_combine(static_cast<std::uint32_t>(settings_.seed),
                                          static_cast<std::uint32_t>(settings_.seed >> 32));
  return hash_combine(hash_combine(hash_combine(seed, record_stream), record), round);
}

std::vector<RecordRequest> CacheBuilder::collect(const PathTracer& eye,
                                                 const std::vector<Tile>& tiles, int stride,
                                                 int phase, float weight,
                                                 RenderStatistics& statistics) const {
  std::vector<std::vector<RecordRequest>> found(tiles.size());
  std::mutex mutex;
  for_each(tiles.size(), [&](std::size_t i) {
    CacheUse asking = use();
    asking.budget *= slack_;
    asking.needed_weight = weight;
    asking.requests = &found[i];
    asking.requested = term_;
    const Tile& tile = tiles[i];
    std::vector<SampleRange> pixels;
    // The first place at or after the tile's edge.
    const auto first = [&](int edge, int place) {
      return (place - edge % stride + stride) % stride;
    };
    for (int y = first(tile.y, phase / stride); y < tile.height; y += stride) {
      for (int x = first(tile.x, phase % stride); x < tile.width; x += stride)
        pixels.push_back({static_cast<std::uint32_t>(y * tile.width + x), 0, 1, 0});
    }
    if (pixels.empty()) return;
    std::vector<PixelSums> sums(1);  // of no use
    RenderStatistics counts;
    eye.render_ranges(tile, pixels, sums, counts, asking);
    counts.samples = counts.cache_hits = counts.cache_misses = 0;  // none was for the picture
    const std::lock_guard lock(mutex);
    statistics.add_counts(counts);
  });
  std::vector<RecordRequest> all;
  for (const std::vector<RecordRequest>& some : found) {
    all.insert(all.end(), some.begin(), some.end());
  }
  // In no order of place, so that those of a batch are far from each other.
  std::vector<std::uint32_t> order(all.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ha = mix_bits(a), hb = mix_bits(b);
    return ha != hb ? ha < hb : a < b;
  });
  std::vector<RecordRequest> shuffled;
  shuffled.reserve(all.size());
  for (const std::uint32_t i : order) shuffled.push_back(all[i]);
  return shuffled;
}

bool CacheBuilder::make_records(std::vector<RecordRequest>& requests, float weight,
                                const std::function<bool()>& go_on, RenderStatistics& statistics) {
  std::size_t next = 0;
  std::mutex mutex;
  while (next < requests.size()) {
    if (!go_on()) return false;
    // The next that are still wanted.
    std::vector<std::size_t> batch;
    while (next < requests.size() && batch.size() < batch_size_) {
      const std::size_t group = std::min(batch_size_, requests.size() - next);
      std::vector<std::uint8_t> wanted(group);
      for_each(group, [&](std::size_t i) {
        CachedLight light;
        std::uint64_t visibility_rays = 0;
        wanted[i] = !cache_.look_up(requests[next + i].point, budget_ * slack_, weight, light,
                                    visibility_rays);
      });
      std::size_t used = 0;
      for (; used < group && batch.size() < batch_size_; ++used) {
        if (wanted[used]) batch.push_back(next + used);
      }
      next += used;
    }
    std::vector<IrradianceRecord> records(batch.size());
    for_each(batch.size(), [&](std::size_t i) {
      RenderStatistics counts;
      const auto number = static_cast<std::uint32_t>(places_.size() + i);
      records[i] = gather_->make(requests[batch[i]], first_cells, record_seed(number, 0), counts,
                                 path_ends());
      const float footprint = requests[batch[i]].point.footprint;
      records[i].least_reach = IrradianceCache::least_reach(footprint, budget_);
      records[i].passes = 0;
      const std::lock_guard lock(mutex);
      statistics.add_counts(counts);
    });
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (!cache_.insert(records[i])) return true;  // full: pixels trace what they do not find
      places_.push_back(requests[batch[i]]);
    }
  }
  return true;
}

bool CacheBuilder::fill(const std::vector<Tile>& tiles, int stride, int last_stride, float weight,
                        const std::function<bool()>& go_on, RenderStatistics& statistics) {
  for (; stride >= last_stride; stride /= 2) {
    cache_.commit(budget_);
    std::vector<RecordRequest> requests =
        collect(tracer_, tiles, stride, stride / 2 * (stride + 1), weight, statistics);
    if (!make_records(requests, weight, go_on, statistics)) return false;
  }
  return true;
}

bool CacheBuilder::build(const std::vector<Tile>& tiles, const std::function<bool()>& go_on,
                         RenderStatistics& statistics) {
  return fill(tiles, first_stride, 1, wanted_weight, go_on, statistics) &&
         refine(go_on, statistics) && fill(tiles, 1, 1, gap_weight, go_on, statistics) &&
         refine(go_on, statistics);
}

bool CacheBuilder::extend(const PathTracer& eye, const std::vector<Tile>& tiles, int stride,
                          int phase, float slack, const std::function<bool()>& go_on,
                          RenderStatistics& statistics) {
  batch_size_ = hurried_batch_size;
  slack_ = slack;
  renew(renewed_first, go_on, statistics);
  std::vector<RecordRequest> requests =
      collect(eye, tiles, stride, phase, wanted_weight, statistics);
  bool all = make_records(requests, wanted_weight, go_on, statistics);
  renew(outdated_.size(), go_on, statistics);
  all = all && outdated_.empty();
  slack_ = 1.0f;
  if (cache_.size() >= committed_ + committed_ / 8 + 1 || (all && cache_.size() != committed_)) {
    cache_.commit(budget_);
    committed_ = cache_.size();
  }
  return all;
}

void CacheBuilder::change(const std::vector<MovedPart>& parts) {
  std::vector<const MovedPart*> part_of;  // by instance
  for (const MovedPart& part : parts) {
    part_of.resize(std::max(part_of.size(), static_cast<std::size_t>(part.instance) + 1), nullptr);
    part_of[static_cast<std::size_t>(part.instance)] = &part;
  }
  std::vector<IrradianceRecord> kept;
  std::vector<RecordRequest> kept_places;
  bool moved = false;
  for (std::uint32_t i = 0; i < places_.size(); ++i) {
    const auto instance = static_cast<std::size_t>(places_[i].point.instance);
    const MovedPart* part = instance < part_of.size() ? part_of[instance] : nullptr;
    moved = moved || part;
    if (part && !part->motion) continue;
    kept.push_back(cache_.record(i));
    kept_places.push_back(places_[i]);
    if (part) move(*part->motion, kept.back(), kept_places.back());
  }
  if (moved) {
    cache_.clear();
    for (const IrradianceRecord& r : kept) cache_.insert(r);
    places_ = std::move(kept_places);
    cache_.rebuild();
    committed_ = cache_.size();
  }
  // Nearest to a part last, as they are taken from the end.
  std::vector<float> distance2(places_.size(), std::numeric_limits<float>::max());
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const V3f& p = places_[i].point.position;
    for (const MovedPart& part : parts) {
      for (const Imath::Box3f& box : part.bounds) {
        if (!box.isEmpty())
          distance2[i] = std::min(distance2[i], (Imath::clip(p, box) - p).length2());
      }
    }
  }
  outdated_.resize(places_.size());
  for (std::uint32_t i = 0; i < outdated_.size(); ++i) outdated_[i] = i;
  std::stable_sort(outdated_.begin(), outdated_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return distance2[a] > distance2[b]; });
  for (const std::uint32_t i : outdated_) cache_.edit(i).passes = 0;
}

void CacheBuilder::renew(std::size_t most, const std::function<bool()>& go_on,
                         RenderStatistics& statistics) {
  if (outdated_.empty()) return;
  std::vector<IrradianceRecord> made(batch_size_);
  std::mutex mutex;
  for (std::size_t done = 0; done < most && !outdated_.empty() && go_on();) {
    const std::size_t count = std::min(batch_size_, outdated_.size());
    for_each(count, [&](std::size_t k) {
      const std::uint32_t i = outdated_[outdated_.size() - 1 - k];
      RenderStatistics counts;
      // The same random numbers as before: what has not changed does not flicker.
      made[k] = gather_->make(places_[i], first_cells, record_seed(i, 0), counts, path_ends());
      made[k].least_reach = cache_.record(i).least_reach;
      made[k].passes = 0;
      const std::lock_guard lock(mutex);
      statistics.add_counts(counts);
    });
    for (std::size_t k = 0; k < count; ++k) {
      cache_.edit(outdated_.back()) = made[k];
      outdated_.pop_back();
    }
    done += count;
  }
  cache_.rebuild();
}

bool CacheBuilder::try_out(const std::vector<Tile>& tiles, const std::function<bool()>& go_on,
                           RenderStatistics& statistics) {
  if (!fill(tiles, first_stride, first_stride / 2, wanted_weight, go_on, statistics)) return false;
  double usual = 0.0;
  for (std::uint32_t i = 0; i < cache_.size(); ++i)
    usual += double(brightness(cache_.record(i))) / cache_.size();
  std::uint32_t noisy = 0;
  for (std::uint32_t i = 0; i < cache_.size(); ++i) {
    const IrradianceRecord& r = cache_.record(i);
    const double error = std::sqrt(double(r.variance)) * double(brightness(r));
    if (error > most_trial_noise * usual) ++noisy;
  }
  return usual > 0.0 && noisy <= most_noisy_share * cache_.size();
}

bool CacheBuilder::refine(const std::function<bool()>& go_on, RenderStatistics& statistics) {
  std::vector<IrradianceRecord> refined(batch_size_);
  std::mutex mutex;
  while (true) {
    std::vector<std::uint32_t> wanting;
    float usual = 0.0f;
    for (std::uint32_t i = 0; i < places_.size(); ++i) usual += brightness(cache_.record(i));
    usual /= std::max(1.0f, static_cast<float>(places_.size()));
    for (std::uint32_t i = 0; i < places_.size(); ++i) {
      const IrradianceRecord& r = cache_.record(i);
      const bool dark = r.light.flux == Color(0.0f);
      const float share = dark ? 1.0f : std::min(1.0f, brightness(r) / (dark_share * usual));
      const bool noisy = r.variance * share * share > most_variance_ &&
                         r.passes < (dark ? dark_growth : noisy_growth) * passes_;
      if (r.passes < passes_ || noisy) wanting.push_back(i);
    }
    if (wanting.empty()) break;
    // Paths end in records that are replaced when the group's are done: what a group brings does
    // not depend on the order in which it is made.
    cache_.commit(budget_);
    const CacheUse ends = path_ends();
    for (std::size_t first = 0; first < wanting.size(); first += batch_size_) {
      if (!go_on()) {
        cache_.rebuild();
        return false;
      }
      const std::size_t count = std::min(batch_size_, wanting.size() - first);
      for_each(count, [&](std::size_t i) {
        const std::uint32_t index = wanting[first + i];
        RenderStatistics counts;
        IrradianceRecord record = cache_.record(index);
        gather_->refine(record, places_[index], cells_, record_seed(index, 1), counts, ends);
        refined[i] = record;
        const std::lock_guard lock(mutex);
        statistics.add_counts(counts);
      });
      for (std::size_t i = 0; i < count; ++i) cache_.edit(wanting[first + i]) = refined[i];
    }
  }
  cache_.rebuild();
  return true;
}

}  // namespace lumivec
