// Insides of shapes, and surfaces that others cut: intersections, differences, clipped_by.
//
// Surfaces without an exact form (exact_solids.h) are cut as triangles.
#pragma once

#include <ImathBox.h>

#include <optional>
#include <vector>

#include "loader/pov/curves.h"
#include "loader/pov/pov_scene.h"

namespace lumivec::pov {

// Below 0 inside, above 0 outside, in the shape's own space; none: the shape has no inside.
// outline: of prisms and lathes, as outline_of gives it.
std::optional<double> shape_field(const Shape& shape, const V3d& point,
                                  const std::vector<Curve>& outline);
std::vector<Curve> outline_of(const Shape& shape);

// An object as its inside, with what is needed to ask many points.
struct Inside {
  Inside(std::shared_ptr<const Object> of, const M44d& around);

  // In the space that the object stands in, times around.
  bool contains(const V3d& point) const;

  std::shared_ptr<const Object> object;
  M44d to_object;
  std::vector<Curve> outline;  // of prisms and lathes
  std::vector<Inside> parts;   // of combinations
  std::vector<Inside> clips;
};

// An object that keeps only what is inside, or outside, of it.
class Clip {
 public:
  // around: from the space that the object stands in to the scene's.
  Clip(std::shared_ptr<const Object> object, const M44d& around, bool inside);

  bool keeps(const V3d& point) const { return solid_.contains(point) == inside_; }
  // Of what is not all kept or all dropped; in the scene's coordinates.
  const Imath::Box3d& bounds() const { return bounds_; }
  bool inside() const { return inside_; }
  const Object& object() const { return *solid_.object; }
  const M44d& around() const { return around_; }

 private:
  Inside solid_;
  M44d around_;
  Imath::Box3d bounds_;
  bool inside_;
};

// Shared by all that they cut.
using Clips = std::vector<std::shared_ptr<const Clip>>;

// The part of a shape's surface that all clips keep, in the scene's coordinates. None: the shape
// has no surface that can be had. region: a box that it is known to lie in, in the scene's
// coordinates. reach, focus: as for tessellate; what is near the focus is cut finer.
std::optional<Mesh> solid_surface(const Shape& shape, const M44d& to_scene, const Clips& clips,
                                  Imath::Box3d region, double reach, const V3d& focus);

// Of a shape that only shape_field describes, within the box, in its own space.
Mesh level_set_mesh(const Shape& shape, const Imath::Box3d& box);

}  // namespace lumivec::pov
