#include "viewer/window/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lumivec {
namespace {

const V3d world_up(0.0, 1.0, 0.0);
// Nearer to the pivot than this share of the smallest distance that numbers tell apart there, no
// step goes.
constexpr double least_share = 1e-9;
constexpr double least_sine = 1e-6;  // between two directions that are told apart
constexpr double margin = 1.05;      // around what is framed

V3d row(const M44d& m, int i) {
  return {m[i][0], m[i][1], m[i][2]};
}

}  // namespace

OrbitCamera::OrbitCamera() {
  place(V3d(0.0, 0.0, 1.0), V3d(1.0, 0.0, 0.0), world_up);
}

V3d OrbitCamera::eye() const {
  return row(camera_.camera_to_world, 3);
}
V3d OrbitCamera::right() const {
  return row(camera_.camera_to_world, 0);
}
V3d OrbitCamera::up() const {
  return row(camera_.camera_to_world, 1);
}
V3d OrbitCamera::forward() const {
  return -row(camera_.camera_to_world, 2);
}
double OrbitCamera::distance() const {
  return (pivot_ - eye()).length();
}

// right and up are made a right-angled pair of unit length again, so that no error adds up.
void OrbitCamera::place(const V3d& eye, const V3d& right, const V3d& up) {
  const V3d x = right.normalized();
  const V3d z = x.cross(up).normalized();
  const V3d y = z.cross(x);
  camera_.camera_to_world =
      M44d(x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, eye.x, eye.y, eye.z, 1);
}

void OrbitCamera::take(const Camera& camera, const V3d& pivot) {
  camera_ = camera;
  pivot_ = pivot;
  // As rays are shot: the view axis and up count, and a mirrored camera is seen unmirrored.
  const M44d& m = camera.camera_to_world;
  const V3d back = row(m, 2).normalized();
  const V3d x = row(m, 1).cross(back).normalized();
  place(row(m, 3), x, back.cross(x));
}

void OrbitCamera::turn(const V3d& center, const V3d& axis, double angle) {
  M44d rotation;
  rotation.setAxisAngle(axis.normalized(), angle);
  const auto turned = [&](const V3d& v) {
    V3d result;
    rotation.multDirMatrix(v, result);
    return result;
  };
  place(center + turned(eye() - center), turned(right()), turned(up()));
}

// Upside down, the world turns the other way about +Y, so that a drag to the right always moves
// what is in front to the right.
void OrbitCamera::orbit(double right_angle, double up_angle) {
  turn(pivot_, world_up, up().y < 0.0 ? -right_angle : right_angle);
  turn(pivot_, right(), -up_angle);
}

void OrbitCamera::look(double right_angle, double up_angle) {
  turn(eye(), world_up, up().y < 0.0 ? right_angle : -right_angle);
  turn(eye(), right(), up_angle);
}

void OrbitCamera::roll(double angle) {
  turn(eye(), forward(), angle);
}

void OrbitCamera::level() {
  const V3d x = forward().cross(world_up);
  if (x.length() < least_sine) return;  // straight up or down: every horizon is level
  place(eye(), x, x.cross(forward()));
}

void OrbitCamera::pan(double right_share, double up_share) {
  const double depth = std::abs((pivot_ - eye()).dot(forward()));
  const double height = camera_.kind == CameraKind::orthographic
                            ? 2.0 * double(camera_.ymag)
                            : 2.0 * depth * std::tan(0.5 * double(camera_.yfov));
  const V3d way = right() * (right_share * height) + up() * (up_share * height);
  pivot_ += way;
  place(eye() + way, right(), up());
}

void OrbitCamera::dolly(double steps) {
  const double share = std::pow(dolly_step, steps);
  if (camera_.kind == CameraKind::orthographic) {
    constexpr double least = 1e-6, most = 1e12;
    const double ymag = std::clamp(double(camera_.ymag) * share, least, most);
    const double done = ymag / double(camera_.ymag);
    camera_.xmag = float(double(camera_.xmag) * done);
    camera_.ymag = float(ymag);
    // What is at the pivot stays where it is in the picture.
    const V3d offset = pivot_ - eye();
    const V3d aside = offset - forward() * offset.dot(forward());
    place(eye() + aside * (1.0 - done), right(), up());
    return;
  }
  const V3d from_pivot = (eye() - pivot_) * share;
  const double least = least_share * std::max(1.0, pivot_.length());
  if (steps > 0.0 && from_pivot.length() < least) return;
  place(pivot_ + from_pivot, right(), up());
}

void OrbitCamera::fly(const V3d& way) {
  const V3d step = right() * way.x + up() * way.y + forward() * way.z;
  pivot_ += step;
  place(eye() + step, right(), up());
}

void OrbitCamera::look_from_axis(ViewAxis axis) {
  const int which = int(axis) / 2;
  const double sign = int(axis) % 2 == 0 ? 1.0 : -1.0;
  V3d back(0.0);
  back[which] = sign;
  const V3d above = which == 1 ? V3d(0.0, 0.0, -sign) : world_up;
  const double away = distance();
  place(pivot_ + back * away, above.cross(back), above);
}

void OrbitCamera::frame(const Imath::Box3d& bounds, double aspect) {
  if (bounds.isEmpty()) return;
  pivot_ = bounds.center();
  const double radius =
      margin * std::max(0.5 * bounds.size().length(), least_share * (1.0 + pivot_.length()));
  double away = 2.0 * radius;
  if (camera_.kind == CameraKind::orthographic) {
    const double ymag = radius / std::min(1.0, aspect);
    camera_.xmag = float(ymag * aspect);
    camera_.ymag = float(ymag);
  } else {
    const double half_height = std::tan(0.5 * double(camera_.yfov));
    const double half = std::atan(half_height * std::min(1.0, aspect));
    away = radius / std::sin(half);
  }
  if (double(camera_.zfar) < away + radius) camera_.zfar = std::numeric_limits<float>::infinity();
  if (double(camera_.znear) > away - radius) camera_.znear = 0.0f;
  place(pivot_ - forward() * away, right(), up());
}

}  // namespace lumivec
