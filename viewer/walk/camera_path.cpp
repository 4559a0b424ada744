#include "viewer/walk/camera_path.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <numbers>

#include "viewer/errors.h"
#include "viewer/option_values.h"

namespace lumivec {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
constexpr std::uintmax_t most_bytes = 16u << 20;  // of a file
constexpr double farthest = 1e12;                 // coordinates, scene units

struct Key {
  V3d eye{0.0}, target{0.0}, up{0.0, 1.0, 0.0};
  double yfov = 0.0;  // radians
};

V3d row(const M44d& m, int i) {
  return {m[i][0], m[i][1], m[i][2]};
}

// Turned about +Y through the pivot.
Camera turned(const Camera& camera, const V3d& pivot, double angle) {
  M44d to_pivot, turn, back;
  to_pivot.setTranslation(-pivot);
  turn.setAxisAngle(V3d(0, 1, 0), angle);
  back.setTranslation(pivot);
  Camera result = camera;
  result.camera_to_world = camera.camera_to_world * to_pivot * turn * back;
  return result;
}

class KeyReader {
 public:
  KeyReader(const std::filesystem::path& file, const Camera& camera)
      : file_(file), camera_(camera) {}

  std::vector<Key> read() const {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file_, error);
    if (error) fail("cannot be read: " + error.message());
    if (size > most_bytes) fail("is larger than 16 MiB; a camera path is a short list of keys");
    std::ifstream in(file_, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
    if (json.is_discarded()) fail("is not JSON; see lumivec help walk");
    if (!json.is_object() || !json.contains("keys") || !json["keys"].is_array() ||
        json["keys"].empty()) {
      fail("has no list \"keys\"; see lumivec help walk");
    }
    std::vector<Key> keys;
    for (const nlohmann::json& key : json["keys"])
      keys.push_back(read_key(key, "/keys/" + std::to_string(keys.size())));
    return keys;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw CommandError(file_.string() + ": " + what);
  }

  V3d vector(const nlohmann::json& key, const std::string& name, const std::string& where) const {
    const std::string place = where + "/" + name;
    if (!key.contains(name)) fail(place + ": is missing; give three numbers");
    const nlohmann::json& v = key[name];
    if (!v.is_array() || v.size() != 3) fail(place + ": is not a list of three numbers");
    V3d result;
    for (int i = 0; i < 3; ++i) {
      const nlohmann::json& number = v[std::size_t(i)];
      if (!number.is_number() || !(std::abs(number.get<double>()) <= farthest))
        fail(place + ": holds something that is not a number up to 1e12");
      result[i] = number.get<double>();
    }
    return result;
  }

  Key read_key(const nlohmann::json& from, const std::string& where) const {
    if (!from.is_object()) fail(where + ": is not an object; give it \"eye\" and \"target\"");
    Key key;
    key.eye = vector(from, "eye", where);
    key.target = vector(from, "target", where);
    if (from.contains("up")) key.up = vector(from, "up", where);
    key.yfov = double(camera_.yfov);
    if (from.contains("yfov")) {
      if (!from["yfov"].is_number()) fail(where + "/yfov: is not a number of degrees");
      const double degrees = from["yfov"].get<double>();
      if (!(degrees > 0.0 && degrees < 180.0)) fail(where + "/yfov: must lie between 0 and 180");
      key.yfov = degrees * degree;
    }
    if (!((key.target - key.eye).cross(key.up).length() > 0.0))
      fail(where + ": eye, target and up lie on one line; move one of them");
    return key;
  }

  const std::filesystem::path& file_;
  const Camera& camera_;
};

}  // namespace

CameraPathChoice parse_camera_path(const std::string& option, const std::string& text) {
  CameraPathChoice choice;
  constexpr double most_degrees = 36000.0;
  if (text.starts_with("orbit:")) {
    choice.amount = parse_number(option, text.substr(6), -most_degrees, most_degrees);
  } else if (text.starts_with("dolly:")) {
    choice.kind = CameraPathChoice::Kind::dolly;
    choice.amount = parse_number(option, text.substr(6), -farthest, farthest);
  } else if (text == "orbit" || text == "dolly") {
    throw UsageError(option + ": " + text + " needs an amount; write " + text + ":10");
  } else {
    choice.kind = CameraPathChoice::Kind::file;
    choice.file = text;
  }
  return choice;
}

Camera look_from(const Camera& camera, const V3d& eye, const V3d& target, const V3d& up) {
  const V3d back = (eye - target).normalized();
  const V3d right = up.cross(back).normalized();
  const V3d above = back.cross(right);
  Camera result = camera;
  result.camera_to_world = M44d(right.x, right.y, right.z, 0, above.x, above.y, above.z, 0, back.x,
                                back.y, back.z, 0, eye.x, eye.y, eye.z, 1);
  return result;
}

std::vector<Camera> camera_path(const CameraPathChoice& choice, const Camera& camera,
                                const V3d& pivot, int frames) {
  std::vector<Camera> path;
  const auto share = [frames](int frame) {
    return frames > 1 ? static_cast<double>(frame) / (frames - 1) : 0.0;
  };
  std::vector<Key> keys;
  if (choice.kind == CameraPathChoice::Kind::file) keys = KeyReader(choice.file, camera).read();
  for (int frame = 0; frame < frames; ++frame) {
    if (choice.kind == CameraPathChoice::Kind::orbit) {
      path.push_back(turned(camera, pivot, choice.amount * degree * share(frame)));
    } else if (choice.kind == CameraPathChoice::Kind::dolly) {
      Camera moved = camera;
      const V3d forward = -row(camera.camera_to_world, 2).normalized();
      M44d step;
      step.setTranslation(forward * (choice.amount * share(frame)));
      moved.camera_to_world = camera.camera_to_world * step;
      path.push_back(moved);
    } else {
      const double at = share(frame) * static_cast<double>(keys.size() - 1);
      const auto i = std::min(static_cast<std::size_t>(at), keys.size() - 1);
      const Key& a = keys[i];
      const Key& b = keys[std::min(i + 1, keys.size() - 1)];
      const double t = at - static_cast<double>(i);
      const auto between = [t](const V3d& from, const V3d& to) { return from + (to - from) * t; };
      const V3d eye = between(a.eye, b.eye), target = between(a.target, b.target);
      const V3d up = between(a.up, b.up);
      if (!((target - eye).cross(up).length() > 0.0)) {
        throw CommandError(choice.file.string() + ": /keys/" + std::to_string(i) +
                           ": on the way to the next key the view is upside down; add a key");
      }
      Camera view = look_from(camera, eye, target, up);
      view.yfov = static_cast<float>(a.yfov + (b.yfov - a.yfov) * t);
      path.push_back(view);
    }
  }
  return path;
}

}  // namespace lumivec
