// A k-d tree of points that each reach so far: which of them reach a given place? Points are
// inserted while others look, and look-ups never block (method, section 3: the first three of the
// cache's five dimensions).
//
// Every node holds a point and splits space at it, along x, y and z in turn (Bentley 1975), and
// knows the longest reach below it, which prunes the search. A look-up among 100,000 points takes
// well under a microsecond once the tree is balanced; 32 bytes a point.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <vector>

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
    node.reach.store(reach, std::memory_order_relaxed);
    node.longest.store(reach, std::memory_order_relaxed);
    node.child[0].store(none, std::memory_order_relaxed);
    node.child[1].store(none, std::memory_order_relaxed);
    prepare(index);
    link(root_, index, 0);
    return index;
  }
  std::uint32_t insert(const V3f& position, float reach) {
    return insert(position, reach, [](std::uint32_t) {});
  }

  std::uint32_t size() const { return nodes_.size(); }
  const V3f& position(std::uint32_t index) const { return nodes_[index].position; }
  float reach(std::uint32_t index) const {
    return nodes_[index].reach.load(std::memory_order_relaxed);
  }

  // Calls visit(index, squared distance) for every point whose reach times scale covers p, in an
  // order that depends on the tree alone.
  template <typename Visit>
  void for_each_reaching(const V3f& p, float scale, const Visit& visit) const {
    constexpr int max_stack = 128;
    std::uint32_t stack[max_stack];
    std::uint8_t axes[max_stack];
    int top = 0;
    std::uint32_t current = root_.load(std::memory_order_acquire);
    std::uint8_t axis = 0;
    while (true) {
      while (current != none) {
        const Node& node = nodes_[current];
        const float longest = node.longest.load(std::memory_order_relaxed) * scale;
        const float off = p[axis] - node.position[axis];
        const float distance2 = (p - node.position).length2();
        const float own = node.reach.load(std::memory_order_relaxed) * scale;
        if (distance2 <= own * own) visit(current, distance2);
        const int near = off < 0.0f ? 0 : 1;
        const auto next = static_cast<std::uint8_t>(axis == 2 ? 0 : axis + 1);
        if (std::abs(off) <= longest) {
          const std::uint32_t far = node.child[1 - near].load(std::memory_order_acquire);
          // A tree so deep that the stack is full is degenerate; the far side is then walked at
          // once.
          if (far != none) {
            if (top < max_stack) {
              stack[top] = far;
              axes[top++] = next;
            } else {
              walk(far, next, p, scale, visit);
            }
          }
        }
        current = node.child[near].load(std::memory_order_acquire);
        axis = next;
      }
      if (top == 0) return;
      current = stack[--top];
      axis = axes[top];
    }
  }

  // Changes reaches and makes the tree as shallow as can be. reach(index) gives the new ones. Not
  // while others use the tree.
  template <typename Reach>
  void rebuild(const Reach& reach) {
    std::vector<std::uint32_t> order(size());
    for (std::uint32_t i = 0; i < order.size(); ++i) {
      order[i] = i;
      nodes_[i].reach.store(reach(i), std::memory_order_relaxed);
    }
    root_.store(build(order.data(), order.data() + order.size(), 0), std::memory_order_release);
  }

  // Not while others use the tree.
  void clear() {
    nodes_.clear();
    root_.store(none, std::memory_order_release);
  }

 private:
  static constexpr std::uint32_t none = ~0u;

  struct Node {
    V3f position{0.0f};
    std::atomic<float> reach{0.0f};
    std::atomic<float> longest{0.0f};  // reach in the subtree of this node
    std::atomic<std::uint32_t> child[2] = {none, none};
  };

  void link(std::atomic<std::uint32_t>& root, std::uint32_t index, int axis) {
    const Node& added = nodes_[index];
    const float reach = added.reach.load(std::memory_order_relaxed);
    std::atomic<std::uint32_t>* slot = &root;
    while (true) {
      std::uint32_t found = slot->load(std::memory_order_acquire);
      if (found == none && slot->compare_exchange_strong(found, index, std::memory_order_acq_rel)) {
        return;
      }
      Node& node = nodes_[found];
      float longest = node.longest.load(std::memory_order_relaxed);
      while (longest < reach && !node.longest.compare_exchange_weak(longest, reach)) {
      }
      slot = &node.child[added.position[axis] < node.position[axis] ? 0 : 1];
      axis = axis == 2 ? 0 : axis + 1;
    }
  }

  template <typename Visit>
  void walk(std::uint32_t index, std::uint8_t axis, const V3f& p, float scale,
            const Visit& visit) const {
    if (index == none) return;
    const Node& node = nodes_[index];
    const float own = node.reach.load(std::memory_order_relaxed) * scale;
    const float distance2 = (p - node.position).length2();
    if (distance2 <= own * own) visit(index, distance2);
    const float off = p[axis] - node.position[axis];
    const float longest = node.longest.load(std::memory_order_relaxed) * scale;
    const auto next = static_cast<std::uint8_t>(axis == 2 ? 0 : axis + 1);
    for (int side = 0; side < 2; ++side) {
      const bool near = (off < 0.0f ? 0 : 1) == side;
      if (near || std::abs(off) <= longest)
        walk(node.child[side].load(std::memory_order_acquire), next, p, scale, visit);
    }
  }

  std::uint32_t build(std::uint32_t* begin, std::uint32_t* end, int axis) {
    if (begin == end) return none;
    std::uint32_t* middle = begin + (end - begin) / 2;
    const auto key = [&](std::uint32_t i) { return nodes_[i].position[axis]; };
    std::nth_element(begin, middle, end, [&](std::uint32_t a, std::uint32_t b) {
      return key(a) != key(b) ? key(a) < key(b) : a < b;
    });
    const int next = axis == 2 ? 0 : axis + 1;
    const std::uint32_t index = *middle;
    // Points at the plane itself may be on either side here, while insertions put them on the upper
    // one: look-ups visit both sides of a plane they touch, so that either is found.
    const std::uint32_t low = build(begin, middle, next), high = build(middle + 1, end, next);
    Node& node = nodes_[index];
    node.child[0].store(low, std::memory_order_relaxed);
    node.child[1].store(high, std::memory_order_relaxed);
    float longest = node.reach.load(std::memory_order_relaxed);
    for (const std::uint32_t child : {low, high}) {
      if (child == none) continue;
      longest = std::max(longest, nodes_[child].longest.load(std::memory_order_relaxed));
    }
    node.longest.store(longest, std::memory_order_relaxed);
    return index;
  }

  StableArray<Node> nodes_;
  std::atomic<std::uint32_t> root_{none};
};

}  // namespace lumivec
