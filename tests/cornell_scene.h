// A closed room with every kind of path: a rectangular lamp, diffuse walls, a glossy and a mirrored
// object, a glass ball and a thin sheet. For tests of what pictures keep under a change.
#pragma once

#include "test_scenes.h"

namespace lumivec::test {

struct CornellOptions {
  double scale = 1.0;      // of all lengths, in the geometry
  M44d world;              // moves everything, camera too
  float emission = 10.0f;  // of the lamp
  bool specular = true;    // with mirror, glass and sheet
  unsigned wall_grid = 1;  // triangles of the back wall: 2 · grid²
};

inline M44d placed(const CornellOptions& o, const V3d& at, const M44d& turn = M44d()) {
  return turn * translation(at * o.scale) * o.world;
}

inline Scene cornell_scene(const CornellOptions& o = {}) {
  Scene scene;
  const auto s = static_cast<float>(o.scale);
  const Material white = diffuse(Color(0.7f, 0.7f, 0.6f));
  const auto wall = [&](const V3f& corner, const V3f& u, const V3f& v, const Material& material) {
    add_mesh(scene, quad(corner * s, u * s, v * s), material, o.world);
  };
  wall({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}, white);                        // floor
  wall({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, white);                         // ceiling
  wall({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}, diffuse({0.6f, 0.1f, 0.1f}));  // left
  wall({1, -1, -1}, {0, 0, 2}, {0, 2, 0}, diffuse({0.1f, 0.5f, 0.1f}));   // right
  add_mesh(scene, grid(V3f(-1, -1, -1) * s, V3f(2, 0, 0) * s, V3f(0, 2, 0) * s, o.wall_grid), white,
           o.world);
  wall({-0.4f, 0.99f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f},
       emitter(Color(o.emission, o.emission * 0.9f, o.emission * 0.8f)));
  add_mesh(scene, box(V3f(-0.25f) * s, V3f(0.25f) * s), white,
           placed(o, {-0.45, -0.75, 0.1}, rotation({0, 1, 0}, 0.4)));
  Material glossy = metal(Color(0.8f, 0.7f, 0.4f), 0.4f);
  add_mesh(scene, box(V3f(-0.2f) * s, V3f(0.2f) * s), glossy,
           placed(o, {0.1, -0.8, 0.5}, rotation({0, 1, 0}, -0.3)));
  if (o.specular) {
    add_sphere(scene, 0.3f * s, metal(Color(0.9f)), placed(o, {-0.5, -0.2, -0.4}));
    add_sphere(scene, 0.3f * s, glass(1.5f), placed(o, {0.5, -0.5, -0.2}));
    wall({0.3f, -0.2f, 0.1f}, {0.5f, 0, 0}, {0, 0.6f, 0.1f}, thin_sheet({0.8f, 0.9f, 1.0f}));
  }
  return scene;
}

inline Camera cornell_camera(const CornellOptions& o = {}) {
  Camera camera = perspective_camera(V3d(0, 0, 3.2) * o.scale, V3d(0.0), 0.8);
  camera.camera_to_world = camera.camera_to_world * o.world;
  return camera;
}

// Means over blocks of pixels.
inline std::vector<Color> blocks(const std::vector<Color>& pixels, int size, int block) {
  const int n = size / block;
  std::vector<Color> means(std::size_t(n * n), Color(0.0f));
  for (int y = 0; y < n * block; ++y) {
    for (int x = 0; x < n * block; ++x) {
      means[std::size_t(y / block * n + x / block)] +=
          pixels[std::size_t(y * size + x)] * (1.0f / static_cast<float>(block * block));
    }
  }
  return means;
}

// The share of blocks whose means differ by more than tolerance, relative to the picture's mean
// or their own.
inline double differing_blocks(const std::vector<Color>& a, const std::vector<Color>& b, int size,
                               int block, double tolerance) {
  const std::vector<Color> ba = blocks(a, size, block), bb = blocks(b, size, block);
  double level = 0.0;
  for (const Color& c : ba) level += (double(c.x) + c.y + c.z) / (3.0 * double(ba.size()));
  int differing = 0;
  for (std::size_t i = 0; i < ba.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double scale = std::max({level, double(ba[i][c]), double(bb[i][c])});
      if (!(std::abs(double(ba[i][c]) - bb[i][c]) <= tolerance * scale)) {
        ++differing;
        break;
      }
    }
  }
  return differing / static_cast<double>(ba.size());
}

}  // namespace lumivec::test
