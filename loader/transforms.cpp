#include "loader/transforms.h"

#include <cmath>

namespace lumivec {
namespace {

V3d row(const M44d& m, int i) {
  return {m[i][0], m[i][1], m[i][2]};
}

double length(const V3d& v) {
  return std::hypot(v.x, v.y, v.z);
}

}  // namespace

bool is_finite(const M44d& m) {
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      if (!std::isfinite(m[i][j])) return false;
    }
  }
  return true;
}

double determinant3(const M44d& m) {
  return row(m, 0).dot(row(m, 1).cross(row(m, 2)));
}

bool is_invertible(const M44d& m) {
  if (!is_finite(m)) return false;
  constexpr double smallest = 1e-100;  // squares and cubes of lengths between these stay in range
  constexpr double largest = 1e100;
  M44d unit = m;
  for (int i = 0; i < 3; ++i) {
    const double l = length(row(m, i));
    if (!(l > smallest && l < largest)) return false;
    for (int j = 0; j < 3; ++j) unit[i][j] /= l;
  }
  // The volume of the parallelepiped of the unit axes: the sine of the angle at which they become
  // one plane.
  constexpr double flattest = 1e-12;
  return std::abs(determinant3(unit)) > flattest;
}

M44d compose(const V3d& translation, const V4d& rotation, const V3d& scale) {
  const double l = std::hypot(std::hypot(rotation.x, rotation.y), rotation.z, rotation.w);
  const double x = rotation.x / l;
  const double y = rotation.y / l;
  const double z = rotation.z / l;
  const double w = rotation.w / l;
  const double r[3][3] = {
      {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
      {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
      {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)},
  };
  M44d m;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) m[i][j] = scale[i] * r[i][j];
    m[3][i] = translation[i];
  }
  return m;
}

M44d world_transform(const Node& node, const std::vector<Node>& nodes) {
  if (node.parent < 0) return node.local_to_parent;
  return node.local_to_parent * nodes[static_cast<std::size_t>(node.parent)].local_to_world;
}

std::optional<M44d> rigid_part(const M44d& m) {
  if (!is_finite(m)) return std::nullopt;
  V3d z = row(m, 2);
  V3d y = row(m, 1);
  const double z_length = length(z);
  const double y_length = length(y);
  if (!(z_length > 0.0) || !(y_length > 0.0)) return std::nullopt;
  z /= z_length;
  y /= y_length;
  y -= z * z.dot(y);
  const double rest = length(y);
  constexpr double parallel = 1e-9;  // sine of the angle between the axes
  if (!(rest > parallel)) return std::nullopt;
  y /= rest;
  const V3d x = y.cross(z);
  return M44d(x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, m[3][0], m[3][1], m[3][2], 1);
}

}  // namespace lumivec
