// Moves the eye by what the mouse and the held keys do. Knows no window: places are shares of the
// picture's height.
#pragma once

#include <array>

#include "viewer/window/orbit_camera.h"

namespace lumivec {

class Navigator {
 public:
  enum class Drag : std::uint8_t { none, orbit, pan, dolly, look };
  enum Held : std::uint8_t { forward, back, left, right, up, down, held_count };

  // The speed of flying: a scene's half diagonal takes four seconds.
  void set_scale(double scene_radius);

  void begin_drag(Drag drag, double x, double y);
  void drag_to(double x, double y, OrbitCamera& camera);
  void end_drag() { drag_ = Drag::none; }
  Drag drag() const { return drag_; }

  void wheel(double steps, OrbitCamera& camera) const;

  void hold(Held key, bool held) { held_[key] = held; }
  void let_go() { held_ = {}; }
  bool flying() const;
  // seconds: since the last call while flying; factor: of the speed.
  void fly(double seconds, double factor, OrbitCamera& camera) const;

 private:
  Drag drag_ = Drag::none;
  double last_x_ = 0.0, last_y_ = 0.0;
  std::array<bool, held_count> held_{};
  double speed_ = 1.0;  // scene units a second
};

}  // namespace lumivec
