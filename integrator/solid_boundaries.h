// Where a ray passes the surface of a combination of primitives (constructive solid geometry).
//
// The crossings of all primitives are walked in order along the ray; each changes whether its
// primitive is inside, and that is passed up the tree as far as it changes anything. Where the
// first root changes is the solid's surface. Costs one test of each primitive whose bounds the ray
// meets, and the sorting of their crossings.
#pragma once

#include <optional>

#include "integrator/solid_leaf.h"
#include "loader/scene.h"

namespace lumivec {

// A solid placed in traced space. Points to the Solid, which must outlive it.
class TracedSolid {
 public:
  // object_to_traced must be invertible.
  TracedSolid(const Solid& solid, int part, const M44d& object_to_traced);

  const Imath::Box3d& bounds() const { return bounds_; }  // traced space, not empty

  struct Boundary {
    double t = 0.0;
    int leaf = -1;
  };
  // The first boundary of this part in near < t ≤ far, in units of the direction.
  std::optional<Boundary> first_boundary(const Line& ray, double near, double far) const;

  // Whether a point is in the solid, apart from the further roots that only cut its surface.
  bool contains(const V3d& point) const;

  // The surface of a primitive where the ray passes it at about t: the point, and the solid's
  // outward direction, unit, or 0 where it has none.
  struct Place {
    V3d point{0.0};
    V3d outward{0.0};
  };
  Place place(int leaf, const Line& ray, double t) const;

 private:
  struct Leaf {
    M44d to_leaf;  // from traced space
    ElementTree elements;
    int node = -1;
    bool inside_out = false;  // the solid is where the primitive is not
  };

  Line line_of(const Leaf& leaf, const Line& ray) const;

  const Solid* solid_;
  int part_;
  Imath::Box3d bounds_;
  std::vector<Leaf> leaves_;
  std::vector<Imath::Box3d> node_bounds_;  // traced space
  std::vector<int> children_;              // of each node
};

}  // namespace lumivec
