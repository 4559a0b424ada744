#include "loader/pov/rotations.h"

#include <numbers>

namespace lumivec::pov {

M44d rotation_matrix(const V3d& degrees) {
  M44d all;
  for (int i = 0; i < 3; ++i) {
    V3d axis(0.0);
    axis[i] = 1.0;
    if (degrees[i] != 0.0) all = all * axis_rotation_matrix(axis, degrees[i]);
  }
  return all;
}

M44d axis_rotation_matrix(const V3d& axis, double degrees) {
  M44d m;
  if (axis.length() > 0.0) m.setAxisAngle(axis.normalized(), degrees * std::numbers::pi / 180.0);
  return m;
}

}  // namespace lumivec::pov
