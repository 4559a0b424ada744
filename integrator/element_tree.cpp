#include "integrator/element_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lumivec {
namespace {

using Imath::Box3d;

// Boxes grow by this share of their size and place, so that no rounding loses what touches them.
constexpr double box_margin = 1e-9;
constexpr int most_elements = 2;  // of one node

}  // namespace

bool clip_to(const Box3d& box, const Line& line, double& near, double& far) {
  for (int i = 0; i < 3; ++i) {
    if (line.direction[i] == 0.0) {
      if (line.origin[i] < box.min[i] || line.origin[i] > box.max[i]) return false;
      continue;
    }
    const double a = (box.min[i] - line.origin[i]) / line.direction[i];
    const double b = (box.max[i] - line.origin[i]) / line.direction[i];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near <= far;
}

ElementTree::ElementTree(const std::vector<Box3d>& boxes) {
  elements_.resize(boxes.size());
  std::iota(elements_.begin(), elements_.end(), 0);
  if (!boxes.empty()) build(boxes, 0, static_cast<int>(boxes.size()));
}

void ElementTree::build(const std::vector<Box3d>& boxes, int first, int last) {
  const auto at = nodes_.size();
  nodes_.emplace_back();
  Box3d box, centers;
  for (int i = first; i < last; ++i) {
    const Box3d& one = boxes[std::size_t(elements_[std::size_t(i)])];
    box.extendBy(one);
    centers.extendBy(one.center());
  }
  const double size = box.size().length();
  for (int i = 0; i < 3; ++i) {
    const double margin =
        box_margin * (size + std::max(std::abs(box.min[i]), std::abs(box.max[i])));
    box.min[i] -= margin;
    box.max[i] += margin;
  }
  nodes_[at].box = box;
  if (last - first <= most_elements) {
    nodes_[at].first = first;
    nodes_[at].count = last - first;
  } else {
    const auto axis = static_cast<int>(centers.majorAxis());
    const int middle = (first + last) / 2;
    std::nth_element(elements_.begin() + first, elements_.begin() + middle,
                     elements_.begin() + last, [&](int a, int b) {
                       return boxes[std::size_t(a)].center()[axis] <
                              boxes[std::size_t(b)].center()[axis];
                     });
    build(boxes, first, middle);
    build(boxes, middle, last);
  }
  nodes_[at].end = static_cast<int>(nodes_.size());
}

}  // namespace lumivec
