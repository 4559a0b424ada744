#include "viewer/walk/shading_cache.h"

#include <OpenImageIO/simd.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "integrator/sobol.h"
#include "viewer/rows.h"
#include "viewer/walk/pull_push.h"
#include "viewer/walk/reprojection.h"

namespace lumivec {
namespace {

using OIIO::simd::vfloat4;
using OIIO::simd::vfloat8;

// What moves over the picture rests on so many samples at most, so that it follows changes of the
// light and is not blurred by being carried over again and again; what mirrors show moves with the
// eye, and is trusted less.
constexpr float most_samples = 16.0f;
constexpr float most_specular_samples = 2.0f;
// Where it is known how it moves, it is followed, if it is at least this share of the light.
constexpr float most_mirrored_samples = 8.0f;
constexpr float least_mirrored_share = 0.02f;
// What a mirror shows is the same in two views if their vergences are, but for this share.
constexpr float most_vergence_change = 0.25f;
// Of four pixels around a place, those of other surfaces are left out; less than this share of
// theirs is too little to go by.
constexpr float least_share = 0.05f;
// The share of its four pixels in the last view that must have shown a surface which is guessed.
constexpr float sure_share = 0.999f;
// Of a view that comes to rest, what was carried over counts like so many samples at most: a sample
// more then makes no pixel noisier than it was, and many leave little of it.
constexpr float most_carried_samples = 6.0f;
// The age that counts like one sample less.
constexpr float age_unit = 4.0f;
// Where the scene changes: a sample that differs by this share calls for more in its block, so many
// times as many; what is known there counts like so many samples at most. Urgency dies away.
constexpr float changed_share = 0.4f;
constexpr float most_urgent = 15.0f;
constexpr float most_outdated_samples = 0.5f;
constexpr float outdating_urgency = 0.9f;
constexpr float urgency_kept = 0.7f, urgency_spread = 0.5f, least_urgency = 0.02f;
// Noise is what a sample differs from the mean of those before it, relative to that; at most so
// much of it is believed of one sample, and it counts like the mean of so many at most. Where there
// is none, samples are worth this share of what they are on average.
constexpr float most_noise = 16.0f;
constexpr float most_noise_samples = 4.0f;
constexpr float least_noisiness = 0.15f;
// At rest, samples of pixels that edges go through are worth what their own noise says, which that
// of their blocks hides; at most so many times more of them than there is noise.
constexpr float most_noisiness_at_edges = 8.0f;
// Before any is known of it, their first samples are worth so many times the average, and so many
// are taken at once: a single one would be worse than what the pixel's middle shows.
constexpr float first_noisiness_at_edges = 16.0f;
constexpr float first_samples_at_edges = 4.0f;
// Samples that miss a light tell nothing of those that would meet it.
constexpr float least_noisiness_by_light = 64.0f;
// A light is so many times as bright as what it is seen against.
constexpr float least_glare = 8.0f;
// Of a pixel, in a frame of a view at rest.
constexpr float most_samples_at_once = 8.0f;
// Rows whose errors are diffused by themselves, so that several threads choose.
constexpr int band_height = 64;

constexpr auto emitted_term = static_cast<std::size_t>(Term::emitted);
constexpr auto specular_term = static_cast<std::size_t>(Term::specular);

// Whether light that comes straight from where it is made has changed by more than its noise
// usually is.
bool differs(const LiveSample& sample, const float* lanes) {
  float now = 0.0f, before = 0.0f;
  for (const Term term : {Term::emitted, Term::direct, Term::caustic}) {
    const auto t = static_cast<std::size_t>(term);
    for (std::size_t c = 0; c < 3; ++c) {
      now += sample.terms[t][static_cast<int>(c)];
      before += lanes[3 * t + c];
    }
  }
  return std::abs(now - before) > changed_share * std::max(now, before);
}

// How far samples are off the mean of `count` before them: what one would be, squared, of the true
// one.
float noise_of(const LiveSample& sample, const float* lanes, float count) {
  float now = 0.0f, before = 0.0f;
  for (std::size_t t = 0; t < term_count; ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      now += sample.terms[t][static_cast<int>(c)];
      before += lanes[3 * t + c];
    }
  }
  const float level = 0.5f * (now + before);
  if (!(level > 0.0f)) return 0.0f;
  const float off = (now - before) / level;
  const auto n = static_cast<float>(sample.count);
  return std::min(off * off * n * count / (count + n), most_noise);
}

}  // namespace

ShadingCache::Shades::Shades(std::size_t pixels)
    : shade(pixels),
      cached_samples(pixels, 0.0f),
      specular_samples(pixels, 0.0f),
      mirrored(pixels, shows_nothing),
      noise(pixels, 0.0f),
      age(pixels, 0) {}

void ShadingCache::Shades::clear(std::size_t pixel) {
  shade[pixel] = {};
  cached_samples[pixel] = 0.0f;
  specular_samples[pixel] = 0.0f;
  mirrored[pixel] = shows_nothing;
  noise[pixel] = 0.0f;
  age[pixel] = 0;
}

ShadingCache::ShadingCache(int width, int height)
    : width_(width),
      height_(height),
      shades_(std::size_t(width) * std::size_t(height)),
      last_shades_(shades_.shade.size()),
      numbers_(shades_.shade.size(), 0),
      rows_(std::size_t(height)),
      blocks_across_((std::size_t(width) + block_side - 1) / block_side),
      urgency_(blocks_across_ * ((std::size_t(height) + block_side - 1) / block_side), 0.0f),
      noisiness_(urgency_.size(), 1.0f) {}

void ShadingCache::see(LiveTracer& tracer, Visibility& visibility) {
  ++frame_;
  spread_urgency();
  std::swap(shades_, last_shades_);
  last_rested_ = rested_;
  rested_ = false;
  const Reprojection reprojection(tracer.view(0), visibility.now(), tracer.view(1),
                                  visibility.last(), width_, height_);
  constexpr auto lanes = static_cast<int>(Reprojection::lanes);
  std::vector<std::vector<std::uint32_t>> doubtful(static_cast<std::size_t>(height_));
  for_each_row(height_, [&](int y) {
    for (int left = 0; left < width_; left += lanes)
      carry_over(tracer, reprojection, left, y, visibility, doubtful[static_cast<std::size_t>(y)]);
  });
  std::vector<std::uint32_t> pixels;
  join_lists(doubtful, pixels);
  visibility.settle(tracer, pixels);
  for_each_row(height_, [&](int y) {
    std::vector<std::uint32_t> none;
    int done = -1;
    for (const std::uint32_t pixel : doubtful[static_cast<std::size_t>(y)]) {
      const int left = static_cast<int>(pixel - at(0, y)) / lanes * lanes;
      if (left != done) carry_over(tracer, reprojection, left, y, visibility, none);
      done = left;
    }
  });
  share_noise();
  for_each_row(height_, [&](int y) { grow_older(y); });
}

void ShadingCache::see_projected(const Visibility& visibility) {
  ++frame_;
  spread_urgency();
  std::swap(shades_, last_shades_);
  last_rested_ = rested_;
  rested_ = false;
  for_each_row(height_, [&](int y) {
    for (std::size_t i = at(0, y); i < at(0, y + 1); ++i) {
      const std::uint32_t source = visibility.source(i);
      if (source == Visibility::no_source || is_mixed(source)) {
        shades_.clear(i);
        continue;
      }
      Shade& shade = shades_.shade[i];
      shade = last_shades_.shade[source];
      float& samples = shade.lanes[Shade::samples_lane];
      samples = std::min(samples, most_samples);
      shades_.cached_samples[i] = std::min(last_shades_.cached_samples[source], most_samples);
      shades_.specular_samples[i] =
          std::min(last_shades_.specular_samples[source], most_specular_samples);
      shades_.mirrored[i] = last_shades_.mirrored[source];
      shades_.noise[i] = last_shades_.noise[source];
      shades_.age[i] = last_shades_.age[source];
    }
  });
  share_noise();
  for_each_row(height_, [&](int y) { grow_older(y); });
}

void ShadingCache::clear(const std::vector<std::uint32_t>& pixels) {
  for (const std::uint32_t i : pixels) shades_.clear(i);
}

void ShadingCache::rest(const VisibleSurfaces& seen) {
  ++frame_;
  if (!rested_) {
    find_edges(seen);
    for_each_row(height_, [&](int y) {
      for (std::size_t i = at(0, y); i < at(0, y + 1); ++i)
        doubt(i, edges_[i] != Edge::none ? most_carried_samples_at_edges : most_carried_samples);
    });
  }
  rested_ = true;
  spread_urgency();
  share_noise();
  for_each_row(height_, [&](int y) { grow_older(y); });
}

void ShadingCache::doubt(std::size_t pixel, float most) {
  for (float* samples : {&shades_.shade[pixel].lanes[Shade::samples_lane],
                         &shades_.cached_samples[pixel], &shades_.specular_samples[pixel]})
    *samples = std::min(*samples, most);
}

void ShadingCache::doubt(float most) {
  for_each_row(height_, [&](int y) {
    for (std::size_t i = at(0, y); i < at(0, y + 1); ++i) doubt(i, most);
  });
}

void ShadingCache::doubt_cached(float most) {
  for_each_row(height_, [&](int y) {
    for (std::size_t i = at(0, y); i < at(0, y + 1); ++i) {
      for (float* samples : {&shades_.cached_samples[i], &shades_.specular_samples[i]})
        *samples = std::min(*samples, most);
    }
  });
}

void ShadingCache::forget() {
  ++frame_;
  for_each_row(height_, [&](int y) {
    for (int x = 0; x < width_; ++x) shades_.clear(at(x, y));
    grow_older(y);
  });
}

// Each pixel from the four around the place where the last view saw its point.
void ShadingCache::carry_over(const LiveTracer& tracer, const Reprojection& reprojection, int left,
                              int y, const Visibility& visibility,
                              std::vector<std::uint32_t>& doubtful) {
  Reprojection::Taps taps;
  reprojection.find(left, y, taps);
  const std::size_t first = at(left, y);
  const std::size_t there = std::min(Reprojection::lanes, static_cast<std::size_t>(width_ - left));
  for (std::size_t i = 0; i < there; ++i) {
    const std::size_t pixel = first + i;
    if (taps.total[i] < sure_share && visibility.guessed(pixel)) {
      doubtful.push_back(static_cast<std::uint32_t>(pixel));
      continue;
    }
    vfloat8 low(0.0f), high(0.0f);
    float total = 0.0f, cached_samples = 0.0f, specular_samples = 0.0f, noise = 0.0f, age = 0.0f;
    float mirrored = 0.0f, mirrors = 0.0f, refractions = 0.0f;
    if (taps.total[i] > least_share) {
      for (std::size_t tap = 0; tap < 4; ++tap) {
        const auto index = static_cast<std::size_t>(taps.pixel[tap][i]);
        const Shade& from = last_shades_.shade[index];
        const float w = from.samples() > 0.0f && !is_mixed(index) ? taps.weight[tap][i] : 0.0f;
        total += w;
        low = madd(vfloat8(w), vfloat8(from.lanes.data()), low);
        high = madd(vfloat8(w), vfloat8(from.lanes.data() + Reprojection::lanes), high);
        cached_samples += w * last_shades_.cached_samples[index];
        specular_samples += w * last_shades_.specular_samples[index];
        noise += w * last_shades_.noise[index];
        if (last_shades_.mirrored[index] >= 0.0f) {
          mirrored += w * last_shades_.mirrored[index];
          mirrors += w;
        } else if (last_shades_.mirrored[index] == shows_by_refraction) {
          refractions += w;
        }
        age += w * static_cast<float>(last_shades_.age[index]);
      }
    }
    if (!(total > least_share)) {
      shades_.clear(pixel);
      continue;
    }
    const float scale = 1.0f / total;
    Shade& shade = shades_.shade[pixel];
    (low * scale).store(shade.lanes.data());
    (high * scale).store(shade.lanes.data() + Reprojection::lanes);
    float& samples = shade.lanes[Shade::samples_lane];
    samples = std::min(samples, most_samples);
    shades_.cached_samples[pixel] = std::min(cached_samples * scale, most_samples);
    shades_.specular_samples[pixel] = std::min(specular_samples * scale, most_specular_samples);
    float& shown = shades_.mirrored[pixel];
    shown = refractions > 0.5f * total ? shows_by_refraction : shows_nothing;
    if (mirrors > 0.5f * total) shown = mirrored / mirrors;
    shades_.noise[pixel] = noise * scale;
    follow_mirror(tracer, reprojection, left + static_cast<int>(i), y, visibility);
    shades_.age[pixel] = static_cast<std::uint16_t>(age * scale);
  }
}

// Whether a pixel lies beside another surface, or where one turns.
bool ShadingCache::is_edge(const VisibleSurfaces& seen, int x, int y) const {
  const std::size_t i = at(x, y);
  const auto differs_from = [&](std::size_t other) {
    return seen.object[i] != seen.object[other] ||
           (seen.object[i] >= 0 && !normals_alike(seen.normal[i], seen.normal[other]));
  };
  return (x > 0 && differs_from(i - 1)) || (x + 1 < width_ && differs_from(i + 1)) ||
         (y > 0 && differs_from(at(x, y - 1))) || (y + 1 < height_ && differs_from(at(x, y + 1)));
}

// Whether the outline of something that gives light may go through it, if only as a sliver that no
// pixel's middle shows: so bright that slivers tell.
bool ShadingCache::is_beside_light(const VisibleSurfaces& seen, int x, int y) const {
  constexpr int reach = 2;
  const std::size_t middle = at(x, y);
  if (!(shades_.shade[middle].samples() > 0.0f)) return false;
  float own = 0.0f;
  for (std::size_t k = 0; k < Shade::samples_lane; ++k) own += shades_.shade[middle].lanes[k];
  for (int v = std::max(0, y - reach); v <= std::min(height_ - 1, y + reach); ++v) {
    for (int u = std::max(0, x - reach); u <= std::min(width_ - 1, x + reach); ++u) {
      const std::size_t i = at(u, v);
      const float* emitted = shades_.shade[i].lanes.data() + 3 * emitted_term;
      if (seen.object[i] != seen.object[middle] &&
          emitted[0] + emitted[1] + emitted[2] > least_glare * own) {
        return true;
      }
    }
  }
  return false;
}

void ShadingCache::find_edges(const VisibleSurfaces& seen) {
  edges_.resize(seen.size());
  for_each_row(height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      Edge& edge = edges_[at(x, y)];
      if (is_beside_light(seen, x, y)) {
        edge = Edge::of_light;
      } else {
        edge = is_edge(seen, x, y) ? Edge::plain : Edge::none;
      }
    }
  });
}

// What a mirror shows, from where the last view saw it.
void ShadingCache::follow_mirror(const LiveTracer& tracer, const Reprojection& reprojection, int x,
                                 int y, const Visibility& visibility) {
  const std::size_t pixel = at(x, y);
  Shade& shade = shades_.shade[pixel];
  const std::int32_t object = visibility.now().object[pixel];
  float vergence = shades_.mirrored[pixel];
  if (object < 0 || vergence < 0.0f) return;
  float all = 0.0f, specular = 0.0f;
  for (std::size_t i = 0; i < Shade::samples_lane; ++i) all += shade.lanes[i];
  for (std::size_t c = 0; c < 3; ++c) specular += shade.lanes[3 * specular_term + c];
  if (!(specular > least_mirrored_share * all)) return;
  const float curvature = tracer.curvature(object);
  if (std::isnan(curvature)) return;

  // What the pixel's surface showed is a guess of what it shows now: the place where that leads to
  // knows better.
  constexpr int guesses = 2;
  for (int guess = 0; guess < guesses; ++guess) {
    V2f place;
    if (!reprojection.find_mirrored(x, y, vergence, curvature, place)) return;
    const int x0 = static_cast<int>(std::floor(place.x)),
              y0 = static_cast<int>(std::floor(place.y));
    const float ax = place.x - static_cast<float>(x0), ay = place.y - static_cast<float>(y0);
    float total = 0.0f, samples = 0.0f, shown = 0.0f;
    Color light(0.0f);
    for (int tap = 0; tap < 4; ++tap) {
      const int tx = x0 + tap % 2, ty = y0 + tap / 2;
      if (tx < 0 || ty < 0 || tx >= width_ || ty >= height_) continue;
      const std::size_t index = at(tx, ty);
      const Shade& from = last_shades_.shade[index];
      if (visibility.last().object[index] != object || !(from.samples() > 0.0f) ||
          last_shades_.mirrored[index] < 0.0f || is_mixed(index)) {
        continue;
      }
      const float w = (tap % 2 == 0 ? 1.0f - ax : ax) * (tap / 2 == 0 ? 1.0f - ay : ay);
      for (std::size_t c = 0; c < 3; ++c)
        light[static_cast<int>(c)] += w * from.lanes[3 * specular_term + c];
      samples += w * last_shades_.specular_samples[index];
      shown += w * last_shades_.mirrored[index];
      total += w;
    }
    if (!(total > least_share)) return;
    const float found = shown / total;
    const bool same = std::abs(found - vergence) <=
                      most_vergence_change * std::max(found + 2.0f * std::abs(curvature),
                                                      vergence + 2.0f * std::abs(curvature));
    vergence = found;
    if (guess + 1 < guesses && !same) continue;
    if (!same) return;
    for (std::size_t c = 0; c < 3; ++c)
      shade.lanes[3 * specular_term + c] = light[static_cast<int>(c)] / total;
    shades_.specular_samples[pixel] = std::min(samples / total, most_mirrored_samples);
    shades_.mirrored[pixel] = found;
    return;
  }
}

float ShadingCache::want(std::size_t pixel) const {
  const std::size_t block = block_of(pixel);
  const float samples = shades_.mirrored[pixel] == shows_nothing ? shades_.shade[pixel].samples()
                                                                 : shades_.specular_samples[pixel];
  float noisiness = noisiness_[block];
  if (rested_ && edges_[pixel] != Edge::none) {
    // Samples in proportion to the noise: their number's growth to its square.
    const float own = noise_scale_ * std::sqrt(shades_.noise[pixel]);
    noisiness = std::max(noisiness, own * std::min(own, most_noisiness_at_edges));
    if (is_untried_edge(pixel)) noisiness = std::max(noisiness, first_noisiness_at_edges);
    if (edges_[pixel] == Edge::of_light) noisiness = std::max(noisiness, least_noisiness_by_light);
  }
  return noisiness * (1.0f + most_urgent * urgency_[block]) *
         (1.0f + static_cast<float>(shades_.age[pixel]) / age_unit) / (1.0f + samples);
}

// What changes goes on to change, and next to it.
void ShadingCache::spread_urgency() {
  const std::vector<float> before = urgency_;
  const std::size_t down = urgency_.size() / blocks_across_;
  for (std::size_t y = 0; y < down; ++y) {
    for (std::size_t x = 0; x < blocks_across_; ++x) {
      const std::size_t i = y * blocks_across_ + x;
      float around = 0.0f;
      if (x > 0) around = std::max(around, before[i - 1]);
      if (x + 1 < blocks_across_) around = std::max(around, before[i + 1]);
      if (y > 0) around = std::max(around, before[i - blocks_across_]);
      if (y + 1 < down) around = std::max(around, before[i + blocks_across_]);
      const float u = std::max(urgency_kept * before[i], urgency_spread * around);
      urgency_[i] = u < least_urgency ? 0.0f : u;
    }
  }
}

// Of blocks and not of pixels: one that has met nothing bright yet is not known to be quiet.
void ShadingCache::share_noise() {
  const std::size_t down = noisiness_.size() / blocks_across_;
  std::vector<double> rows(down, 0.0);
  for_each(down, [&](std::size_t by) {
    const int top = static_cast<int>(by * block_side);
    const int bottom = std::min(top + static_cast<int>(block_side), height_);
    for (std::size_t bx = 0; bx < blocks_across_; ++bx) {
      const int left = static_cast<int>(bx * block_side);
      const int right = std::min(left + static_cast<int>(block_side), width_);
      float sum = 0.0f;
      for (int y = top; y < bottom; ++y) {
        for (std::size_t i = at(left, y); i < at(right, y); ++i) sum += shades_.noise[i];
      }
      float& noisiness = noisiness_[by * blocks_across_ + bx];
      noisiness = std::sqrt(sum / static_cast<float>((bottom - top) * (right - left)));
      rows[by] += double(noisiness);
    }
  });
  double mean = 0.0;
  for (const double sum : rows) mean += sum / static_cast<double>(noisiness_.size());
  noise_scale_ = mean > 0.0 ? static_cast<float>(1.0 / mean) : 0.0f;
  for (float& n : noisiness_) n = mean > 0.0 ? least_noisiness + noise_scale_ * n : 1.0f;
}

void ShadingCache::grow_older(int y) {
  Row row;
  for (int x = 0; x < width_; ++x) {
    const std::size_t pixel = at(x, y);
    std::uint16_t& age = shades_.age[pixel];
    age = static_cast<std::uint16_t>(age + (age < 0xffff ? 1 : 0));
    row.age += age;
    if (urgency_[block_of(pixel)] >= outdating_urgency) {
      float& samples = shades_.shade[pixel].lanes[Shade::samples_lane];
      samples = std::min(samples, most_outdated_samples);
      float& cached = shades_.cached_samples[pixel];
      cached = std::min(cached, most_outdated_samples);
    }
    if (shades_.shade[pixel].samples() > 0.0f) {
      row.wanted += double(want(pixel));
    } else {
      ++row.holes;
    }
  }
  rows_[static_cast<std::size_t>(y)] = row;
}

void ShadingCache::choose(std::size_t count, std::vector<LiveRequest>& requests) {
  Row all;
  for (const Row& row : rows_) {
    all.wanted += row.wanted;
    all.holes += row.holes;
  }
  // Holes take what there is; the rest shares out what they leave.
  const double holes = static_cast<double>(all.holes), asked = static_cast<double>(count);
  const auto share_of_holes = static_cast<float>(holes > 0.0 ? std::min(1.0, asked / holes) : 0.0);
  const double left = asked - holes;
  const auto scale = static_cast<float>(left > 0.0 && all.wanted > 0.0 ? left / all.wanted : 0.0);

  const float most = rested_ ? most_samples_at_once : 1.0f;

  const auto bands = static_cast<std::size_t>((height_ + band_height - 1) / band_height);
  std::vector<std::vector<LiveRequest>> chosen(bands);
  // Floyd and Steinberg 1976, rows in turn from left to right and from right to left.
  for_each(bands, [&](std::size_t index) {
    const auto band = static_cast<int>(index);
    std::vector<LiveRequest>& to = chosen[index];
    std::vector<float> carried(std::size_t(width_) + 2, 0.0f), next(std::size_t(width_) + 2, 0.0f);
    // What rows above the band would have left over; without it the first rows would be left out.
    for (std::size_t c = 1; c <= std::size_t(width_); ++c) {
      const std::uint32_t bits = mix_bits(hash_combine(
          frame_, static_cast<std::uint32_t>(band) * static_cast<std::uint32_t>(width_) +
                      static_cast<std::uint32_t>(c)));
      carried[c] = static_cast<float>(bits >> 8) * 0x1p-24f - 0.5f;
    }
    const int end = std::min(height_, (band + 1) * band_height);
    for (int y = band * band_height; y < end; ++y) {
      const bool forward = y % 2 == 0;
      std::fill(next.begin(), next.end(), 0.0f);
      float ahead = 0.0f;
      for (int k = 0; k < width_; ++k) {
        const int x = forward ? k : width_ - 1 - k;
        const std::size_t i = at(x, y), c = std::size_t(x) + 1;
        const bool hole = !(shades_.shade[i].samples() > 0.0f);
        const float density = hole ? share_of_holes : std::min(most, scale * want(i));
        const float value = density + carried[c] + ahead;
        const float taken = density > 0.0f ? std::clamp(std::floor(value + 0.5f),
                                                        std::min(1.0f, std::floor(density)), most)
                                           : 0.0f;
        if (taken > 0.0f) {
          const auto samples = static_cast<std::uint32_t>(
              is_untried_edge(i) ? std::max(taken, first_samples_at_edges) : taken);
          to.push_back({static_cast<std::uint32_t>(i), numbers_[i], samples});
          numbers_[i] += samples;
        }
        const float error = value - taken;
        ahead = error * (7.0f / 16.0f);
        const std::size_t front = forward ? c + 1 : c - 1, back = forward ? c - 1 : c + 1;
        next[back] += error * (3.0f / 16.0f);
        next[c] += error * (5.0f / 16.0f);
        next[front] += error * (1.0f / 16.0f);
      }
      // What would leave the picture stays in it.
      next[1] += next[0];
      next[std::size_t(width_)] += next[std::size_t(width_) + 1];
      next[forward ? std::size_t(width_) : 1] += ahead;
      next[0] = next[std::size_t(width_) + 1] = 0.0f;
      std::swap(carried, next);
    }
  });
  requests.clear();
  for (const std::vector<LiveRequest>& some : chosen)
    requests.insert(requests.end(), some.begin(), some.end());
}

void ShadingCache::add(const std::vector<LiveSample>& samples) {
  constexpr std::size_t grain = 4096;
  for_each_in_groups(samples.size(), grain, [&](std::size_t k) {
    const LiveSample& sample = samples[k];
    Shade& s = shades_.shade[sample.pixel];
    float& count = s.lanes[Shade::samples_lane];
    if (changing_ && count > 0.0f && differs(sample, s.lanes.data())) {
      std::atomic_ref<float>(urgency_[block_of(sample.pixel)])
          .store(1.0f, std::memory_order_relaxed);
    }
    if (count > 0.0f) {
      float& noise = shades_.noise[sample.pixel];
      const float a = 1.0f / (1.0f + std::min(count, most_noise_samples));
      noise += (noise_of(sample, s.lanes.data(), count) - noise) * a;
    }
    float& cached_count = shades_.cached_samples[sample.pixel];
    float& specular_count = shades_.specular_samples[sample.pixel];
    const auto n = static_cast<float>(sample.count);
    const float share = n / (count + n), cached_share = n / (cached_count + n),
                specular_share = n / (specular_count + n);
    // By Term.
    const std::array<float, term_count> shares = {share, specular_share, share, cached_share,
                                                  cached_share};
    for (std::size_t t = 0; t < term_count; ++t) {
      const float a = shares[t];
      for (std::size_t c = 0; c < 3; ++c) {
        float& mean = s.lanes[3 * t + c];
        mean += (sample.terms[t][static_cast<int>(c)] - mean) * a;
      }
    }
    float& mirrored = shades_.mirrored[sample.pixel];
    if (mirrored < 0.0f || sample.mirrored == shows_by_refraction) {
      mirrored = sample.mirrored;
    } else if (sample.mirrored >= 0.0f) {
      mirrored += (sample.mirrored - mirrored) * specular_share;
    }
    count += n;
    cached_count += n;
    specular_count += n;
    shades_.age[sample.pixel] = 0;
  });
}

// Terms lie three numbers apart; of the fourth of each nothing is kept.
Color ShadingCache::sum(const Shade& shade, const std::array<float, term_count>& shown) {
  vfloat4 sum(0.0f);
  for (std::size_t t = 0; t < term_count; ++t)
    sum = madd(vfloat4(shade.lanes.data() + 3 * t), vfloat4(shown[t]), sum);
  return Color(sum[0], sum[1], sum[2]);
}

void ShadingCache::resolve(std::uint32_t terms, const VisibleSurfaces& seen,
                           std::vector<Color>& picture) const {
  std::array<float, term_count> shown;
  for (std::size_t t = 0; t < term_count; ++t) shown[t] = (terms & (1u << t)) != 0 ? 1.0f : 0.0f;
  picture.resize(shades_.shade.size());
  std::vector<std::uint8_t> known(shades_.shade.size());
  std::atomic<bool> any_unknown = false;
  for_each_row(height_, [&](int y) {
    std::size_t holes = 0;
    for (std::size_t i = at(0, y); i < at(0, y + 1); ++i) {
      picture[i] = sum(shades_.shade[i], shown);
      known[i] = shades_.shade[i].samples() > 0.0f ? 1 : 0;
      holes += 1u - known[i];
    }
    if (holes > 0) any_unknown.store(true, std::memory_order_relaxed);
  });
  if (any_unknown) pull_push(width_, height_, known, seen, picture);
}

double ShadingCache::mean_age() const {
  double sum = 0.0;
  for (const Row& row : rows_) sum += row.age;
  return sum / static_cast<double>(shades_.shade.size());
}

std::size_t ShadingCache::hole_count() const {
  std::atomic<std::size_t> count = 0;
  for_each_row(height_, [&](int y) {
    std::size_t in_row = 0;
    for (int x = 0; x < width_; ++x) in_row += shades_.shade[at(x, y)].samples() > 0.0f ? 0 : 1;
    count += in_row;
  });
  return count;
}

}  // namespace lumivec
