// Blobs: where densities of points and stretches of lines add up to more than a threshold.
//
// Along a line each component's density is a polynomial of degree 4 in up to three stretches of it.
// Between the ends of all of these the sum is one polynomial, whose roots are the crossings; it is
// taken about the middle of each piece, so that far components do not blur near ones. Costs, for n
// components that the line meets, n log n and the sum of how many meet each piece.
#include <algorithm>
#include <cmath>

#include "integrator/polynomial_roots.h"
#include "integrator/solid_shapes.h"

namespace lumivec {
namespace {

using Imath::Box3d;

// From where a component's distance is counted.
enum class Around : std::uint8_t { base, axis, cap };

// A component's density in a stretch of the line.
struct Influence {
  int component = 0;
  Around around = Around::base;
  Stretch stretch;
};

Line to_component(const BlobComponent& component, const Line& line) {
  Line result;
  result.origin = line.origin * component.to_component;
  component.to_component.multDirMatrix(line.direction, result.direction);
  return result;
}

// Relative to what the distance is counted from; the axis has no height.
Line relative(const BlobComponent& component, Line line, Around around) {
  if (around == Around::cap) line.origin.y -= component.length;
  if (around == Around::axis) line.origin.y = line.direction.y = 0.0;
  return line;
}

// Where a + 2bt + ct² < 1 about the place where it is least.
Stretch within_one(const Line& line) {
  const double c = line.direction.length2();
  if (c == 0.0) return line.origin.length2() < 1.0 ? Stretch() : Stretch{1.0, -1.0};
  const double middle = -line.origin.dot(line.direction) / c;
  const double half2 = (1.0 - (line.origin + line.direction * middle).length2()) / c;
  if (!(half2 > 0.0)) return {1.0, -1.0};
  const double half = std::sqrt(half2);
  return {middle - half, middle + half};
}

struct Walk {
  struct End {
    double t;
    int influence;
    bool begins;
  };
  std::vector<Influence> influences;
  std::vector<End> ends;
  std::vector<int> active;    // influences
  std::vector<int> place_of;  // of each influence among the active ones
};

void add_influences(const SolidLeaf& blob, const Line& line, int index, double start, double stop,
                    std::vector<Influence>& out) {
  const BlobComponent& component = blob.components[std::size_t(index)];
  const Line own = to_component(component, line);
  const auto add = [&](Around around, double low, double high) {
    Stretch stretch = within_one(relative(component, own, around));
    stretch.cut(own.origin.y, own.direction.y, low, high);
    stretch.first = std::max(stretch.first, start);
    stretch.last = std::min(stretch.last, stop);
    if (stretch.first < stretch.last) out.push_back({index, around, stretch});
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (component.length == 0.0) return add(Around::base, -infinity, infinity);
  add(Around::base, -infinity, 0.0);
  add(Around::axis, 0.0, component.length);
  add(Around::cap, component.length, infinity);
}

// threshold less the density, for -1 ≤ x ≤ 1 from low to high.
Polynomial left_of_threshold(const SolidLeaf& blob, const Line& line, const Walk& walk, double low,
                             double high) {
  const double middle = 0.5 * (low + high), half = 0.5 * (high - low);
  Polynomial sum;
  sum.degree = walk.active.empty() ? 0 : 4;
  sum.c[0] = blob.threshold;
  for (const int index : walk.active) {
    const Influence& influence = walk.influences[std::size_t(index)];
    const BlobComponent& component = blob.components[std::size_t(influence.component)];
    const Line own = relative(component, to_component(component, line), influence.around);
    const V3d o = own.origin + own.direction * middle, d = own.direction * half;
    // strength · (e0 + e1 x + e2 x²)²
    const double e0 = 1.0 - o.length2(), e1 = -2.0 * o.dot(d), e2 = -d.length2();
    const double k = component.strength;
    sum.c[0] -= k * e0 * e0;
    sum.c[1] -= k * 2.0 * e0 * e1;
    sum.c[2] -= k * (e1 * e1 + 2.0 * e0 * e2);
    sum.c[3] -= k * 2.0 * e1 * e2;
    sum.c[4] -= k * e2 * e2;
  }
  return sum;
}

}  // namespace

std::vector<Box3d> blob_boxes(const SolidLeaf& blob) {
  std::vector<Box3d> boxes;
  for (const BlobComponent& component : blob.components) {
    const M44d to_blob = component.to_component.inverse();
    // Of a unit sphere: its reach along each axis is the length of that column.
    V3d reach;
    for (int i = 0; i < 3; ++i)
      reach[i] = V3d(to_blob[0][i], to_blob[1][i], to_blob[2][i]).length();
    Box3d box;
    for (const double y : {0.0, component.length}) {
      const V3d center = V3d(0.0, y, 0.0) * to_blob;
      box.extendBy(center - reach);
      box.extendBy(center + reach);
    }
    boxes.push_back(box);
  }
  return boxes;
}

void blob_crossings(const SolidLeaf& blob, const ElementTree& elements, const Line& line,
                    double start, double stop, Crossings& out) {
  thread_local Walk walk;
  walk.influences.clear();
  walk.ends.clear();
  walk.active.clear();
  elements.along(line, start, stop, [&](int index) {
    add_influences(blob, line, index, start, stop, walk.influences);
  });
  walk.place_of.resize(walk.influences.size());
  for (std::size_t i = 0; i < walk.influences.size(); ++i) {
    const Stretch& stretch = walk.influences[i].stretch;
    walk.ends.push_back({stretch.first, static_cast<int>(i), true});
    walk.ends.push_back({stretch.last, static_cast<int>(i), false});
  }
  std::sort(walk.ends.begin(), walk.ends.end(),
            [](const Walk::End& a, const Walk::End& b) { return a.t < b.t; });
  bool inside = false;
  double before = start;
  const auto see = [&](double t, bool now) {
    if (now == inside) return;
    inside = now;
    if (t <= start) {
      out.inside_at_start = now;
    } else {
      out.add(t);
    }
  };
  for (std::size_t i = 0; i < walk.ends.size(); ++i) {
    const Walk::End& end = walk.ends[i];
    if (end.t > before) {
      const Polynomial left = left_of_threshold(blob, line, walk, before, end.t);
      see(before, left(-1.0) < 0.0);
      const double middle = 0.5 * (before + end.t), half = 0.5 * (end.t - before);
      const Roots roots = roots_between(left, -1.0, 1.0);
      for (int k = 0; k < roots.count; ++k)
        see(std::min(middle + half * roots.x[std::size_t(k)], end.t), !inside);
      see(end.t, left(1.0) < 0.0);
      before = end.t;
    }
    const auto influence = std::size_t(end.influence);
    if (end.begins) {
      walk.place_of[influence] = static_cast<int>(walk.active.size());
      walk.active.push_back(end.influence);
    } else {
      const int place = walk.place_of[influence], last = walk.active.back();
      walk.active[std::size_t(place)] = last;
      walk.place_of[std::size_t(last)] = place;
      walk.active.pop_back();
    }
  }
  // Beyond all components nothing is dense.
  if (before < stop) see(before, false);
}

V3d blob_outward(const SolidLeaf& blob, const ElementTree& elements, const Line& line, double t) {
  V3d outward(0.0);
  const V3d point = line.origin + line.direction * t;
  elements.along(line, t, t, [&](int index) {
    const BlobComponent& component = blob.components[std::size_t(index)];
    V3d from = point * component.to_component;
    from.y -= std::clamp(from.y, 0.0, component.length);
    const double left = 1.0 - from.length2();
    if (left <= 0.0) return;
    const V3d falling = from * (4.0 * component.strength * left);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) outward[i] += component.to_component[i][j] * falling[j];
    }
  });
  return outward;
}

}  // namespace lumivec
