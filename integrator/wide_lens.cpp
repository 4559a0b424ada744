#include "integrator/wide_lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lumivec {
namespace {

constexpr double pi = std::numbers::pi;

}  // namespace

bool is_wide(const Camera& camera) {
  return camera.kind != CameraKind::perspective && camera.kind != CameraKind::orthographic;
}

const char* camera_kind_name(CameraKind kind) {
  switch (kind) {
    case CameraKind::orthographic:
      return "orthographic";
    case CameraKind::fisheye:
      return "fisheye";
    case CameraKind::spherical:
      return "spherical";
    case CameraKind::ultra_wide:
      return "ultra wide";
    case CameraKind::panoramic:
      return "panoramic";
    case CameraKind::upright_cylinder:
      return "upright cylinder";
    case CameraKind::lying_cylinder:
      return "lying cylinder";
    case CameraKind::perspective:
      break;
  }
  return "perspective";
}

Camera flat_camera(const Camera& camera) {
  Camera flat = camera;
  if (is_wide(camera)) flat.kind = CameraKind::perspective;
  return flat;
}

WideLens::WideLens(const Camera& camera, double aspect)
    : kind_(camera.kind),
      xangle_(static_cast<double>(camera.xangle)),
      yangle_(static_cast<double>(camera.yangle)),
      circle_(0.5 * xangle_),
      xsize_(2.0 * static_cast<double>(camera.xmag)),
      ysize_(2.0 * static_cast<double>(camera.ymag)) {
  if (kind_ == CameraKind::fisheye || kind_ == CameraKind::ultra_wide) xangle_ = yangle_ * aspect;
}

bool WideLens::direction(const V2d& at, V3d& direction) const {
  const double a = at.x * xangle_, b = at.y * yangle_;
  switch (kind_) {
    case CameraKind::fisheye: {
      const double angle = std::hypot(a, b);
      if (angle > circle_) return false;
      const double sine = angle > 0.0 ? std::sin(angle) / angle : 1.0;
      direction = V3d(a * sine, b * sine, -std::cos(angle));
      return true;
    }
    case CameraKind::spherical:
      direction = V3d(std::sin(a) * std::cos(b), std::sin(b), -std::cos(a) * std::cos(b));
      return true;
    case CameraKind::ultra_wide:
      direction = V3d(std::sin(a), std::sin(b), -std::cos(a) * std::cos(b));
      break;
    case CameraKind::panoramic:
      direction =
          V3d(xsize_ * std::sin(pi * at.x), ysize_ * std::tan(pi * at.y), -std::cos(pi * at.x));
      break;
    case CameraKind::upright_cylinder:
      direction = V3d(std::sin(a), ysize_ * at.y, -std::cos(a));
      break;
    case CameraKind::lying_cylinder:
      direction = V3d(xsize_ * at.x, std::sin(b), -std::cos(b));
      break;
    default:
      return false;
  }
  direction.normalize();
  return direction.length() > 0.0;
}

bool WideLens::project(const V3d& d, V2d& at) const {
  switch (kind_) {
    case CameraKind::fisheye: {
      const double side = std::hypot(d.x, d.y), angle = std::atan2(side, -d.z);
      if (angle > circle_) return false;
      const double scale = side > 0.0 ? angle / side : 1.0;
      at = V2d(d.x * scale / xangle_, d.y * scale / yangle_);
      break;
    }
    case CameraKind::spherical:
      at = V2d(std::atan2(d.x, -d.z) / xangle_, std::atan2(d.y, std::hypot(d.x, d.z)) / yangle_);
      break;
    case CameraKind::ultra_wide: {
      // The direction is L · (sin a, sin b, -cos a · cos b). That it is unit says
      // L⁴ - L² + x² y² = 0, of whose roots it is the greater near the middle.
      const double product = 4.0 * d.x * d.x * d.y * d.y;
      const double scale = std::sqrt(2.0 / (1.0 + std::sqrt(std::max(0.0, 1.0 - product))));
      const double a = std::asin(std::clamp(d.x * scale, -1.0, 1.0));
      const double b = std::asin(std::clamp(d.y * scale, -1.0, 1.0));
      at = V2d((d.z > 0.0 ? std::copysign(pi, d.x) - a : a) / xangle_, b / yangle_);
      break;
    }
    case CameraKind::panoramic: {
      const double a = std::atan2(d.x / xsize_, -d.z);
      const double length = std::hypot(d.x / xsize_, d.z);
      at = V2d(a / pi, std::atan2(d.y / ysize_, length) / pi);
      break;
    }
    case CameraKind::upright_cylinder:
      at = V2d(std::atan2(d.x, -d.z) / xangle_, d.y / (ysize_ * std::hypot(d.x, d.z)));
      break;
    case CameraKind::lying_cylinder:
      at = V2d(d.x / (xsize_ * std::hypot(d.y, d.z)), std::atan2(d.y, -d.z) / yangle_);
      break;
    default:
      return false;
  }
  return std::abs(at.x) < 0.5 && std::abs(at.y) < 0.5;
}

double WideLens::solid_angle(const V2d& at) const {
  constexpr double step = 1e-4;
  V3d left, right, below, above;
  const V2d x(step, 0.0), y(0.0, step);
  if (!direction(at - x, left) || !direction(at + x, right) || !direction(at - y, below) ||
      !direction(at + y, above))
    return 0.0;
  return (right - left).cross(above - below).length() / (4.0 * step * step);
}

double WideLens::pixel_height(int pixels) const {
  constexpr double step = 1e-4;
  V3d below, above;
  if (!direction(V2d(0.0, -step), below) || !direction(V2d(0.0, step), above)) return 0.0;
  return (above - below).length() / (2.0 * step * pixels);
}

}  // namespace lumivec
