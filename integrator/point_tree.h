// A tree of points that each reach so far: which of them reach a given place? Points are inserted
// while others look, and look-ups never block (method, section 3: the first three of the cache's
// five dimensions).
//
// New points go to a k-d tree, whose nodes hold a point each and split space at it, along x, y and
// z in turn (Bentley 1975). rebuild() packs all points into a shallow tree of boxes instead, eight
// to a node, which are compared at once. Every node knows the longest reach below it, which prunes
// the search. A look-up among 100,000 points takes a quarter of a microsecond once they are packed,
// eight times as long before; a point takes 32 bytes, and about as much again once packed.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "integrator/lanes.h"
#include "integrator/large_pages.h"
#include "integrator/prefetch.h"
#include "integrator/stable_array.h"
#include "loader/scene.h"

namespace lumivec {

class PointTree {
 public:
  // Adds a point. reach: ≥ 0, scene units. The index of the point: 0, 1, 2, … in the order of the
  // calls. prepare(index) runs before others can find the point, for what the caller keeps with it.
  // Thread-safe.
  template <typename Prepare>
  std::uint32_t insert(const V3f& position, float reach, const Prepare& prepare) {
    const std::uint32_t index = nodes_.grow();
    Node& node = nodes_[index];
    node.position = position;
    node.reach = reach;
    node.longest.store(reach, std::memory_order_relaxed);
    prepare(index);
    link(index);
    return index;
  }
  std::uint32_t insert(const V3f& position, float reach) {
    return insert(position, reach, [](std::uint32_t) {});
  }

  std::uint32_t size() const { return nodes_.size(); }
  const V3f& position(std::uint32_t index) const { return nodes_[index].position; }
  float reach(std::uint32_t index) const { return nodes_[index].reach; }
  std::size_t bytes() const {
    return nodes_.bytes() + branches_.size() * sizeof(Branch) + leaves_.size() * sizeof(Leaf);
  }

  // Calls visit(index, squared distance) for every point whose reach times scale covers p, in an
  // order that depends on the tree alone.
  template <typename Visit>
  void for_each_reaching(const V3f& p, float scale, const Visit& visit) const {
    search({p, scale, 0.0f}, visit);
  }

  // The same for at most `most` places at once: visit(query, index, squared distance), in the same
  // order for each of them. They are searched in step, so that the processor waits for all their
  // memory at once.
  struct Reaching {
    V3f p{0.0f};
    float scale = 1.0f;
  };
  template <std::size_t most, typename Visit>
  void for_each_reaching(const Reaching* queries, std::size_t count, const Visit& visit) const {
    std::array<Query, most> q;
    for (std::size_t i = 0; i < count; ++i) q[i] = {queries[i].p, queries[i].scale, 0.0f};
    search<most>(q.data(), count, visit);
  }

  // The same for every point within a distance (≥ 0, scene units) of p, whatever its reach.
  template <typename Visit>
  void for_each_within(const V3f& p, float distance, const Visit& visit) const {
    search({p, 0.0f, distance}, visit);
  }

  // Changes reaches and packs all points. reach(index) gives the new ones. Not while others use the
  // tree.
  template <typename Reach>
  void rebuild(const Reach& reach) {
    pack_all(reach);
  }

  // The same, and numbers the points anew, so that those near each other have numbers near each
  // other. The former indices, by the new ones. Not while others use the tree.
  template <typename Reach>
  std::vector<std::uint32_t> renumber(const Reach& reach) {
    const std::vector<std::uint32_t> former = pack_all(reach);
    std::vector<std::pair<V3f, float>> points;
    points.reserve(former.size());
    for (const std::uint32_t i : former) points.emplace_back(nodes_[i].position, nodes_[i].reach);
    for (std::uint32_t i = 0; i < former.size(); ++i) {
      nodes_[i].position = points[i].first;
      nodes_[i].reach = points[i].second;
      nodes_[i].longest.store(points[i].second, std::memory_order_relaxed);
    }
    std::uint32_t next = 0;  // leaves were made in this order
    for (Leaf& leaf : leaves_) {
      for (std::uint32_t& index : leaf.index) {
        if (index != none) index = next++;
      }
    }
    return former;
  }

  // Replaces all points by those, which reach nowhere but are found within distances, and packs
  // them. Not while others use the tree.
  void assign(const std::vector<V3f>& positions) {
    clear();
    nodes_.grow(static_cast<std::uint32_t>(positions.size()));
    for (std::uint32_t i = 0; i < positions.size(); ++i) nodes_[i].position = positions[i];
    rebuild([](std::uint32_t) { return 0.0f; });
  }

  // Not while others use the tree.
  void clear() {
    nodes_.clear();
    branches_.clear();
    leaves_.clear();
    root_.store(none, std::memory_order_release);
    packed_root_ = none;
  }

 private:
  static constexpr std::uint32_t none = ~0u;
  // Enough for 2^31 points, packed (eleven levels with seven that wait) or in a balanced tree of
  // nodes. One so deep that the stack is full is degenerate; its far sides are searched by
  // recursion.
  static constexpr std::size_t max_stack = 128;

  // Points count if they are no farther than scale · reach + extra.
  struct Query {
    V3f p;
    float scale, extra;

    float radius(float reach) const { return reach * scale + extra; }
  };

  struct Node {
    V3f position{0.0f};
    float reach = 0.0f;
    std::atomic<float> longest{0.0f};  // reach in the subtree of this node
    std::atomic<std::uint32_t> child[2] = {none, none};
  };

  // Packed nodes, of up to eight parts. Parts that are missing are infinitely far away.
  static constexpr std::size_t width = 8;
  static constexpr float nowhere = std::numeric_limits<float>::infinity();
  // Boxes and radii grow by what their distances may be rounded.
  static constexpr float rounded_up = 1.0f + 4.0f * std::numeric_limits<float>::epsilon();
  static constexpr std::uint32_t leaf_bit = 1u << 31;  // of a link: into leaves_, not branches_
  using Lane = std::array<float, width>;

  struct alignas(cache_line) Leaf {
    std::array<Lane, 3> position;
    Lane reach;
    std::array<std::uint32_t, width> index;
  };
  struct alignas(cache_line) Branch {
    std::array<Lane, 3> center, half;  // boxes of the positions
    Lane longest;
    std::array<std::uint32_t, width> link;
  };
  // What a branch keeps of each part.
  struct Part {
    std::uint32_t link = none;
    V3f low{nowhere}, high{-nowhere};
    float longest = 0.0f;
  };

  void link(std::uint32_t index) {
    const Node& added = nodes_[index];
    std::atomic<std::uint32_t>* slot = &root_;
    int axis = 0;
    while (true) {
      std::uint32_t found = slot->load(std::memory_order_acquire);
      if (found == none && slot->compare_exchange_strong(found, index, std::memory_order_acq_rel)) {
        return;
      }
      Node& node = nodes_[found];
      float longest = node.longest.load(std::memory_order_relaxed);
      while (longest < added.reach && !node.longest.compare_exchange_weak(longest, added.reach)) {
      }
      slot = &node.child[added.position[axis] < node.position[axis] ? 0 : 1];
      axis = axis == 2 ? 0 : axis + 1;
    }
  }

  template <typename Visit>
  void search(const Query& q, const Visit& visit) const {
    search<1>(&q, 1, [&](std::size_t, std::uint32_t index, float d2) { visit(index, d2); });
  }
  // Of at most `most` queries: visit(query, index, squared distance).
  template <std::size_t most, typename Visit>
  void search(const Query* q, std::size_t count, const Visit& visit) const {
    if (packed_root_ != none) search_packed<most>(q, count, visit);
    const std::uint32_t root = root_.load(std::memory_order_acquire);
    if (root == none) return;
    for (std::size_t i = 0; i < count; ++i) {
      search_nodes(root, 0, q[i],
                   [&](std::uint32_t index, float distance2) { visit(i, index, distance2); });
    }
  }

  template <typename Visit>
  void search_nodes(std::uint32_t index, int axis, const Query& q, const Visit& visit) const {
    struct Side {
      std::uint32_t index;
      int axis;
    };
    Side stack[max_stack];
    std::size_t top = 0;
    while (true) {
      while (index != none) {
        const Node& node = nodes_[index];
        const float off = q.p[axis] - node.position[axis];
        const float distance2 = (q.p - node.position).length2();
        const float radius = q.radius(node.reach);
        if (distance2 <= radius * radius) visit(index, distance2);
        const int near = off < 0.0f ? 0 : 1;
        axis = axis == 2 ? 0 : axis + 1;
        if (std::abs(off) <= q.radius(node.longest.load(std::memory_order_relaxed))) {
          const std::uint32_t far = node.child[1 - near].load(std::memory_order_acquire);
          if (far != none) {
            if (top < max_stack) {
              stack[top++] = {far, axis};
            } else {
              search_nodes(far, axis, q, visit);
            }
          }
        }
        index = node.child[near].load(std::memory_order_acquire);
      }
      if (top == 0) return;
      --top;
      index = stack[top].index;
      axis = stack[top].axis;
    }
  }

  // The queries take turns, a node each, which has been fetched when the next turn comes.
  template <std::size_t most, typename Visit>
  void search_packed(const Query* q, std::size_t count, const Visit& visit) const {
    struct Walk {
      std::size_t query, top;
      std::uint32_t stack[max_stack];
    };
    std::array<Walk, most> walks;
    std::array<Walk*, most> going;
    for (std::size_t i = 0; i < count; ++i) {
      going[i] = &walks[i];
      walks[i].query = i;
      walks[i].top = 1;
      walks[i].stack[0] = packed_root_;
    }
    while (count != 0) {
      std::size_t left = 0;
      for (std::size_t i = 0; i < count; ++i) {
        Walk& walk = *going[i];
        const auto found = [&](std::uint32_t index, float distance2) {
          visit(walk.query, index, distance2);
        };
        const std::uint32_t link = walk.stack[--walk.top];
        if ((link & leaf_bit) != 0) {
          search_leaf(leaves_[link & ~leaf_bit], q[walk.query], found);
        } else {
          walk.top += touched_parts(branches_[link], q[walk.query], walk.stack + walk.top);
        }
        if (walk.top != 0) going[left++] = &walk;
      }
      count = left;
    }
  }

  template <typename Visit>
  static void search_leaf(const Leaf& leaf, const Query& q, const Visit& visit) {
    Lane distance2, inside;
    for (std::size_t i = 0; i < width; ++i) {
      const float x = q.p.x - leaf.position[0][i], y = q.p.y - leaf.position[1][i],
                  z = q.p.z - leaf.position[2][i], radius = q.radius(leaf.reach[i]);
      distance2[i] = x * x + y * y + z * z;
      inside[i] = radius * radius - distance2[i];
    }
    for (std::uint32_t hits = not_negative(inside); hits != 0; hits &= hits - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(hits));
      visit(leaf.index[i], distance2[i]);
    }
  }

  // Links to the parts that may hold points; their number.
  std::size_t touched_parts(const Branch& branch, const Query& q, std::uint32_t* links) const {
    Lane inside;
    for (std::size_t i = 0; i < width; ++i) {
      const auto outside = [&](std::size_t axis, float c) {
        return twice_positive_part(std::abs(c - branch.center[axis][i]) - branch.half[axis][i]);
      };
      const float x = outside(0, q.p.x), y = outside(1, q.p.y), z = outside(2, q.p.z),
                  diameter = 2.0f * rounded_up * q.radius(branch.longest[i]);
      inside[i] = diameter * diameter - (x * x + y * y + z * z);
    }
    std::size_t count = 0;
    for (std::uint32_t hits = not_negative(inside); hits != 0; hits &= hits - 1) {
      const std::uint32_t link = branch.link[static_cast<std::size_t>(std::countr_zero(hits))];
      if ((link & leaf_bit) != 0) {
        prefetch(leaves_[link & ~leaf_bit]);
      } else {
        prefetch(branches_[link]);
      }
      links[count++] = link;
    }
    return count;
  }

  // Their order in the leaves.
  template <typename Reach>
  std::vector<std::uint32_t> pack_all(const Reach& reach) {
    std::vector<std::uint32_t> order(size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      order[i] = i;
      Node& node = nodes_[i];
      node.reach = reach(i);
      node.longest.store(node.reach, std::memory_order_relaxed);
      for (auto& child : node.child) child.store(none, std::memory_order_relaxed);
    }
    root_.store(none, std::memory_order_release);
    branches_.clear();
    leaves_.clear();
    packed_root_ = order.empty() ? none : pack(order).link;
    return order;
  }

  // Packs points, at least one.
  Part pack(std::span<std::uint32_t> points) {
    Part part;
    for (const std::uint32_t i : points) {
      extend(part, nodes_[i].position);
      part.longest = std::max(part.longest, nodes_[i].reach);
    }
    if (points.size() <= width) {
      part.link = static_cast<std::uint32_t>(leaves_.size()) | leaf_bit;
      Leaf leaf;
      for (std::size_t i = 0; i < width; ++i) {
        const bool there = i < points.size();
        const V3f p = there ? nodes_[points[i]].position : V3f(nowhere);
        for (std::size_t axis = 0; axis < 3; ++axis)
          leaf.position[axis][i] = p[static_cast<int>(axis)];
        leaf.reach[i] = there ? nodes_[points[i]].reach : 0.0f;
        leaf.index[i] = there ? points[i] : none;
      }
      leaves_.push_back(leaf);
      return part;
    }
    part.link = static_cast<std::uint32_t>(branches_.size());
    branches_.emplace_back();
    // As few parts as hold all points at the next level: leaves are nearly full.
    std::size_t room = width;
    while (room * width < points.size()) room *= width;
    std::array<std::span<std::uint32_t>, width> parts;
    divide(points, parts.data(), (points.size() + room - 1) / room);
    for (std::size_t i = 0; i < width; ++i) {
      const Part child = parts[i].empty() ? Part() : pack(parts[i]);
      Branch& branch = branches_[part.link];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float low = child.low[static_cast<int>(axis)],
                    high = child.high[static_cast<int>(axis)];
        const float center = low <= high ? 0.5f * (low + high) : 0.0f;
        branch.center[axis][i] = center;
        branch.half[axis][i] = std::max(high - center, center - low) * rounded_up;
      }
      branch.longest[i] = child.longest;
      branch.link[i] = child.link;
    }
    return part;
  }

  static void extend(Part& part, const V3f& position) {
    for (int axis = 0; axis < 3; ++axis) {
      part.low[axis] = std::min(part.low[axis], position[axis]);
      part.high[axis] = std::max(part.high[axis], position[axis]);
    }
  }

  // Sorts points into so many parts of the same size, along the longest sides of their boxes.
  void divide(std::span<std::uint32_t> points, std::span<std::uint32_t>* parts,
              std::size_t count) const {
    if (count == 1) {
      *parts = points;
      return;
    }
    Part box;
    for (const std::uint32_t i : points) extend(box, nodes_[i].position);
    const V3f size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t lower = count / 2, border = points.size() * lower / count;
    const auto key = [&](std::uint32_t i) { return nodes_[i].position[axis]; };
    std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(border),
                     points.end(), [&](std::uint32_t a, std::uint32_t b) {
                       return key(a) != key(b) ? key(a) < key(b) : a < b;
                     });
    divide(points.first(border), parts, lower);
    divide(points.subspan(border), parts + lower, count - lower);
  }

  StableArray<Node> nodes_;
  std::atomic<std::uint32_t> root_{none};  // of the points since the last rebuild
  std::uint32_t packed_root_ = none;
  std::vector<Branch, LargePageAllocator<Branch>> branches_;
  std::vector<Leaf, LargePageAllocator<Leaf>> leaves_;
};

}  // namespace lumivec
