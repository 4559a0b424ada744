#include "integrator/solid_boundaries.h"

#include <algorithm>
#include <cmath>

namespace lumivec {
namespace {

using Imath::Box3d;

// Bounds grow by this share of their size and place: faces that lie on them must not be missed.
constexpr double bounds_margin = 1e-6;

// Crossings that are closer than this share of the ray's stretch, or of the distance, are one:
// faces that coincide leave neither gaps nor sheets.
constexpr double same_place = 1e-11;

Box3d placed(const Box3d& box, const M44d& m) {
  Box3d result;
  for (int corner = 0; corner < 8; ++corner) {
    result.extendBy(V3d(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                        corner & 4 ? box.max.z : box.min.z) *
                    m);
  }
  for (int i = 0; i < 3; ++i) {
    const double margin =
        bounds_margin * std::max(std::abs(result.min[i]), std::abs(result.max[i])) +
        bounds_margin * (result.max[i] - result.min[i]);
    result.min[i] -= margin;
    result.max[i] += margin;
  }
  return result;
}

bool is_bounded(const Box3d& box) {
  return !box.isEmpty() && std::isfinite(box.size().length2());
}

// The state of the trees at a place of the ray. Kept by each thread, so that rays need no memory of
// their own.
struct Walk {
  struct Event {
    double t;
    int leaf;
    bool hidden;
    bool operator<(const Event& other) const {
      return t < other.t || (t == other.t && leaf < other.leaf);
    }
  };
  Crossings crossings;
  std::vector<Event> events;
  std::vector<int> visited;           // nodes
  std::vector<int> inside_children;   // by node
  std::vector<std::uint8_t> inside;   // by node, after its complement
  std::vector<std::uint8_t> skipped;  // by node: its bounds are elsewhere
};

bool combined(const SolidNode& node, int inside_children, int children) {
  const bool raw =
      node.operation == SolidOperation::unite ? inside_children > 0 : inside_children == children;
  return raw != node.complement;
}

}  // namespace

TracedSolid::TracedSolid(const Solid& solid, int part, const M44d& object_to_traced)
    : solid_(&solid), part_(part), bounds_(placed(solid.bounds, object_to_traced)) {
  for (const SolidLeaf& leaf : solid.leaves)
    leaves_.push_back({(leaf.to_solid * object_to_traced).inverse(), elements_of(leaf), -1, false});
  children_.assign(solid.nodes.size(), 0);
  for (std::size_t i = 0; i < solid.nodes.size(); ++i) {
    const SolidNode& node = solid.nodes[i];
    node_bounds_.push_back(is_bounded(node.bounds) ? placed(node.bounds, object_to_traced)
                                                   : node.bounds);
    if (node.parent >= 0) ++children_[std::size_t(node.parent)];
    if (node.leaf < 0) continue;
    Leaf& leaf = leaves_[std::size_t(node.leaf)];
    leaf.node = static_cast<int>(i);
    for (int up = static_cast<int>(i); up >= 0; up = solid.nodes[std::size_t(up)].parent)
      leaf.inside_out ^= solid.nodes[std::size_t(up)].complement;
  }
}

Line TracedSolid::line_of(const Leaf& leaf, const Line& ray) const {
  Line line;
  line.origin = ray.origin * leaf.to_leaf;
  leaf.to_leaf.multDirMatrix(ray.direction, line.direction);
  return line;
}

std::optional<TracedSolid::Boundary> TracedSolid::first_boundary(const Line& ray, double near,
                                                                 double far) const {
  double start = near, stop = far;
  if (!clip_to(bounds_, ray, start, stop)) return std::nullopt;
  thread_local Walk walk;
  const std::size_t count = solid_->nodes.size();
  walk.events.clear();
  walk.visited.clear();
  walk.inside_children.resize(count);
  walk.inside.resize(count);
  walk.skipped.resize(count);

  for (int i = 0; i < static_cast<int>(count);) {
    const auto at = std::size_t(i);
    const SolidNode& node = solid_->nodes[at];
    walk.visited.push_back(i);
    walk.inside_children[at] = 0;
    walk.skipped[at] = 0;
    double low = start, high = stop;
    if (is_bounded(node.bounds) && !clip_to(node_bounds_[at], ray, low, high)) {
      walk.skipped[at] = 1;
      walk.inside[at] = node.complement;
      i = node.end;
      continue;
    }
    if (node.leaf >= 0) {
      const Leaf& leaf = leaves_[std::size_t(node.leaf)];
      find_crossings(solid_->leaves[std::size_t(node.leaf)], leaf.elements, line_of(leaf, ray),
                     start, stop, walk.crossings);
      walk.inside[at] = walk.crossings.inside_at_start != node.complement;
      for (const Crossing& c : walk.crossings.list)
        walk.events.push_back({c.t, node.leaf, c.hidden});
    }
    ++i;
  }
  if (walk.events.empty()) return std::nullopt;
  for (auto it = walk.visited.rbegin(); it != walk.visited.rend(); ++it) {
    const auto at = std::size_t(*it);
    const SolidNode& node = solid_->nodes[at];
    if (node.leaf < 0 && !walk.skipped[at])
      walk.inside[at] = combined(node, walk.inside_children[at], children_[at]);
    if (node.parent >= 0) walk.inside_children[std::size_t(node.parent)] += walk.inside[at];
  }
  const auto cut_away = [&] {
    for (std::size_t root = std::size_t(solid_->nodes[0].end); root < count;
         root = std::size_t(solid_->nodes[root].end)) {
      if (!walk.inside[root]) return true;
    }
    return false;
  };
  // True: the first root changed.
  const auto toggle = [&](int leaf) {
    int i = leaves_[std::size_t(leaf)].node;
    walk.inside[std::size_t(i)] ^= 1;
    while (solid_->nodes[std::size_t(i)].parent >= 0) {
      const int change = walk.inside[std::size_t(i)] ? 1 : -1;
      i = solid_->nodes[std::size_t(i)].parent;
      const auto at = std::size_t(i);
      walk.inside_children[at] += change;
      const bool now = combined(solid_->nodes[at], walk.inside_children[at], children_[at]);
      if (now == bool(walk.inside[at])) return false;
      walk.inside[at] = now;
    }
    return i == 0;
  };

  std::sort(walk.events.begin(), walk.events.end());
  for (std::size_t i = 0; i < walk.events.size();) {
    const double t = walk.events[i].t;
    const double together = t + same_place * (std::abs(t) + stop - start);
    const bool before = walk.inside[0];
    Boundary boundary{t, -1};
    bool hidden = false;
    for (; i < walk.events.size() && walk.events[i].t <= together; ++i) {
      if (!toggle(walk.events[i].leaf)) continue;
      boundary = {walk.events[i].t, walk.events[i].leaf};
      hidden = walk.events[i].hidden;
    }
    if (bool(walk.inside[0]) == before || boundary.leaf < 0 || hidden) continue;
    if (solid_->leaves[std::size_t(boundary.leaf)].part == part_ && !cut_away()) return boundary;
  }
  return std::nullopt;
}

bool TracedSolid::contains(const V3d& point) const {
  Crossings found;
  const auto inside = [&](const auto& self, std::size_t at) -> bool {
    const SolidNode& node = solid_->nodes[at];
    if (node.leaf >= 0) {
      // A line in no particular direction, which is inside at the point or is not.
      const Line line{point, V3d(0.36, 0.48, 0.8)};
      const Leaf& leaf = leaves_[std::size_t(node.leaf)];
      find_crossings(solid_->leaves[std::size_t(node.leaf)], leaf.elements, line_of(leaf, line),
                     0.0, 0x1p-20 * bounds_.size().length(), found);
      return found.inside_at_start != node.complement;
    }
    int children = 0, within = 0;
    for (auto i = at + 1; i < std::size_t(node.end); i = std::size_t(solid_->nodes[i].end)) {
      ++children;
      within += self(self, i);
    }
    return combined(node, within, children);
  };
  return inside(inside, 0);
}

TracedSolid::Place TracedSolid::place(int index, const Line& ray, double t) const {
  const Leaf& leaf = leaves_[std::size_t(index)];
  const SolidLeaf& shape = solid_->leaves[std::size_t(index)];
  const Line line = line_of(leaf, ray);
  thread_local Crossings found;
  // The distance has come back in single precision: the crossing that it was is nearby.
  const double around = 0x1p-20 * (std::abs(t) + bounds_.size().length() * 0x1p-4);
  find_crossings(shape, leaf.elements, line, t - around, t + around, found);
  Crossing nearest{t};
  for (const Crossing& c : found.list) {
    if (&c == &found.list[0] || std::abs(c.t - t) < std::abs(nearest.t - t)) nearest = c;
  }
  Place result;
  result.point = ray.origin + ray.direction * nearest.t;
  const V3d gradient = outward_at(shape, leaf.elements, line, nearest);
  // The inverse transpose of the way from the primitive.
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.outward[i] += leaf.to_leaf[i][j] * gradient[j];
  }
  if (leaf.inside_out) result.outward = -result.outward;
  const double length = result.outward.length();
  result.outward = length > 0.0 && std::isfinite(length) ? result.outward / length : V3d(0.0);
  return result;
}

}  // namespace lumivec
