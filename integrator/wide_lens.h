// The directions that wide cameras see: those whose picture is no plane's. Scene.h says the
// formulas.
#pragma once

#include "loader/scene.h"

namespace lumivec {

using Imath::V2d;

// Whether a camera's picture is not flat.
bool is_wide(const Camera& camera);

// "fisheye", "ultra wide".
const char* camera_kind_name(CameraKind kind);

// The perspective camera that stands for a wide one; flat ones stay as they are.
Camera flat_camera(const Camera& camera);

// Points of the picture lie between -1/2 and 1/2, x to the right and y up; directions are unit, of
// the camera's own space: to the right, up and back.
class WideLens {
 public:
  // camera: a wide one. aspect: the picture's width by its height, > 0.
  WideLens(const Camera& camera, double aspect);

  // False: nothing is seen there.
  bool direction(const V2d& at, V3d& direction) const;

  // Where the direction is seen; where more than once, next to the middle. False: nowhere.
  bool project(const V3d& direction, V2d& at) const;

  // Steradians by the picture's area, of which there is one.
  double solid_angle(const V2d& at) const;

  // Radians that one of so many pixels, one above the other, takes in the middle.
  double pixel_height(int pixels) const;

 private:
  CameraKind kind_;
  double xangle_, yangle_, circle_, xsize_, ysize_;
};

}  // namespace lumivec
