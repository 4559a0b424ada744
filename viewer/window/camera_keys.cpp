#include "viewer/window/camera_keys.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numbers>

#include "viewer/json_text.h"
#include "viewer/walk/camera_path.h"

namespace lumivec {
namespace {

// A place on the view axis, as far away as the pivot.
V3d target_of(const OrbitCamera& camera) {
  const double along = (camera.pivot() - camera.eye()).dot(camera.forward());
  return camera.eye() + camera.forward() * (along > 0.0 ? along : 1.0);
}

}  // namespace

std::string camera_keys_text(const std::vector<OrbitCamera>& keys) {
  const auto list = [](const V3d& v) { return nlohmann::json{v.x, v.y, v.z}; };
  nlohmann::json entries = nlohmann::json::array();
  for (const OrbitCamera& key : keys) {
    entries.push_back({{"eye", list(key.eye())},
                       {"target", list(target_of(key))},
                       {"up", list(key.up())},
                       {"yfov", double(key.camera().yfov) * 180.0 / std::numbers::pi}});
  }
  return json_text({{"keys", entries}});
}

OrbitCamera camera_between(const std::vector<OrbitCamera>& keys, double place) {
  const double last = double(keys.size() - 1);
  const double at = std::clamp(place, 0.0, last);
  const auto i = std::min(std::size_t(at), keys.size() - 1);
  const OrbitCamera& a = keys[i];
  const OrbitCamera& b = keys[std::min(i + 1, keys.size() - 1)];
  const double t = at - double(i);
  const auto between = [t](const V3d& from, const V3d& to) { return from + (to - from) * t; };
  const V3d eye = between(a.eye(), b.eye()), target = between(target_of(a), target_of(b));
  const V3d up = between(a.up(), b.up());
  OrbitCamera result = a;
  if (!((target - eye).normalized().cross(up.normalized()).length() > 1e-6)) return result;
  Camera camera = look_from(a.camera(), eye, target, up);
  camera.yfov = float(double(a.camera().yfov) * (1.0 - t) + double(b.camera().yfov) * t);
  result.take(camera, between(a.pivot(), b.pivot()));
  return result;
}

}  // namespace lumivec
