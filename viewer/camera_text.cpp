#include "viewer/camera_text.h"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "viewer/errors.h"
#include "viewer/option_values.h"
#include "viewer/suggestion.h"
#include "viewer/text_format.h"
#include "viewer/walk/camera_path.h"

namespace lumivec {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr double farthest = 1e12;    // coordinates, scene units
constexpr double least_sine = 1e-6;  // between the view axis and up

V3d row(const M44d& m, int i) {
  return {m[i][0], m[i][1], m[i][2]};
}

// The shortest text that reads back as the same number.
std::string number_text(double value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return std::string(digits.data(), end);
}
std::string number_text(float value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return std::string(digits.data(), end);
}

std::string vector_text(const V3d& v) {
  return number_text(v.x) + "," + number_text(v.y) + "," + number_text(v.z);
}

V3d parse_vector(const std::string& option, const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  if (parts.size() != 3)
    throw UsageError(option + ": '" + text + "' is not a place; give three numbers, such as 0,1,2");
  V3d v;
  for (int i = 0; i < 3; ++i)
    v[i] = parse_number(option, parts[std::size_t(i)], -farthest, farthest);
  return v;
}

}  // namespace

bool is_camera_text(const std::string& text) {
  return text.starts_with("eye=") || text.find("/eye=") != std::string::npos;
}

std::string camera_text(const Camera& camera, const V3d& target) {
  const V3d eye = row(camera.camera_to_world, 3);
  const V3d forward = -row(camera.camera_to_world, 2).normalized();
  double distance = (target - eye).dot(forward);
  if (!(distance > 0.0)) distance = 1.0;
  std::string text = "eye=" + vector_text(eye) + "/target=" + vector_text(eye + forward * distance);
  const V3d up = row(camera.camera_to_world, 1).normalized();
  text += "/up=" + vector_text(up);
  if (camera.kind == CameraKind::orthographic) return text + "/ymag=" + number_text(camera.ymag);
  return text + "/yfov=" + number_text(float(double(camera.yfov) / degree));
}

Camera parse_camera_text(const std::string& option, const std::string& text, const Camera& usual) {
  std::optional<V3d> eye, target;
  V3d up(0.0, 1.0, 0.0);
  Camera camera = usual;
  for (const std::string& part : split(text, '/')) {
    const auto [name, value] = parse_pair(option, part);
    if (name == "eye") {
      eye = parse_vector(option, value);
    } else if (name == "target") {
      target = parse_vector(option, value);
    } else if (name == "up") {
      up = parse_vector(option, value);
    } else if (name == "yfov") {
      constexpr double least = 0.01, most = 179.0;
      camera.kind = CameraKind::perspective;
      camera.yfov = float(parse_number(option, value, least, most) * degree);
    } else if (name == "ymag") {
      camera.kind = CameraKind::orthographic;
      // As wide as before for its height; the given camera may be a perspective without either.
      const auto ymag = float(parse_number(option, value, 1.0 / farthest, farthest));
      const float ratio = camera.xmag / camera.ymag;
      camera.xmag = ymag * (std::isfinite(ratio) && ratio > 0.0f ? ratio : 1.0f);
      camera.ymag = ymag;
    } else {
      throw UsageError(option + ": there is no '" + name + "' in a view; " +
                       suggestion(name, {"eye", "target", "up", "yfov", "ymag"}));
    }
  }
  if (!eye || !target) {
    throw UsageError(option + ": a view needs an eye and a target; write " +
                     "eye=X,Y,Z/target=X,Y,Z");
  }
  const V3d forward = (*target - *eye).normalized();
  if (!(forward.cross(up.normalized()).length() > least_sine))
    throw UsageError(option + ": eye, target and up lie on one line; move one of them");
  camera.name.clear();
  camera.node = -1;
  return look_from(camera, *eye, *target, up);
}

}  // namespace lumivec
