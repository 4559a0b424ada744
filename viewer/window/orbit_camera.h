// The eye of the window: turned, moved and placed by steps, each of which does the same however
// many frames it is spread over. Nothing goes on by itself, and no orientation is special: what is
// kept is three axes and not angles.
#pragma once

#include <ImathBox.h>

#include "loader/scene.h"

namespace lumivec {

// The six sides that a scene is looked at from.
enum class ViewAxis : std::uint8_t {
  positive_x,
  negative_x,
  positive_y,
  negative_y,
  positive_z,
  negative_z
};

class OrbitCamera {
 public:
  OrbitCamera();

  // camera: what the next steps start from; its clipping planes and field of view stay.
  void take(const Camera& camera, const V3d& pivot);
  const Camera& camera() const { return camera_; }

  // What the eye turns around, world space. Setting it moves nothing.
  const V3d& pivot() const { return pivot_; }
  void set_pivot(const V3d& pivot) { pivot_ = pivot; }

  // Around the pivot, radians: the eye goes to the right (about the world's +Y) and up.
  void orbit(double right, double up);
  // The eye stays and looks to the right and up, radians.
  void look(double right, double up);
  // About the view axis, radians, clockwise.
  void roll(double angle);
  // The horizon is level again.
  void level();
  // The eye and the pivot go along the picture, in its heights at the pivot's distance.
  void pan(double right, double up);
  // Toward the pivot, which stays where it is in the picture: the distance shrinks to
  // dolly_step^steps of itself. A parallel view shrinks likewise.
  void dolly(double steps);
  // Along the eye's axes (right, up, forward), scene units; the pivot comes along.
  void fly(const V3d& way);

  // From a side of the world at the same distance, the pivot in the middle, upright; from above and
  // below, -Z and +Z are up.
  void look_from_axis(ViewAxis axis);
  // All of bounds in sight, in the middle, from where the eye looks now. aspect: width / height of
  // the picture.
  void frame(const Imath::Box3d& bounds, double aspect);
  // From there to the pivot; world up where that makes sense.
  double distance() const;

  V3d eye() const;
  V3d right() const;
  V3d up() const;
  V3d forward() const;

  static constexpr double dolly_step = 0.9;

 private:
  void place(const V3d& eye, const V3d& right, const V3d& up);
  void turn(const V3d& center, const V3d& axis, double angle);

  Camera camera_;
  V3d pivot_{0.0};
};

}  // namespace lumivec
