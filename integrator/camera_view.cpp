#include "integrator/camera_view.h"

#include <cassert>
#include <cmath>
#include <limits>

namespace lumivec {

CameraView::CameraView(const Camera& camera, const TracedScene& scene, int width, int height)
    : kind_(camera.kind),
      near_(camera.znear),
      far_(camera.zfar),
      width_(static_cast<float>(width)),
      height_(static_cast<float>(height)) {
  const M44d& m = camera.camera_to_world;
  const V3d back = V3d(m[2][0], m[2][1], m[2][2]).normalized();
  const V3d right = V3d(m[1][0], m[1][1], m[1][2]).cross(back).normalized();
  // A mirrored camera keeps its mirrored picture.
  const double mirror = right.dot(V3d(m[0][0], m[0][1], m[0][2])) < 0.0 ? -1.0 : 1.0;
  position_ = V3f(V3d(m[3][0], m[3][1], m[3][2]) - scene.origin());
  right_ = V3f(right * mirror);
  up_ = V3f(back.cross(right));
  forward_ = V3f(-back);
  const float aspect = width_ / height_;
  if (is_wide(camera)) {
    lens_.emplace(camera, aspect);
    half_height_ = 0.5f * height_ * static_cast<float>(lens_->pixel_height(height));
    half_width_ = half_height_ * aspect;
  } else if (kind_ == CameraKind::perspective) {
    half_height_ = std::tan(0.5f * camera.yfov);
    half_width_ = half_height_ * aspect;
  } else {
    half_height_ = camera.ymag;
    half_width_ = camera.ymag * aspect;
  }
}

CameraRay CameraView::ray(float x, float y) const {
  if (lens_) return wide_ray(x, y);
  const float sx = (2.0f * x / width_ - 1.0f) * half_width_;
  const float sy = (1.0f - 2.0f * y / height_) * half_height_;
  CameraRay ray;
  if (kind_ == CameraKind::perspective) {
    const V3f d = forward_ + right_ * sx + up_ * sy;
    const float length = d.length();
    ray.origin = position_;
    ray.direction = d * (1.0f / length);
    ray.near = near_ * length;
    ray.far = far_ * length;
  } else {
    ray.origin = position_ + right_ * sx + up_ * sy;
    ray.direction = forward_;
    ray.near = near_;
    ray.far = far_;
  }
  return ray;
}

CameraRay CameraView::wide_ray(float x, float y) const {
  const V2d at(double(x) / double(width_) - 0.5, 0.5 - double(y) / double(height_));
  CameraRay ray;
  ray.origin = position_;
  ray.direction = forward_;
  ray.near = near_;
  ray.far = far_;
  V3d seen;
  ray.black = !lens_->direction(at, seen);
  if (!ray.black) {
    const V3f d(seen);
    ray.direction = (right_ * d.x + up_ * d.y - forward_ * d.z).normalized();
  }
  return ray;
}

PictureRays CameraView::rays() const {
  assert(!lens_);
  const V3f x = right_ * (2.0f * half_width_ / width_), y = up_ * (-2.0f * half_height_ / height_);
  const V3f corner = up_ * half_height_ - right_ * half_width_;
  PictureRays rays;
  rays.near = near_;
  rays.far = far_;
  const bool perspective = kind_ == CameraKind::perspective;
  const V3f none(0.0f);
  rays.origin = perspective ? position_ : position_ + corner;
  rays.origin_x = perspective ? none : x;
  rays.origin_y = perspective ? none : y;
  rays.direction = perspective ? forward_ + corner : forward_;
  rays.direction_x = perspective ? x : none;
  rays.direction_y = perspective ? y : none;
  return rays;
}

PicturePlane CameraView::plane() const {
  assert(!lens_);
  PicturePlane plane;
  plane.eye = position_;
  plane.forward = forward_;
  plane.x_axis = right_ * (0.5f * width_ / half_width_);
  plane.y_axis = up_ * (-0.5f * height_ / half_height_);
  plane.center = V2f(0.5f * width_, 0.5f * height_);
  plane.perspective = kind_ == CameraKind::perspective;
  return plane;
}

float CameraView::footprint(float distance) const {
  const float pixel = 2.0f * half_height_ / height_;
  return kind_ == CameraKind::orthographic ? pixel : pixel * distance;
}

float CameraView::visible_distance(const V3f& p, float distance) const {
  const float z = depth(p);
  return distance * (z - near_) / z;
}

bool CameraView::project(const V3f& p, V2f& pixel, V3f& to_eye, float& distance,
                         float& importance) const {
  const V3f offset = p - position_;
  if (lens_) return project_wide(offset, pixel, to_eye, distance, importance);
  const float z = offset.dot(forward_);
  if (!(z > 0.0f) || z < near_ || z > far_) return false;
  const bool perspective = kind_ == CameraKind::perspective;
  const float scale = perspective ? 1.0f / z : 1.0f;
  const float sx = offset.dot(right_) * scale / half_width_,
              sy = offset.dot(up_) * scale / half_height_;
  if (!(std::abs(sx) < 1.0f && std::abs(sy) < 1.0f)) return false;
  pixel = V2f((sx + 1.0f) * 0.5f * width_, (1.0f - sy) * 0.5f * height_);
  const float pixel_area = 4.0f * half_width_ * half_height_ / (width_ * height_);
  if (perspective) {
    distance = offset.length();
    to_eye = offset * (-1.0f / distance);
    // A pixel's area at unit depth seen from p: dA cos³θ / (dω z²-normalised); W_e cosθ / d² = 1 /
    // (A cos³θ d²).
    const float cosine = z / distance;
    importance = 1.0f / (pixel_area * cosine * cosine * cosine * distance * distance);
  } else {
    distance = z;
    to_eye = -forward_;
    importance = 1.0f / pixel_area;
  }
  return true;
}

bool CameraView::project_wide(const V3f& offset, V2f& pixel, V3f& to_eye, float& distance,
                              float& importance) const {
  distance = offset.length();
  if (!(distance > 0.0f) || distance < near_ || distance > far_) return false;
  const V3d direction = V3d(offset.dot(right_), offset.dot(up_), -offset.dot(forward_)) /
                        static_cast<double>(distance);
  V2d at;
  if (!lens_->project(direction, at)) return false;
  pixel = V2f(V2d((at.x + 0.5) * double(width_), (0.5 - at.y) * double(height_)));
  to_eye = offset * (-1.0f / distance);
  // All that a pixel receives comes from its solid angle.
  const double solid_angle = lens_->solid_angle(at) / (double(width_) * double(height_));
  if (!(solid_angle > 0.0)) return false;
  importance = static_cast<float>(1.0 / (solid_angle * double(distance) * double(distance)));
  return std::isfinite(importance);
}

}  // namespace lumivec
