#include "loader/pov/bounds.h"

#include <algorithm>
#include <cmath>

#include "loader/pov/exact_shapes.h"

namespace lumivec::pov {
namespace {

using Imath::Box3d;

Box3d everything() {
  return {V3d(-beyond_all), V3d(beyond_all)};
}

Box3d around(const V3d& center, const V3d& half) {
  return {center - half, center + half};
}

// Half the box of a disc of radius 1 that looks along the normal.
V3d disc_reach(const V3d& normal) {
  V3d reach;
  for (int i = 0; i < 3; ++i) reach[i] = std::sqrt(std::max(0.0, 1.0 - normal[i] * normal[i]));
  return reach;
}

Box3d transformed(const Box3d& box, const M44d& m) {
  Box3d result;
  if (box.isEmpty()) return result;
  for (int corner = 0; corner < 8; ++corner) {
    result.extendBy(V3d(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                        corner & 4 ? box.max.z : box.min.z) *
                    m);
  }
  return overlap(result, everything());
}

template <class Points>
Box3d of_points(const Points& points) {
  Box3d box;
  for (const V3d& point : points) box.extendBy(point);
  return box;
}

struct ShapeBounds {
  Box3d operator()(const SphereShape& s) const { return around(s.center, V3d(std::abs(s.radius))); }
  Box3d operator()(const BoxShape& b) const {
    Box3d box;
    box.extendBy(b.low);
    box.extendBy(b.high);
    return box;
  }
  Box3d operator()(const PlaneShape&) const { return everything(); }
  Box3d operator()(const ConeShape& c) const {
    const V3d axis = c.cap - c.base;
    const V3d reach = axis.length() > 0.0 ? disc_reach(axis.normalized()) : V3d(1.0);
    Box3d box = around(c.base, reach * std::abs(c.base_radius));
    box.extendBy(around(c.cap, reach * std::abs(c.cap_radius)));
    return box;
  }
  Box3d operator()(const TorusShape& t) const {
    const double reach = std::abs(t.major) + std::abs(t.minor);
    return around(V3d(0.0), V3d(reach, std::abs(t.minor), reach));
  }
  Box3d operator()(const DiscShape& d) const {
    return around(d.center, disc_reach(d.normal) * std::abs(d.radius));
  }
  Box3d operator()(const std::shared_ptr<const TriangleShape>& t) const {
    return of_points(t->corners);
  }
  Box3d operator()(const std::shared_ptr<const PolygonShape>& p) const {
    return of_points(p->points);
  }
  Box3d operator()(const std::shared_ptr<const MeshShape>& m) const { return m->bounds; }
  // Ellipsoids and cylinders along the axes end; what else there is may not.
  Box3d operator()(const std::shared_ptr<const QuadricShape>& q) const {
    Box3d box = everything();
    const bool upright = q->mixed == V3d(0.0) && q->linear == V3d(0.0) && q->constant < 0.0;
    for (int i = 0; i < 3; ++i) {
      if (!upright || q->squares[0] < 0.0 || q->squares[1] < 0.0 || q->squares[2] < 0.0) break;
      if (q->squares[i] == 0.0) continue;
      box.max[i] = std::sqrt(-q->constant / q->squares[i]);
      box.min[i] = -box.max[i];
    }
    return box;
  }
  Box3d operator()(const std::shared_ptr<const PolyShape>&) const { return everything(); }
  Box3d operator()(const SuperellipsoidShape&) const { return around(V3d(0.0), V3d(1.0)); }
  Box3d operator()(const std::shared_ptr<const BlobShape>& blob) const {
    Box3d box;
    for (const BlobShape::Component& part : blob->components) {
      Box3d one = around(part.center, V3d(std::abs(part.radius)));
      if (part.cylinder) one.extendBy(around(part.cap, V3d(std::abs(part.radius))));
      box.extendBy(transformed(one, part.transform));
    }
    return box;
  }
  Box3d operator()(const std::shared_ptr<const HeightFieldShape>&) const {
    return {V3d(0.0), V3d(1.0)};
  }
  Box3d operator()(const std::shared_ptr<const PrismShape>& p) const { return pov::bounds_of(*p); }
  Box3d operator()(const std::shared_ptr<const LatheShape>& l) const { return pov::bounds_of(*l); }
  Box3d operator()(const std::shared_ptr<const SorShape>& s) const { return pov::bounds_of(*s); }
  Box3d operator()(const std::shared_ptr<const SphereSweepShape>& s) const {
    return pov::bounds_of(*s);
  }
  Box3d operator()(const std::shared_ptr<const BicubicPatchShape>& p) const {
    return of_points(p->points);
  }
  Box3d operator()(const std::shared_ptr<const TextShape>& t) const { return t->bounds; }
  Box3d operator()(const std::shared_ptr<const IsosurfaceShape>& s) const {
    if (s->sphere) return around(s->low, V3d(s->radius));
    Box3d box;
    box.extendBy(s->low);
    box.extendBy(s->high);
    return box;
  }
  Box3d operator()(const std::shared_ptr<const ParametricShape>&) const { return {}; }
  Box3d operator()(const JuliaShape&) const { return around(V3d(0.0), V3d(2.0)); }
  Box3d operator()(const std::shared_ptr<const CombinedShape>& c) const { return c->bounds; }
  Box3d operator()(const std::shared_ptr<const LightSource>&) const { return {}; }
};

}  // namespace

Box3d overlap(const Box3d& a, const Box3d& b) {
  Box3d box;
  for (int i = 0; i < 3; ++i) {
    box.min[i] = std::max(a.min[i], b.min[i]);
    box.max[i] = std::min(a.max[i], b.max[i]);
  }
  return box;
}

Box3d bounds_of(const Object& object) {
  Box3d box = std::visit(ShapeBounds(), object.shape);
  if (object.inverse) box = everything();
  if (object.transform) box = transformed(box, *object.transform);
  if (object.extras) {
    for (const auto& bound : object.extras->bounded_by) box = overlap(box, bounds_of(*bound));
    for (const auto& clip : object.extras->clipped_by) {
      box = overlap(box, bounds_of(*clip));
    }
  }
  return box;
}

Box3d bounds_of_parts(const CombinedShape& combined) {
  Box3d box;
  if (combined.combination == Combination::difference)
    return combined.parts.empty() ? box : bounds_of(*combined.parts.front());
  const bool all = combined.combination == Combination::intersection;
  if (all) box = everything();
  for (const auto& part : combined.parts) {
    const Box3d one = bounds_of(*part);
    if (!all) {
      box.extendBy(one);
    } else {
      box = overlap(box, one);
    }
  }
  return box;
}

}  // namespace lumivec::pov
