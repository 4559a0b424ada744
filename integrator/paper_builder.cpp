#include "integrator/paper_builder.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "integrator/paper_gather.h"
#include "integrator/parallel.h"
#include "integrator/sampling.h"
#include "integrator/sobol.h"

namespace lumivec {
namespace {

// Pixels that are asked at a time, which bounds the memory of what they ask for.
constexpr std::size_t pixel_group = 4096;
// Records that are made at a time, without knowing of each other.
constexpr std::size_t batch_size = 64;
// Photons may be blurred over this share of the angle between neighbouring paths.
constexpr float photon_spread = 0.125f;
// Apart from the random numbers of pixels and of other records.
constexpr std::uint32_t order_stream = 0x5eed2003u;
constexpr std::uint32_t record_stream = 0x9a9e2003u;

std::uint32_t seed_of(const RenderSettings& settings, std::uint32_t stream) {
  const std::uint32_t seed = hash_combine(static_cast<std::uint32_t>(settings.seed),
                                          static_cast<std::uint32_t>(settings.seed >> 32));
  return hash_combine(seed, stream);
}

std::vector<std::uint32_t> in_random_order(std::uint32_t count, std::uint32_t seed) {
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [seed](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t ha = hash_combine(seed, a), hb = hash_combine(seed, b);
    return ha != hb ? ha < hb : a < b;
  });
  return order;
}

}  // namespace

PaperBuilder::PaperBuilder(const PathTracer& tracer, const TracedScene& scene,
                           const RenderSettings& settings, PaperCache& cache)
    : tracer_(tracer), scene_(scene), settings_(settings), cache_(cache) {}

CacheUse PaperBuilder::use() const {
  CacheUse use;
  use.paper = &cache_;
  use.photons = photons_;
  return use;
}

Bsdf PaperBuilder::bsdf(const PaperPoint& point, const Color& base_color) const {
  SurfaceParameters surface = point.surface;
  surface.base_color = base_color;
  return Bsdf(surface, point.place.geometric_normal, point.view, scene_.albedo_tables(),
              settings_.specular_roughness);
}

bool PaperBuilder::finished() const {
  const int most = settings_.paper.max_records;
  return full_ || (most > 0 && cache_.size() >= static_cast<std::uint64_t>(most));
}

// Where the first samples of those pixels do not find enough in `known`.
std::vector<PaperPoint> PaperBuilder::collect(const std::vector<std::uint32_t>& pixels,
                                              std::size_t begin, std::size_t end,
                                              const PaperCache& known,
                                              RenderStatistics& statistics) const {
  std::vector<std::vector<PaperPoint>> found(end - begin);
  std::mutex mutex;
  for_each(end - begin, [&](std::size_t i) {
    const int pixel = static_cast<int>(pixels[begin + i]);
    const Tile tile{pixel % settings_.width, pixel / settings_.width, 1, 1};
    CacheUse asking;
    asking.paper = &known;
    asking.paper_requests = &found[i];
    std::vector<PixelSums> sums(1);
    RenderStatistics counts;
    tracer_.render_tile(tile, 0, 1, sums, counts, asking);
    counts.samples = counts.cache_hits = counts.cache_misses = 0;  // none was for the picture
    const std::lock_guard lock(mutex);
    statistics.add_counts(counts);
  });
  std::vector<PaperPoint> all;
  for (const std::vector<PaperPoint>& some : found) all.insert(all.end(), some.begin(), some.end());
  return all;
}

// all: also where there are enough.
bool PaperBuilder::make_records(const std::vector<PaperPoint>& points, bool all,
                                const std::function<bool()>& go_on, RenderStatistics& statistics) {
  std::mutex mutex;
  std::size_t next = 0;
  while (next < points.size() && !finished()) {
    if (!go_on()) return false;
    // The next that still find too few.
    std::vector<std::size_t> batch;
    while (next < points.size() && batch.size() < batch_size) {
      const PaperPoint& point = points[next];
      Color radiance(0.0f);
      const bool wanted =
          all || !cache_.look_up(point, bsdf(point, point.surface.base_color), radiance);
      if (wanted) batch.push_back(next);
      ++next;
    }
    std::vector<PaperRecord> records(batch.size());
    std::vector<std::uint8_t> lambertian(batch.size());
    const auto first = static_cast<std::uint32_t>(cache_.size());
    const std::uint32_t seed = seed_of(settings_, record_stream);
    CacheUse ends;
    ends.photons = photons_;
    ends.spread =
        std::sqrt(2.0f * pi / static_cast<float>(settings_.paper.samples)) * photon_spread;
    for_each(batch.size(), [&](std::size_t i) {
      const PaperPoint& point = points[batch[i]];
      const Bsdf scattering = bsdf(point, paper_base_color(point.surface.base_color));
      RenderStatistics counts;
      records[i] = make_paper_record(tracer_, scene_, point, scattering, settings_.paper.samples,
                                     hash_combine(seed, first + static_cast<std::uint32_t>(i)),
                                     counts, ends);
      lambertian[i] = scattering.lambertian();
      const std::lock_guard lock(mutex);
      statistics.add_counts(counts);
    });
    for (std::size_t i = 0; i < batch.size() && !finished(); ++i) {
      full_ = !cache_.insert(points[batch[i]], records[i], lambertian[i] != 0);
      if (!full_) ++statistics.light_vectors[static_cast<std::size_t>(records[i].light.form)];
    }
  }
  return true;
}

bool PaperBuilder::build(const std::function<bool()>& go_on, RenderStatistics& statistics) {
  const auto count =
      static_cast<std::uint32_t>(settings_.width) * static_cast<std::uint32_t>(settings_.height);
  const std::vector<std::uint32_t> pixels =
      in_random_order(count, seed_of(settings_, order_stream));
  const std::size_t seeds = std::min<std::size_t>(count, std::size_t(settings_.paper.seeds));
  const PaperCache nothing(settings_.paper, 0);
  for (std::size_t begin = 0, end = 0; begin < count && !finished(); begin = end) {
    const bool seed = begin < seeds;
    end = std::min<std::size_t>(begin + pixel_group, seed ? seeds : count);
    const std::vector<PaperPoint> points =
        collect(pixels, begin, end, seed ? nothing : cache_, statistics);
    if (!make_records(points, seed, go_on, statistics)) return false;
    cache_.balance();
  }
  return true;
}

}  // namespace lumivec
