#include "tools/procedural_scenes.h"

#include <cmath>
#include <numbers>

namespace lumivec {
namespace {

constexpr double pi = std::numbers::pi;

M44d placed(const V3d& position, double scale) {
  M44d m;
  for (int i = 0; i < 3; ++i) {
    m[i][i] = scale;
    m[3][i] = position[i];
  }
  return m;
}

int add_material(Scene& scene, const Color& color, const Color& emission) {
  Material material;
  material.base_color = color;
  material.specular = 0.0f;
  material.emission = emission;
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

void add_sphere(Scene& scene, const V3d& center, double radius, int material) {
  if (scene.spheres.empty()) scene.spheres.push_back({1.0f});
  Instance instance;
  instance.sphere = 0;
  instance.material = material;
  instance.object_to_world = placed(center, radius);
  scene.instances.push_back(instance);
}

void add_mesh(Scene& scene, Mesh mesh, int material) {
  scene.meshes.push_back(std::move(mesh));
  Instance instance;
  instance.mesh = static_cast<int>(scene.meshes.size()) - 1;
  instance.material = material;
  scene.instances.push_back(instance);
}

// A floor at the given height, a lamp above, and a camera that looks at the origin.
Scene stage(float floor_height, float floor_size) {
  Scene scene;
  const int grey = add_material(scene, Color(0.6f), Color(0.0f));
  Mesh floor;
  const float s = floor_size, y = floor_height;
  floor.positions = {{-s, y, -s}, {-s, y, s}, {s, y, s}, {s, y, -s}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  add_mesh(scene, std::move(floor), grey);
  add_sphere(scene, V3d(3.0, 5.0, 4.0), 0.8, add_material(scene, Color(0.0f), Color(30.0f)));
  Camera camera;
  const V3d eye(0.0, 2.0, 6.0), back = eye.normalized();
  const V3d right = V3d(0.0, 1.0, 0.0).cross(back).normalized(), up = back.cross(right);
  for (int i = 0; i < 3; ++i) {
    camera.camera_to_world[0][i] = right[i];
    camera.camera_to_world[1][i] = up[i];
    camera.camera_to_world[2][i] = back[i];
    camera.camera_to_world[3][i] = eye[i];
  }
  scene.cameras.push_back(camera);
  return scene;
}

// Six children around the middle and three around the pole, each a third in size and touching its
// parent.
void add_flake(Scene& scene, const V3d& center, double radius, const V3d& axis, int depth,
               int material) {
  add_sphere(scene, center, radius, material);
  if (depth == 0) return;
  const V3d helper = std::abs(axis.x) < 0.9 ? V3d(1.0, 0.0, 0.0) : V3d(0.0, 1.0, 0.0);
  const V3d u = axis.cross(helper).normalized(), v = axis.cross(u);
  const auto child = [&](double azimuth, double elevation) {
    const V3d direction = (u * std::cos(azimuth) + v * std::sin(azimuth)) * std::cos(elevation) +
                          axis * std::sin(elevation);
    add_flake(scene, center + direction * (radius * 4.0 / 3.0), radius / 3.0, direction, depth - 1,
              material);
  };
  for (int i = 0; i < 6; ++i) child(i * pi / 3.0, 0.0);
  for (int i = 0; i < 3; ++i) child((2.0 * i + 0.5) * pi / 3.0, std::asin(std::sqrt(2.0 / 3.0)));
}

}  // namespace

Scene sphere_flake_scene(int depth) {
  Scene scene = stage(-2.0f, 12.0f);
  add_flake(scene, V3d(0.0), 1.0, V3d(0.0, 1.0, 0.0), depth,
            add_material(scene, Color(0.7f, 0.6f, 0.4f), Color(0.0f)));
  return scene;
}

Scene bumpy_ball_scene(std::uint32_t triangles) {
  Scene scene = stage(-1.5f, 12.0f);
  const auto rows = static_cast<std::uint32_t>(std::lround(std::sqrt(triangles / 4.0)));
  const std::uint32_t columns = 2 * rows;
  Mesh ball;
  const auto point = [](double theta, double phi) {
    const double r = 1.3 + 0.05 * std::sin(23.0 * theta) * std::sin(29.0 * phi) +
                     0.01 * std::sin(171.0 * theta) * std::cos(190.0 * phi);
    return V3d(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)) *
           r;
  };
  ball.uvs.resize(1);
  for (std::uint32_t j = 0; j <= rows; ++j) {
    for (std::uint32_t i = 0; i <= columns; ++i) {
      // Kept off the poles, so that normals exist everywhere.
      const double theta = pi * (0.001 + 0.998 * j / rows), phi = 2.0 * pi * i / columns;
      constexpr double step = 1e-4;
      const V3d along = point(theta, phi + step) - point(theta, phi - step);
      const V3d down = point(theta + step, phi) - point(theta - step, phi);
      ball.positions.push_back(V3f(point(theta, phi)));
      ball.normals.push_back(V3f(along.cross(down).normalized()));
      ball.uvs[0].push_back(V2f(static_cast<float>(i) / static_cast<float>(columns),
                                static_cast<float>(j) / static_cast<float>(rows)));
    }
  }
  for (std::uint32_t j = 0; j < rows; ++j) {
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + columns + 1;
      ball.triangles.push_back({a, a + 1, b});
      ball.triangles.push_back({a + 1, b + 1, b});
    }
  }
  add_mesh(scene, std::move(ball), add_material(scene, Color(0.7f, 0.6f, 0.4f), Color(0.0f)));
  return scene;
}

}  // namespace lumivec
