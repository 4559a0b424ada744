// A camera made ready to shoot rays through pixels, in traced space.
#pragma once

#include <optional>

#include "integrator/settings.h"
#include "integrator/traced_scene.h"
#include "integrator/wide_lens.h"
#include "loader/scene.h"

namespace lumivec {

struct CameraRay {
  V3f origin;                     // traced space
  V3f direction;                  // unit
  float near = 0.0f, far = 0.0f;  // distances along the ray between which the eye sees
  bool black = false;  // the picture ends before this pixel: round ones do not fill theirs
};

// The rays through a picture, for loops over its pixels: the one through the point (x, y), pixels
// from the upper left corner, starts at origin + x · origin_x + y · origin_y, traced space, and
// goes along direction + x · direction_x + y · direction_y, of length one along the view axis.
struct PictureRays {
  V3f origin, origin_x, origin_y;
  V3f direction, direction_x, direction_y;
  float near = 0.0f, far = 0.0f;  // along the view axis

  V3f point(float x, float y, float depth) const {
    return origin + origin_x * x + origin_y * y +
           (direction + direction_x * x + direction_y * y) * depth;
  }
};

// And back: with v = p − eye and depth = v · forward, p is seen at x = (v · x_axis) / w + center.x,
// likewise y, where w is the depth for perspective cameras and one for others.
struct PicturePlane {
  V3f eye, x_axis, y_axis, forward;
  V2f center;  // pixels
  bool perspective = true;
};

class CameraView {
 public:
  // The vertical field of view is the camera's, the horizontal one follows from the picture's
  // shape.
  CameraView(const Camera& camera, const TracedScene& scene, int width, int height);

  // Through the point (x, y) of the picture, pixels from its upper left corner.
  CameraRay ray(float x, float y) const;

  // Of flat views alone: perspective and orthographic ones.
  PictureRays rays() const;
  PicturePlane plane() const;

  // Distance of a traced-space point along the view axis; of wide views: from the eye.
  float depth(const V3f& p) const {
    return lens_ ? (p - position_).length() : (p - position_).dot(forward_);
  }

  // Size of a pixel in the middle of the picture at a distance from the eye, scene units.
  float footprint(float distance) const;

  // How much of the distance from p to the eye must be free for the eye to see it: all but what
  // lies before znear.
  float visible_distance(const V3f& p, float distance) const;

  // Where the eye sees p. False: behind the eye or outside the picture. importance: what a path
  // from the light that is connected to the eye is weighted by, pixel⁻¹ (W_e · |cosθ| / distance²,
  // over a picture of pixels of area one).
  bool project(const V3f& p, V2f& pixel, V3f& to_eye, float& distance, float& importance) const;

 private:
  CameraRay wide_ray(float x, float y) const;
  bool project_wide(const V3f& offset, V2f& pixel, V3f& to_eye, float& distance,
                    float& importance) const;

  CameraKind kind_;
  std::optional<WideLens> lens_;
  V3f position_, right_, up_, forward_;
  float half_width_ = 0.0f, half_height_ = 0.0f;  // at unit distance; orthographic: scene units
  float near_ = 0.0f, far_ = 0.0f;
  float width_ = 0.0f, height_ = 0.0f;  // pixels
};

}  // namespace lumivec
