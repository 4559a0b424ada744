#include "viewer/window/navigator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lumivec {
namespace {

constexpr double orbit_angle = std::numbers::pi;       // of a drag over the picture's height
constexpr double look_angle = 0.5 * std::numbers::pi;  // likewise
constexpr double dolly_steps = 12.0;                   // likewise
constexpr double crossing_seconds = 4.0;               // of half the scene
// Longer ones are pauses of the program and not flights.
constexpr double longest_step = 0.25;  // seconds

}  // namespace

void Navigator::set_scale(double scene_radius) {
  if (std::isfinite(scene_radius) && scene_radius > 0.0) speed_ = scene_radius / crossing_seconds;
}

void Navigator::begin_drag(Drag drag, double x, double y) {
  drag_ = drag;
  last_x_ = x;
  last_y_ = y;
}

void Navigator::drag_to(double x, double y, OrbitCamera& camera) {
  const double right_way = x - last_x_, down_way = y - last_y_;
  last_x_ = x;
  last_y_ = y;
  switch (drag_) {
    case Drag::none:
      break;
    case Drag::orbit:  // the scene turns with the mouse
      camera.orbit(-right_way * orbit_angle, down_way * orbit_angle);
      break;
    case Drag::pan:
      camera.pan(-right_way, down_way);
      break;
    case Drag::dolly:
      camera.dolly(-down_way * dolly_steps);
      break;
    case Drag::look:
      camera.look(right_way * look_angle, -down_way * look_angle);
      break;
  }
}

void Navigator::wheel(double steps, OrbitCamera& camera) const {
  camera.dolly(steps);
}

bool Navigator::flying() const {
  return std::find(held_.begin(), held_.end(), true) != held_.end();
}

void Navigator::fly(double seconds, double factor, OrbitCamera& camera) const {
  const auto way = [this](Held plus, Held minus) {
    return double(held_[plus]) - double(held_[minus]);
  };
  const V3d direction(way(right, left), way(up, down), way(forward, back));
  if (direction.length() == 0.0) return;
  camera.fly(direction.normalized() * (speed_ * factor * std::clamp(seconds, 0.0, longest_step)));
}

}  // namespace lumivec
