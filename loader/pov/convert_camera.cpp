#include <algorithm>
#include <cmath>
#include <numbers>

#include "loader/pov/bounds.h"
#include "loader/pov/conversion.h"
#include "loader/pov/finiteness.h"

namespace lumivec::pov {
namespace {

bool is_finite(const Imath::Box3d& box) {
  constexpr double largest = 1e5;  // of what a scene shows; beyond lie its ground and sky
  return !box.isEmpty() && box.size().length() < largest;
}

// What the scene's cameras have no kind for.
bool is_known(const PovCamera& camera) {
  const bool still = camera.cylinder_type == 1 || camera.cylinder_type == 2;
  return camera.type != CameraType::omnimax && (camera.type != CameraType::cylinder || still);
}

// Cameras with pictures that are no plane's. Their lengths of right, up and direction are those of
// the picture at which a perspective camera would look, in its distances.
void set_wide_lens(const PovCamera& camera, Camera& out) {
  constexpr double degree = std::numbers::pi / 180.0;
  const double width = camera.right.length(), height = camera.up.length();
  const auto angle = [&](double usual = 90.0) {
    return degree * (camera.angle > 0.0 ? camera.angle : usual);
  };
  switch (camera.type) {
    case CameraType::fisheye:
      out.kind = CameraKind::fisheye;
      out.xangle = static_cast<float>(angle());
      out.yangle = static_cast<float>(angle() * height);
      return;
    case CameraType::spherical:
      out.kind = CameraKind::spherical;
      out.xangle = static_cast<float>(angle(360.0));
      out.yangle = camera.vertical_angle > 0.0 ? static_cast<float>(degree * camera.vertical_angle)
                                               : 0.5f * out.xangle;
      return;
    case CameraType::ultra_wide_angle:
      out.kind = CameraKind::ultra_wide;
      out.xangle = static_cast<float>(angle());
      out.yangle = static_cast<float>(angle() * height / width);
      return;
    case CameraType::panoramic: {
      const double distance = camera.direction.length();
      out.kind = CameraKind::panoramic;
      out.xmag = static_cast<float>(0.5 * width / distance);
      out.ymag = static_cast<float>(0.5 * height / distance);
      return;
    }
    default:
      out.kind =
          camera.cylinder_type == 1 ? CameraKind::upright_cylinder : CameraKind::lying_cylinder;
      out.xangle = out.yangle = static_cast<float>(angle());
      out.xmag = static_cast<float>(0.5 * width);
      out.ymag = static_cast<float>(0.5 * height);
      return;
  }
}

// The angle of a perspective view that stands for one of another kind, as far as it can.
double perspective_height(const PovCamera& camera) {
  const double height = camera.up.length(), distance = camera.direction.length();
  if (camera.type == CameraType::perspective) return height / distance;
  constexpr double widest = 110.0;  // degrees
  const double angle = std::min(camera.angle > 0.0 ? camera.angle : 90.0, widest);
  return 2.0 * std::tan(angle / 2.0 * std::numbers::pi / 180.0) * height / camera.right.length();
}

}  // namespace

void survey(Conversion& conversion) {
  Imath::Box3d all;
  for (const auto& object : conversion.scene.objects) {
    const Imath::Box3d box = bounds_of(*object);
    if (is_finite(box)) all.extendBy(box);
  }
  const PovCamera& camera = *conversion.scene.camera;
  if (camera.right.dot(camera.up.cross(camera.direction)) > 0.0)
    conversion.to_world.setScale(V3d(1.0, 1.0, -1.0));
  const V3d forward = camera.direction.normalized();
  double distance = camera.location.length();
  if (!all.isEmpty()) {
    conversion.extent = std::max(all.size().length() / 2.0, 1e-6);
    distance = (all.center() - camera.location).dot(forward);
  }
  conversion.focus = camera.location + forward * std::max(distance, 1e-6);
  constexpr double horizon = 1000.0;  // times what is near: where infinite shapes end
  conversion.reach = horizon * std::max({conversion.extent, camera.location.length(),
                                         all.isEmpty() ? 1.0 : all.center().length()});
}

void convert_camera(Conversion& conversion) {
  const PovCamera& camera = *conversion.scene.camera;
  Parser& parser = conversion.parser;
  const double width = camera.right.length(), height = camera.up.length();
  const V3d* vectors[] = {&camera.location, &camera.direction, &camera.right, &camera.up};
  if (!std::all_of(std::begin(vectors), std::end(vectors),
                   [](const V3d* v) { return fits_float(*v); }))
    parser.fail_at(camera.place, "a vector of the camera is not finite or too large");
  if (!(width > 0.0 && height > 0.0 && camera.direction.length() > 0.0))
    parser.fail_at(camera.place, "the camera's right, up or direction has no length");
  V3d forward, up;
  conversion.to_world.multDirMatrix(camera.direction.normalized(), forward);
  conversion.to_world.multDirMatrix(camera.up.normalized(), up);
  constexpr double skew = 1e-3;
  if (std::abs(forward.dot(up)) > skew)
    parser.mention(
        camera.place,
        "the camera's up is not at a right angle to its direction, and is turned to one");
  const V3d back = -forward;
  V3d right = up.cross(back);
  if (right.length() < 1e-9)
    parser.fail_at(camera.place, "the camera's up points along its direction");
  right.normalize();
  up = back.cross(right);
  const V3d eye = camera.location * conversion.to_world;
  Camera out;
  out.camera_to_world = M44d(right.x, right.y, right.z, 0, up.x, up.y, up.z, 0, back.x, back.y,
                             back.z, 0, eye.x, eye.y, eye.z, 1);
  out.aspect = static_cast<float>(width / height);
  if (camera.type == CameraType::orthographic) {
    out.kind = CameraKind::orthographic;
    out.xmag = static_cast<float>(width / 2.0);
    out.ymag = static_cast<float>(height / 2.0);
  } else {
    if (!is_known(camera)) {
      parser.mention(
          camera.place,
          std::string(camera.type == CameraType::omnimax ? "the omnimax" : "the moving cylinder") +
              " camera is taken for a perspective one");
    } else if (camera.type != CameraType::perspective) {
      set_wide_lens(camera, out);
    }
    out.yfov = static_cast<float>(2.0 * std::atan(0.5 * perspective_height(camera)));
  }
  const bool sized = fits_float(out.yfov) && fits_float(out.xangle) && fits_float(out.yangle) &&
                     fits_float(out.xmag) && fits_float(out.ymag);
  if (!fits_float(eye) || !(out.aspect > 0.0f && fits_float(out.aspect)) || !sized)
    parser.fail_at(camera.place, "the camera's size is not finite or too large");
  if (camera.aperture > 0.0) parser.mention(camera.place, "focal blur is left out");
  conversion.out.cameras.push_back(out);
}

}  // namespace lumivec::pov
