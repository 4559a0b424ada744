#include "loader/pov/cameras.h"

#include <cmath>
#include <numbers>

#include "loader/pov/expression.h"
#include "loader/pov/normals.h"
#include "loader/pov/transforms.h"

namespace lumivec::pov {
namespace {

std::optional<CameraType> type_of(K keyword) {
  switch (keyword) {
    case K::perspective_:
      return CameraType::perspective;
    case K::orthographic_:
      return CameraType::orthographic;
    case K::fisheye_:
      return CameraType::fisheye;
    case K::ultra_wide_angle_:
      return CameraType::ultra_wide_angle;
    case K::omnimax_:
      return CameraType::omnimax;
    case K::panoramic_:
      return CameraType::panoramic;
    case K::spherical_:
      return CameraType::spherical;
    case K::cylinder_:
      return CameraType::cylinder;
    default:
      return std::nullopt;
  }
}

// Does it look through a rectangle?
bool is_flat(const PovCamera& camera) {
  return camera.type == CameraType::perspective || camera.type == CameraType::orthographic;
}

// The direction becomes as long as the angle across the width asks.
void set_angle(Parser& parser, PovCamera& camera) {
  camera.angle = parse_float(parser, "angle");
  if (!(camera.angle > 0.0)) parser.fail("the camera's angle must be more than 0");
  skip_comma(parser);
  if (begins_number(parser)) camera.vertical_angle = parse_float(parser, "angle");
  if (!is_flat(camera)) return;
  constexpr double half_turn = 180.0;
  if (camera.angle >= half_turn)
    parser.fail("the angle of a perspective or orthographic camera must be less than 180");
  const double half = camera.angle / 2.0 * std::numbers::pi / half_turn;
  camera.direction = camera.direction.normalized() * (camera.right.length() / 2.0 / std::tan(half));
}

// Turns the camera: up as near to the sky as can be; what is mirrored stays so.
void look_at(PovCamera& camera, const V3d& target) {
  const V3d forward = (target - camera.location).normalized();
  if (forward.length() == 0.0) return;
  V3d right = camera.sky.cross(forward);
  if (right.length() < 1e-9 * camera.sky.length()) {
    right = std::abs(forward.x) < 0.9 ? V3d(1, 0, 0).cross(forward) : V3d(0, 1, 0).cross(forward);
  }
  right.normalize();
  const V3d up = forward.cross(right);
  const bool mirrored = camera.right.dot(camera.up.cross(camera.direction)) < 0.0;
  camera.direction = forward * camera.direction.length();
  camera.right = right * (mirrored ? -camera.right.length() : camera.right.length());
  camera.up = up * camera.up.length();
}

// Orthographic views show as much as perspective ones do at what they look at, unless their size is
// given and no angle.
void set_size(PovCamera& camera, const V3d& target, bool given) {
  if (camera.type != CameraType::orthographic || (given && camera.angle == 0.0)) return;
  const double distance = (target - camera.location).length();
  if (distance == 0.0 || camera.direction.length() == 0.0) return;
  const double factor = distance / camera.direction.length();
  camera.right *= factor;
  camera.up *= factor;
}

void transform_camera(PovCamera& camera, const M44d& m) {
  camera.location = camera.location * m;
  for (V3d* direction : {&camera.direction, &camera.right, &camera.up, &camera.sky}) {
    V3d moved;
    m.multDirMatrix(*direction, moved);
    *direction = moved;
  }
}

bool parse_vector_item(Parser& parser, PovCamera& camera) {
  if (parser.accept(K::location_)) {
    camera.location = parse_vector(parser);
  } else if (parser.accept(K::direction_)) {
    camera.direction = parse_vector(parser);
  } else if (parser.accept(K::right_)) {
    const double before = camera.right.length();
    camera.right = parse_vector(parser);
    // An angle that came first keeps its meaning.
    if (camera.angle > 0.0 && is_flat(camera) && before > 0.0)
      camera.direction *= camera.right.length() / before;
  } else if (parser.accept(K::up_)) {
    camera.up = parse_vector(parser);
  } else if (parser.accept(K::sky_)) {
    camera.sky = parse_vector(parser);
  } else {
    return false;
  }
  return true;
}

// Of focal blur: what says how much, and what says how finely.
bool parse_blur_item(Parser& parser, PovCamera& camera) {
  if (parser.accept(K::aperture_)) {
    camera.aperture = parse_float(parser, "aperture");
  } else if (parser.accept(K::focal_point_)) {
    camera.focal_point = parse_vector(parser);
  } else if (parser.accept(K::blur_samples_)) {
    parse_float(parser, "blur_samples");
    if (parser.accept(',')) parse_float(parser, "blur_samples");
  } else if (parser.accept(K::confidence_) || parser.accept(K::variance_)) {
    parse_float(parser, "a camera");
  } else {
    return false;
  }
  return true;
}

}  // namespace

PovCamera parse_camera_block(Parser& parser) {
  const Nesting nesting(parser);
  PovCamera camera;
  camera.place = parser.place();
  parser.expect('{', "a camera");
  // It is looked at after everything else is known of it, but before it is moved.
  std::optional<V3d> target;
  bool sized = false, turned = false;
  const auto turn = [&] {
    if (!turned) set_size(camera, target.value_or(V3d(0, 0, 1)), sized);
    turned = true;
    if (target) look_at(camera, *target);
    target.reset();
  };
  while (!parser.accept('}')) {
    if (const Slot* slot = parser.meaning(parser.peek());
        slot && (*slot)->kind == ValueKind::camera) {
      camera = (*slot)->as<PovCamera>();
      turned = true;
      parser.take();
    } else if (const auto type = type_of(parser.peek().keyword())) {
      parser.take();
      camera.type = *type;
      if (*type == CameraType::cylinder) camera.cylinder_type = parse_int(parser, "cylinder");
    } else if (parser.at(K::right_) || parser.at(K::up_)) {
      sized = true;
      parse_vector_item(parser, camera);
    } else if (parser.accept(K::look_at_)) {
      target = parse_vector(parser);
    } else if (parser.accept(K::angle_)) {
      set_angle(parser, camera);
    } else if (parser.accept(K::normal_)) {
      parse_normal_block(parser);
      parser.mention(parser.place(), "the normal of a camera is left out");
    } else if (parser.at(K::translate_) || parser.at(K::rotate_) || parser.at(K::scale_) ||
               parser.at(K::matrix_) || parser.at(K::transform_)) {
      turn();
      if (const auto transform = parse_transform(parser)) transform_camera(camera, *transform);
    } else if (!parse_vector_item(parser, camera) && !parse_blur_item(parser, camera) &&
               !parser.accept(',')) {
      parser.fail_expected("a part of a camera");
    }
  }
  turn();
  return camera;
}

}  // namespace lumivec::pov
