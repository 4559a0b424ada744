#include "integrator/light_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "integrator/sampling.h"

namespace lumivec {
namespace {

// Trails hold one bit a level; below this depth groups are split in the middle, which ends after
// log2 more levels.
constexpr int max_unbalanced_depth = 32;

float safe_acos(float c) {
  return std::acos(std::clamp(c, -1.0f, 1.0f));
}

struct Cone {
  V3f axis;
  float cos_angle;
};

// The smallest cone around two cones.
Cone merge(const Cone& a, const Cone& b) {
  const float ta = safe_acos(a.cos_angle), tb = safe_acos(b.cos_angle);
  const float between = safe_acos(a.axis.dot(b.axis));
  if (std::min(between + tb, pi) <= ta) return a;
  if (std::min(between + ta, pi) <= tb) return b;
  const float angle = (ta + between + tb) * 0.5f;
  if (angle >= pi) return {a.axis, -1.0f};
  const float turn = angle - ta;
  const V3f side = b.axis - a.axis * a.axis.dot(b.axis);
  if (!(side.length2() > 1e-12f)) return {a.axis, -1.0f};
  const V3f axis = a.axis * std::cos(turn) + side.normalized() * std::sin(turn);
  return {axis.normalized(), std::cos(angle)};
}

LightBounds merge(const LightBounds& a, const LightBounds& b) {
  LightBounds m;
  for (int i = 0; i < 3; ++i) {
    m.min[i] = std::min(a.min[i], b.min[i]);
    m.max[i] = std::max(a.max[i], b.max[i]);
  }
  const Cone cone = merge(Cone{a.axis, a.cos_spread}, Cone{b.axis, b.cos_spread});
  m.axis = cone.axis;
  m.cos_spread = cone.cos_angle;
  m.cos_emission = std::min(a.cos_emission, b.cos_emission);
  m.intensity = a.intensity + b.intensity;
  m.two_sided = a.two_sided || b.two_sided;
  return m;
}

// cos(max(0, x - y)) and its sine from those of x and y.
float cos_difference(float sin_x, float cos_x, float sin_y, float cos_y) {
  return cos_x > cos_y ? 1.0f : cos_x * cos_y + sin_x * sin_y;
}
float sin_difference(float sin_x, float cos_x, float sin_y, float cos_y) {
  return cos_x > cos_y ? 0.0f : sin_x * cos_y - cos_x * sin_y;
}
float sine(float cosine) {
  return std::sqrt(std::max(0.0f, 1.0f - cosine * cosine));
}

float light_importance(const LightBounds& b, const V3f& p, const V3f& normal) {
  const V3f center = (b.min + b.max) * 0.5f;
  const V3f to_light = center - p;
  const float radius2 = (b.max - center).length2();
  const float d2 = to_light.length2();
  // Inside or near the bounds the distance says nothing.
  const float falloff = std::max({d2, radius2, std::numeric_limits<float>::min()});
  if (d2 <= radius2) return b.intensity / falloff;
  const V3f direction = to_light * (1.0f / std::sqrt(d2));
  const float sin2_bounds = radius2 / d2;
  const float sin_bounds = std::sqrt(sin2_bounds), cos_bounds = std::sqrt(1.0f - sin2_bounds);

  float cos_axis = -direction.dot(b.axis);
  if (b.two_sided) cos_axis = std::abs(cos_axis);
  const float sin_axis = sine(cos_axis), sin_spread = sine(b.cos_spread);
  const float cos_x = cos_difference(sin_axis, cos_axis, sin_spread, b.cos_spread);
  const float sin_x = sin_difference(sin_axis, cos_axis, sin_spread, b.cos_spread);
  const float cos_leaving = cos_difference(sin_x, cos_x, sin_bounds, cos_bounds);
  if (cos_leaving <= b.cos_emission) return 0.0f;

  float value = b.intensity * cos_leaving / falloff;
  if (normal != V3f(0.0f)) {
    const float cos_i = direction.dot(normal);
    value *= std::max(0.0f, cos_difference(sine(cos_i), cos_i, sin_bounds, cos_bounds));
  }
  return value;
}

// Surface-area orientation heuristic of a group: what a split tries to make small.
float orientation_cost(const LightBounds& b) {
  const float spread = safe_acos(b.cos_spread), emission = safe_acos(b.cos_emission);
  const float w = std::min(spread + emission, pi);
  const float solid = 2.0f * pi * (1.0f - b.cos_spread) +
                      0.5f * pi *
                          (2.0f * w * std::sin(spread) - std::cos(spread - 2.0f * w) -
                           2.0f * spread * std::sin(spread) + b.cos_spread);
  const V3f size = b.max - b.min;
  const float area = 2.0f * (size.x * size.y + size.y * size.z + size.z * size.x);
  return b.intensity * solid * area;
}

}  // namespace

LightTree::LightTree(const std::vector<LightBounds>& lights) {
  if (lights.empty()) return;
  nodes_.reserve(2 * lights.size() - 1);
  trails_.resize(lights.size());
  std::vector<int> order(lights.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  build(lights, order, 0, static_cast<int>(lights.size()), 0, 0);
}

int LightTree::build(const std::vector<LightBounds>& lights, std::vector<int>& order, int begin,
                     int end, int depth, std::uint64_t trail) {
  const int index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  if (end - begin == 1) {
    const int light = order[std::size_t(begin)];
    nodes_[std::size_t(index)].bounds = lights[std::size_t(light)];
    nodes_[std::size_t(index)].light = light;
    trails_[std::size_t(light)] = trail;
    return index;
  }
  V3f low(std::numeric_limits<float>::infinity()), high(-std::numeric_limits<float>::infinity());
  const auto center = [&](int light) {
    return (lights[std::size_t(light)].min + lights[std::size_t(light)].max) * 0.5f;
  };
  for (int i = begin; i < end; ++i) {
    const V3f c = center(order[std::size_t(i)]);
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], c[axis]);
      high[axis] = std::max(high[axis], c[axis]);
    }
  }
  constexpr int bucket_count = 12;
  int best_axis = -1, best_bucket = 0;
  float best_cost = std::numeric_limits<float>::infinity();
  const auto bucket_of = [&](int light, int axis) {
    const float t = (center(light)[axis] - low[axis]) / (high[axis] - low[axis]);
    return std::clamp(static_cast<int>(t * bucket_count), 0, bucket_count - 1);
  };
  for (int axis = 0; axis < 3 && depth < max_unbalanced_depth; ++axis) {
    if (!(high[axis] > low[axis])) continue;
    LightBounds buckets[bucket_count];
    bool used[bucket_count] = {};
    for (int i = begin; i < end; ++i) {
      const int light = order[std::size_t(i)];
      const int bucket = bucket_of(light, axis);
      buckets[bucket] = used[bucket] ? merge(buckets[bucket], lights[std::size_t(light)])
                                     : lights[std::size_t(light)];
      used[bucket] = true;
    }
    float above_cost[bucket_count] = {};
    LightBounds group;
    bool any = false;
    for (int bucket = bucket_count - 1; bucket > 0; --bucket) {
      if (used[bucket]) group = any ? merge(group, buckets[bucket]) : buckets[bucket];
      any = any || used[bucket];
      above_cost[bucket] = any ? orientation_cost(group) : -1.0f;
    }
    any = false;
    for (int bucket = 0; bucket + 1 < bucket_count; ++bucket) {
      if (used[bucket]) group = any ? merge(group, buckets[bucket]) : buckets[bucket];
      any = any || used[bucket];
      if (!any || above_cost[bucket + 1] < 0.0f) continue;
      const float cost = orientation_cost(group) + above_cost[bucket + 1];
      if (cost < best_cost) {
        best_cost = cost;
        best_axis = axis;
        best_bucket = bucket;
      }
    }
  }
  int middle = (begin + end) / 2;
  if (best_axis >= 0) {
    const auto split = std::stable_partition(
        order.begin() + begin, order.begin() + end,
        [&](int light) { return bucket_of(light, best_axis) <= best_bucket; });
    middle = static_cast<int>(split - order.begin());
  }
  const int first = build(lights, order, begin, middle, depth + 1, trail);
  const int second =
      build(lights, order, middle, end, depth + 1, trail | (std::uint64_t{1} << depth));
  Node& node = nodes_[std::size_t(index)];
  node.bounds = merge(nodes_[std::size_t(first)].bounds, nodes_[std::size_t(second)].bounds);
  node.second = second;
  return index;
}

float LightTree::importance(const V3f& p, const V3f& normal) const {
  return nodes_.empty() ? 0.0f : light_importance(nodes_.front().bounds, p, normal);
}

int LightTree::sample(const V3f& p, const V3f& normal, float& u, float& probability) const {
  probability = 1.0f;
  if (nodes_.empty()) return -1;
  int index = 0;
  while (nodes_[std::size_t(index)].light < 0) {
    const int first = index + 1, second = nodes_[std::size_t(index)].second;
    const float a = light_importance(nodes_[std::size_t(first)].bounds, p, normal);
    const float b = light_importance(nodes_[std::size_t(second)].bounds, p, normal);
    if (!(a + b > 0.0f)) return -1;
    const float share = a / (a + b);
    if (u < share) {
      u = std::min(u / share, 0x1.fffffep-1f);
      probability *= share;
      index = first;
    } else {
      u = std::min((u - share) / (1.0f - share), 0x1.fffffep-1f);
      probability *= 1.0f - share;
      index = second;
    }
  }
  return nodes_[std::size_t(index)].light;
}

float LightTree::probability(const V3f& p, const V3f& normal, int light) const {
  float result = 1.0f;
  std::uint64_t trail = trails_[std::size_t(light)];
  int index = 0;
  while (nodes_[std::size_t(index)].light < 0) {
    const int first = index + 1, second = nodes_[std::size_t(index)].second;
    const float a = light_importance(nodes_[std::size_t(first)].bounds, p, normal);
    const float b = light_importance(nodes_[std::size_t(second)].bounds, p, normal);
    if (!(a + b > 0.0f)) return 0.0f;
    const float share = a / (a + b);
    const bool take_second = trail & 1u;
    result *= take_second ? 1.0f - share : share;
    index = take_second ? second : first;
    trail >>= 1;
  }
  return result;
}

}  // namespace lumivec
