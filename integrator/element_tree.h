// The elements that a primitive is made of (stretches of a curve, components of a blob), found by
// lines: a tree of bounds in the primitive's own space. Visits about the logarithm of their number
// where the line meets few.
#pragma once

#include <vector>

#include "loader/scene.h"

namespace lumivec {

struct Line {
  V3d origin{0.0};
  V3d direction{0.0};  // of any length but 0
};

// Cuts near and far where the line is outside the box; false: it never is inside.
bool clip_to(const Imath::Box3d& box, const Line& line, double& near, double& far);

class ElementTree {
 public:
  ElementTree() = default;
  // Finite boxes, one for each element.
  explicit ElementTree(const std::vector<Imath::Box3d>& boxes);

  // Calls visit(element) for all whose box the line may meet in near ≤ t ≤ far.
  template <class Visit>
  void along(const Line& line, double near, double far, const Visit& visit) const {
    const int count = static_cast<int>(nodes_.size());
    for (int i = 0; i < count;) {
      const Node& node = nodes_[std::size_t(i)];
      double from = near, to = far;
      if (!clip_to(node.box, line, from, to)) {
        i = node.end;
        continue;
      }
      for (int k = 0; k < node.count; ++k) visit(elements_[std::size_t(node.first + k)]);
      ++i;
    }
  }

 private:
  struct Node {
    Imath::Box3d box;
    int end = 0;    // behind the last node below this one, in preorder
    int first = 0;  // of its own elements
    int count = 0;
  };

  void build(const std::vector<Imath::Box3d>& boxes, int first, int last);

  std::vector<Node> nodes_;
  std::vector<int> elements_;
};

}  // namespace lumivec
