#include "viewer/walk/shading_cache.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "viewer/walk/pull_push.h"

namespace lumivec {
namespace {

// A shade is carried over between points of one surface: their normals differ by less than about
// 25°, and each lies in the other's tangent plane up to this many pixels.
constexpr float least_normal_cosine = 0.9f;
constexpr float most_off_plane = 2.0f;
// What moves over the picture rests on so many samples at most, so that it follows changes of the
// light and is not blurred by being carried over again and again; what mirrors show moves with the
// eye, and is trusted less.
constexpr float most_samples = 16.0f;
constexpr float most_specular_samples = 2.0f;
// Of four pixels around a place, those of other surfaces are left out; less than this share of
// theirs is too little to go by.
constexpr float least_share = 0.05f;
// The age that counts like one sample less.
constexpr float age_unit = 4.0f;

template <typename Body>
void for_each_row(int height, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(0, height, 8), [&](const tbb::blocked_range<int>& r) {
    for (int y = r.begin(); y < r.end(); ++y) body(y);
  });
}

constexpr auto specular_term = static_cast<std::size_t>(Term::specular);

}  // namespace

const ShadingCache::Shade ShadingCache::nothing = {};

ShadingCache::ShadingCache(int width, int height)
    : width_(width),
      height_(height),
      points_(std::size_t(width) * std::size_t(height)),
      last_points_(points_.size()),
      shades_(points_.size()),
      last_shades_(points_.size()) {}

void ShadingCache::see(const LiveTracer& tracer, std::vector<VisiblePoint>& seen) {
  ++frame_;
  std::swap(points_, last_points_);
  std::swap(points_, seen);
  std::swap(shades_, last_shades_);
  for_each_row(height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      const std::size_t i = at(x, y);
      Shade& to = shades_[i];
      if (!carry_over(tracer, points_[i], to)) to = nothing;
      to.grow_older();
    }
  });
}

void ShadingCache::rest() {
  ++frame_;
  for (Shade& s : shades_) s.grow_older();
}

void ShadingCache::forget() {
  ++frame_;
  std::fill(shades_.begin(), shades_.end(), nothing);
}

// From the four pixels around the place where the last view saw the point.
bool ShadingCache::carry_over(const LiveTracer& tracer, const VisiblePoint& point,
                              Shade& shade) const {
  if (point.object < 0) return false;
  V2f at_last;
  if (!tracer.project(point.position, 1, at_last)) return false;
  const float fx = at_last.x - 0.5f, fy = at_last.y - 0.5f;
  const int x0 = static_cast<int>(std::floor(fx)), y0 = static_cast<int>(std::floor(fy));
  const float ax = fx - static_cast<float>(x0), ay = fy - static_cast<float>(y0);
  const float tolerance = most_off_plane * tracer.footprint(point.depth);
  float total = 0.0f, samples = 0.0f, specular_samples = 0.0f, age = 0.0f;
  std::array<Color, term_count> terms;
  terms.fill(Color(0.0f));
  for (int k = 0; k < 4; ++k) {
    const int x = x0 + (k & 1), y = y0 + (k >> 1);
    if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
    const std::size_t i = at(x, y);
    const Shade& from = last_shades_[i];
    const VisiblePoint& other = last_points_[i];
    if (!(from.samples > 0.0f) || other.object != point.object) continue;
    if (other.normal.dot(point.normal) < least_normal_cosine) continue;
    const V3f apart = other.position - point.position;
    if (std::abs(apart.dot(point.normal)) > tolerance) continue;
    const float weight = ((k & 1) != 0 ? ax : 1.0f - ax) * ((k >> 1) != 0 ? ay : 1.0f - ay);
    total += weight;
    samples += weight * from.samples;
    specular_samples += weight * from.specular_samples;
    age += weight * static_cast<float>(from.age);
    for (std::size_t t = 0; t < term_count; ++t) terms[t] += from.terms[t] * weight;
  }
  if (!(total > least_share)) return false;
  const float scale = 1.0f / total;
  for (std::size_t t = 0; t < term_count; ++t) shade.terms[t] = terms[t] * scale;
  shade.samples = std::min(samples * scale, most_samples);
  shade.specular_samples = std::min(specular_samples * scale, most_specular_samples);
  shade.age = static_cast<std::uint16_t>(std::min(age * scale, 60000.0f));
  return true;
}

void ShadingCache::choose(std::size_t count, std::vector<LiveRequest>& requests) {
  requests.clear();
  std::vector<float> wanted(shades_.size());
  const auto want = [&](const Shade& s) {
    return (1.0f + static_cast<float>(s.age) / age_unit) / (1.0f + s.samples);
  };
  double sum = 0.0;
  std::size_t holes = 0;
  for (std::size_t i = 0; i < shades_.size(); ++i) {
    const bool hole = !(shades_[i].samples > 0.0f);
    wanted[i] = hole ? std::numeric_limits<float>::infinity() : want(shades_[i]);
    if (hole) {
      ++holes;
    } else {
      sum += double(wanted[i]);
    }
  }
  // Holes take what there is; the rest shares out what they leave.
  const double share_of_holes =
      holes > 0 ? std::min(1.0, static_cast<double>(count) / static_cast<double>(holes)) : 0.0;
  const double left = static_cast<double>(count) - static_cast<double>(holes);
  const double scale = left > 0.0 && sum > 0.0 ? left / sum : 0.0;
  // Floyd and Steinberg 1976, rows in turn from left to right and from right to left.
  std::vector<float> carried(std::size_t(width_) + 2, 0.0f), next(std::size_t(width_) + 2, 0.0f);
  for (int y = 0; y < height_; ++y) {
    const bool forward = y % 2 == 0;
    std::fill(next.begin(), next.end(), 0.0f);
    float ahead = 0.0f;
    for (int k = 0; k < width_; ++k) {
      const int x = forward ? k : width_ - 1 - k;
      const std::size_t i = at(x, y), c = std::size_t(x) + 1;
      const float w = wanted[i];
      const float density =
          static_cast<float>(std::isinf(w) ? share_of_holes : std::min(1.0, scale * double(w)));
      const float value = density + carried[c] + ahead;
      const bool take = value >= 0.5f;
      if (take) requests.push_back({static_cast<std::uint32_t>(i), frame_});
      const float error = value - (take ? 1.0f : 0.0f);
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
}

void ShadingCache::add(const std::vector<LiveSample>& samples) {
  for (const LiveSample& sample : samples) {
    Shade& s = shades_[sample.pixel];
    const float share = 1.0f / (s.samples + 1.0f);
    const float specular_share = 1.0f / (s.specular_samples + 1.0f);
    for (std::size_t t = 0; t < term_count; ++t) {
      const float a = t == specular_term ? specular_share : share;
      s.terms[t] = s.terms[t] * (1.0f - a) + sample.terms[t] * a;
    }
    s.samples += 1.0f;
    s.specular_samples += 1.0f;
    s.age = 0;
  }
}

Color ShadingCache::sum(const Shade& shade, std::uint32_t terms) const {
  Color sum(0.0f);
  for (std::size_t t = 0; t < term_count; ++t) {
    if ((terms & (1u << t)) != 0) sum += shade.terms[t];
  }
  return sum;
}

void ShadingCache::resolve(std::uint32_t terms, std::vector<Color>& picture) const {
  constexpr int farthest = 2;  // pixels, to look for the same surface
  picture.resize(shades_.size());
  std::vector<std::uint8_t> known(shades_.size());
  std::atomic<bool> any_unknown = false;
  for_each_row(height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      const std::size_t i = at(x, y);
      known[i] = 1;
      picture[i] = Color(0.0f);
      if (shades_[i].samples > 0.0f) {
        picture[i] = sum(shades_[i], terms);
        continue;
      }
      // The nearest ring of pixels with something of the same surface.
      Color same(0.0f);
      int count = 0;
      for (int r = 1; r <= farthest && count == 0; ++r) {
        for (int dy = -r; dy <= r; ++dy) {
          const int step = std::abs(dy) == r ? 1 : 2 * r;
          for (int dx = -r; dx <= r; dx += step) {
            if (x + dx < 0 || y + dy < 0 || x + dx >= width_ || y + dy >= height_) continue;
            const std::size_t j = at(x + dx, y + dy);
            if (!(shades_[j].samples > 0.0f) || points_[j].object != points_[i].object ||
                points_[j].normal.dot(points_[i].normal) < least_normal_cosine) {
              continue;
            }
            same += sum(shades_[j], terms);
            ++count;
          }
        }
      }
      if (count > 0) {
        picture[i] = same * (1.0f / static_cast<float>(count));
      } else {
        known[i] = 0;
        any_unknown.store(true, std::memory_order_relaxed);
      }
    }
  });
  if (any_unknown) pull_push(width_, height_, known, picture);
}

void ShadingCache::resolve(Term term, std::vector<Color>& layer) const {
  resolve(1u << static_cast<unsigned>(term), layer);
}

double ShadingCache::mean_age() const {
  double sum = 0.0;
  for (const Shade& s : shades_) sum += s.age;
  return shades_.empty() ? 0.0 : sum / static_cast<double>(shades_.size());
}

std::size_t ShadingCache::hole_count() const {
  return static_cast<std::size_t>(std::count_if(
      shades_.begin(), shades_.end(), [](const Shade& s) { return !(s.samples > 0.0f); }));
}

}  // namespace lumivec
