#include "integrator/irradiance_cache.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "integrator/frame.h"
#include "integrator/sampling.h"

namespace lumivec {
namespace {

// Records hold for normals within about 37° of their own; between that and parallel their weight
// falls off.
constexpr float least_normal_cosine = 0.8f;
// Normals closer than this are the same.
constexpr float parallel_cosine = 1.0f - 1e-5f;
// Off the tangent plane a record reaches this share of its shorter half axis: surfaces that curve
// away are still served, steps are not.
constexpr float off_plane_reach = 0.25f;
// Where pixels are larger than records reach they reach this many pixels: finer detail than that is
// not asked for.
constexpr float least_pixels = 1.5f;
// Linear extrapolation changes the irradiance by at most this factor.
constexpr float most_gain = 2.0f, least_gain = 0.5f;
// Visibility is tested between points that are lifted off their surfaces by this share of their
// distance, so that the surfaces' own unevenness does not count.
constexpr float lift = 0.02f;

// Of a record and of its places in the tree: as it was inserted, and as it is packed.
constexpr std::uint64_t record_bytes = sizeof(IrradianceRecord) + 64;

float reach(const IrradianceRecord& r) {
  return std::max(r.radius_large, r.least_reach);
}

// Of eight azimuths −π … π, counter-clockwise.
std::size_t sector_of(const V2f& offset) {
  static_assert(IrradianceRecord::sector_count == 8);
  const bool left = offset.x<0.0f, steep = std::abs(offset.y)> std::abs(offset.x);
  if (offset.y < 0.0f) return left ? (steep ? 1 : 0) : (steep ? 2 : 3);
  return left ? (steep ? 6 : 7) : (steep ? 5 : 4);
}

}  // namespace

IrradianceCache::IrradianceCache(const TracedScene& scene, const ValidityParts& parts,
                                 std::uint64_t max_bytes)
    : scene_(scene), parts_(parts), max_bytes_(max_bytes) {}

float IrradianceCache::least_reach(float footprint, float budget) {
  return least_pixels * footprint / std::sqrt(std::sqrt(budget));
}

void IrradianceCache::set_error(double error) {
  constexpr double usual = 0.01;
  least_share_ = static_cast<float>(std::sqrt(std::min(1.0, error / usual)));
}

std::uint64_t IrradianceCache::bytes() const {
  return tree_.bytes() + records_.bytes();
}

bool IrradianceCache::full() const {
  return (std::uint64_t{size()} + 1) * record_bytes > max_bytes_;
}

bool IrradianceCache::insert(const IrradianceRecord& record) {
  if (full()) return false;
  for (std::size_t c = 0; c < 3; ++c) {
    assert(std::isfinite(record.light.vector[c].length2()) && record.light.flux[int(c)] >= 0.0f);
  }
  assert(std::isfinite(record.radius_large) && record.radius_small >= 0.0f);
  tree_.insert(record.position, reach(record), [&](std::uint32_t index) {
    while (records_.size() <= index) records_.grow();
    records_[index] = record;
  });
  return true;
}

float IrradianceCache::least_half_axis(const IrradianceRecord& r, float footprint) const {
  if (!parts_.footprint_clamp) return 0.0f;
  return std::min(least_share_ * least_pixels * footprint, r.mean_distance);
}

// 1 at the record, 0 from the rim of its ellipse on, and smooth in between.
float IrradianceCache::weight(const IrradianceRecord& r, const CachePoint& point,
                              float scale) const {
  const float cosine = point.normal.dot(r.normal);
  if (cosine <= least_normal_cosine) return 0.0f;
  const float least = least_half_axis(r, point.footprint);
  const float large = std::max(r.radius_large * scale, least);
  const float small = std::max(r.radius_small * scale, least);
  if (!(small > 0.0f)) return 0.0f;
  const V3f d = point.position - r.position;
  const float height = d.dot(r.normal), along = d.dot(r.axis);
  const float across2 = std::max(0.0f, d.length2() - height * height - along * along);
  const float reach2 = small * small;
  const float m2 =
      (along * along + height * height * (1.0f / (off_plane_reach * off_plane_reach))) / reach2 +
      across2 / (large * large);
  if (m2 >= 1.0f) return 0.0f;
  return (1.0f - m2) * (1.0f - m2) * (cosine - least_normal_cosine) / (1.0f - least_normal_cosine);
}

bool IrradianceCache::may_be_hidden(const IrradianceRecord& record, const V2f& offset) const {
  const float clearance = record.clearance[sector_of(offset)];
  return parts_.leak_guard && offset.length2() > clearance * clearance;
}

bool IrradianceCache::look_up(const CachePoint& point, float budget, float needed_weight,
                              CachedLight& result, std::uint64_t& visibility_rays) const {
  const float scale = std::sqrt(std::sqrt(budget));
  LightSum sum;
  float total = 0.0f;
  int count = 0;
  const auto visit = [&](std::uint32_t index, float distance2) {
    const IrradianceRecord& r = records_[index];
    const float w = weight(r, point, scale);
    if (!(w > 0.0f)) return;
    const Frame frame = make_frame(r.normal);
    const V3f d = point.position - r.position;
    const V2f offset(d.dot(frame.t), d.dot(frame.b));
    if (may_be_hidden(r, offset)) {
      const float height = lift * std::sqrt(distance2);
      const V3f from = point.position + point.geometric_normal * (point.error + height);
      const V3f to = r.position + r.normal * (point.error + height);
      ++visibility_rays;
      if (scene_.intersect(from, to - from, 0.0f, 1.0f, 0u).valid()) return;
    }
    // On a curved surface the sky turns with the normal, a source does not.
    std::array<V3f, 3> vector = r.light.vector;
    if (point.normal.dot(r.normal) < parallel_cosine) {
      const SkyAndSource split = split_light(r.light, r.normal);
      for (std::size_t c = 0; c < 3; ++c) {
        const int channel = static_cast<int>(c);
        vector[c] = split.sky[channel] * point.normal + split.source[channel] * split.direction[c];
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      float gain = 1.0f;
      const float here = r.light.vector[c].dot(r.normal);
      if (parts_.gradient && here > 0.0f) {
        gain = std::clamp(1.0f + r.gradient[c].dot(offset) / here, least_gain, most_gain);
      }
      sum.vector[c] += (w * gain) * vector[c];
      sum.flux[int(c)] += w * gain * r.light.flux[int(c)];
    }
    total += w;
    ++count;
  };
  tree_.for_each_reaching(point.position, scale, visit);
  if (!(total >= needed_weight) || !(total > 0.0f)) return false;
  const float normalise = 1.0f / total;
  for (std::size_t c = 0; c < 3; ++c) sum.vector[c] *= normalise;
  sum.flux *= normalise;
  result = {sum, point.normal, total, count};
  return true;
}

void IrradianceCache::clear() {
  tree_.clear();
  records_.clear();
}

void IrradianceCache::rebuild() {
  tree_.rebuild([&](std::uint32_t i) { return reach(records_[i]); });
}

void IrradianceCache::commit(float budget) {
  const std::uint32_t n = size();
  std::vector<float> clamped(n);
  const float scale = std::sqrt(std::sqrt(budget));
  for (std::uint32_t i = 0; i < n; ++i) clamped[i] = records_[i].radius_large;
  tree_.rebuild([&](std::uint32_t i) { return reach(records_[i]); });
  if (!parts_.neighbour_clamp || !(scale > 0.0f)) return;
  // R_i ≤ R_j + |x_i − x_j| for all neighbours j: those that reach i's place, or that i reaches.
  for (std::uint32_t i = 0; i < n; ++i) {
    const IrradianceRecord& r = records_[i];
    tree_.for_each_reaching(r.position, scale, [&](std::uint32_t j, float distance2) {
      const IrradianceRecord& other = records_[j];
      if (j == i || other.normal.dot(r.normal) <= least_normal_cosine) return;
      const float bound = r.radius_small + std::sqrt(distance2) / scale;
      clamped[j] = std::min(clamped[j], bound);
    });
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    IrradianceRecord& r = records_[i];
    r.radius_large = clamped[i];
    if (clamped[i] < r.radius_small) r.limit = RadiusLimit::neighbour;
    r.radius_small = std::min(r.radius_small, clamped[i]);
  }
  tree_.rebuild([&](std::uint32_t i) { return reach(records_[i]); });
}

}  // namespace lumivec
