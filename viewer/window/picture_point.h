// Where the eye sees a point of the world, and what point it sees.
#pragma once

#include <cmath>
#include <optional>

#include "loader/scene.h"

namespace lumivec {

// The point at a depth along the view axis, seen at (x, y), pixels from the upper left corner of a
// picture of that size; world space.
inline V3d point_seen(const Camera& camera, int width, int height, double x, double y,
                      double depth) {
  const M44d& m = camera.camera_to_world;
  const V3d back = V3d(m[2][0], m[2][1], m[2][2]).normalized();
  const V3d right = V3d(m[1][0], m[1][1], m[1][2]).cross(back).normalized();
  const V3d up = back.cross(right);
  const bool flat = camera.kind == CameraKind::orthographic;
  const double half = flat ? double(camera.ymag) : depth * std::tan(0.5 * double(camera.yfov));
  const double sx = (2.0 * x / width - 1.0) * half * width / height;
  const double sy = (1.0 - 2.0 * y / height) * half;
  return V3d(m[3][0], m[3][1], m[3][2]) + right * sx + up * sy - back * depth;
}

struct SeenAt {
  double x = 0.0, y = 0.0;  // pixels from the upper left corner
  double depth = 0.0;       // along the view axis
};

// Where point_seen() is `point`, inside the picture or not; none: behind the eye.
inline std::optional<SeenAt> seen_at(const Camera& camera, int width, int height,
                                     const V3d& point) {
  const M44d& m = camera.camera_to_world;
  const V3d back = V3d(m[2][0], m[2][1], m[2][2]).normalized();
  const V3d right = V3d(m[1][0], m[1][1], m[1][2]).cross(back).normalized();
  const V3d up = back.cross(right);
  const V3d d = point - V3d(m[3][0], m[3][1], m[3][2]);
  const double depth = -d.dot(back);
  const bool flat = camera.kind == CameraKind::orthographic;
  if (!flat && !(depth > 0.0)) return std::nullopt;
  const double half = flat ? double(camera.ymag) : depth * std::tan(0.5 * double(camera.yfov));
  return SeenAt{0.5 * width * (1.0 + d.dot(right) * height / (half * width)),
                0.5 * height * (1.0 - d.dot(up) / half), depth};
}

}  // namespace lumivec
