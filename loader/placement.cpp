#include "loader/placement.h"

#include <ImathBoxAlgo.h>

#include "loader/transforms.h"

namespace lumivec {
namespace {

// Squares of coordinates must stay finite in float, in ray tracing kernels too: Embree ignores what
// lies farther out.
constexpr double farthest = 1e18;

bool is_near(const Imath::Box3d& box) {
  for (int i = 0; i < 3; ++i) {
    if (!(box.min[i] > -farthest && box.max[i] < farthest)) return false;
  }
  return true;
}

}  // namespace

Placement placement(const Imath::Box3d& bounds, const M44d& object_to_world) {
  if (!is_invertible(object_to_world)) return Placement::flattened;
  if (bounds.isEmpty()) return Placement::far_away;
  const Imath::Box3d box = Imath::affineTransform(bounds, object_to_world);
  return is_near(box) ? Placement::shown : Placement::far_away;
}

M44d standing_frame(const M44d& node_to_world) {
  if (const auto frame = rigid_part(node_to_world)) return *frame;
  if (!is_finite(node_to_world)) return M44d();
  return M44d().setTranslation(V3d(node_to_world[3][0], node_to_world[3][1], node_to_world[3][2]));
}

}  // namespace lumivec
