#include "loader/gltf/views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "loader/gltf/extensions.h"
#include "loader/placement.h"
#include "loader/transforms.h"

namespace lumivec::gltf {
namespace {

// The clipping planes that a file asks for; ones that leave nothing between them do not clip.
void set_range(Context& context, const std::string& where, double znear, double zfar,
               Camera& camera) {
  if (znear < 0.0 || (zfar != 0.0 && zfar <= znear)) {
    context.warn(where, "znear and zfar leave nothing to see and are left out");
    return;
  }
  camera.znear = to_float(znear);
  if (zfar > 0.0) camera.zfar = to_float(zfar);
}

bool read_perspective(const tinygltf::PerspectiveCamera& source, Camera& camera) {
  camera.yfov = to_float(source.yfov);
  camera.aspect = to_float(std::max(source.aspectRatio, 0.0));
  return camera.yfov > 0.0f && camera.yfov < std::numbers::pi_v<float>;
}

bool read_orthographic(const tinygltf::OrthographicCamera& source, Camera& camera) {
  camera.kind = CameraKind::orthographic;
  camera.xmag = std::abs(to_float(source.xmag));
  camera.ymag = std::abs(to_float(source.ymag));
  if (!(camera.xmag > 0.0f && camera.ymag > 0.0f)) return false;
  const float aspect = camera.xmag / camera.ymag;
  camera.aspect = std::isfinite(aspect) ? aspect : 0.0f;
  return true;
}

}  // namespace

void read_cameras(Context& context, const tinygltf::Model& model, const std::vector<int>& nodes,
                  const std::vector<bool>& moving, Scene& scene) {
  for (const int index : nodes) {
    const tinygltf::Node& node = model.nodes[static_cast<std::size_t>(index)];
    if (node.camera < 0) continue;
    const tinygltf::Camera& source = model.cameras[static_cast<std::size_t>(node.camera)];
    const std::string where = pointer({"cameras", static_cast<std::size_t>(node.camera)});
    Camera camera;
    camera.name = source.name.empty() ? node.name : source.name;
    camera.node = index;
    const M44d& world = scene.nodes[static_cast<std::size_t>(index)].local_to_world;
    const bool stands = moving[static_cast<std::size_t>(index)] || rigid_part(world);
    const bool perspective = source.type == "perspective";
    const bool sees = perspective ? read_perspective(source.perspective, camera)
                                  : read_orthographic(source.orthographic, camera);
    if (!stands || !sees) {
      context.warn(where, "has no field of view or no direction and is left out");
      continue;
    }
    camera.camera_to_world = standing_frame(world);
    if (perspective) {
      set_range(context, where, source.perspective.znear, source.perspective.zfar, camera);
    } else {
      set_range(context, where, source.orthographic.znear, source.orthographic.zfar, camera);
    }
    scene.cameras.push_back(camera);
  }
}

Camera default_camera(const Imath::Box3d& bounds) {
  constexpr double azimuth = 35.0 * std::numbers::pi / 180.0;    // three-quarter view
  constexpr double elevation = 20.0 * std::numbers::pi / 180.0;  // slightly above
  constexpr double margin = 1.05;  // of the distance, around everything
  constexpr double unit = 1e-6;    // keeps off a single point
  Imath::Box3d box = bounds;
  if (box.isEmpty()) box = {V3d(-1.0), V3d(1.0)};
  Camera camera;
  camera.name = "default";

  const V3d back(std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                 std::cos(azimuth) * std::cos(elevation));
  const V3d right = V3d(0, 1, 0).cross(back).normalized();
  const V3d up = back.cross(right);
  const V3d middle = box.center();
  const double slope = std::tan(camera.yfov / 2.0);
  double distance = unit * (1.0 + middle.length());
  for (int corner = 0; corner < 8; ++corner) {
    const V3d p = V3d(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                      corner & 4 ? box.max.z : box.min.z) -
                  middle;
    const double across = std::max(std::abs(p.dot(right)), std::abs(p.dot(up)));
    distance = std::max(distance, p.dot(back) + margin * across / slope);
  }
  const V3d eye = middle + back * distance;
  camera.camera_to_world = M44d(right.x, right.y, right.z, 0, up.x, up.y, up.z, 0, back.x, back.y,
                                back.z, 0, eye.x, eye.y, eye.z, 1);
  return camera;
}

}  // namespace lumivec::gltf
