// Scene building for tests: materials, shapes, cameras, renders, and statistics of their pixels.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "integrator/framebuffer.h"
#include "integrator/render.h"
#include "loader/scene.h"

namespace lumivec::test {

inline const double pi = std::numbers::pi;

// ---- transforms -------------------------------------------------------------------------------

inline M44d translation(const V3d& t) {
  M44d m;
  m.setTranslation(t);
  return m;
}

inline M44d scaling(const V3d& s) {
  M44d m;
  m.setScale(s);
  return m;
}

inline M44d rotation(const V3d& axis, double angle) {
  M44d m;
  m.setAxisAngle(axis.normalized(), angle);
  return m;
}

// ---- materials --------------------------------------------------------------------------------

// Lambertian, nothing else.
inline Material diffuse(const Color& albedo) {
  Material m;
  m.base_color = albedo;
  m.specular = 0.0f;
  return m;
}

// Emits and reflects nothing.
inline Material emitter(const Color& radiance, bool double_sided = false) {
  Material m = diffuse(Color(0.0f));
  m.emission = radiance;
  m.double_sided = double_sided;
  return m;
}

inline Material metal(const Color& reflectance, float roughness = 0.0f) {
  Material m;
  m.base_color = reflectance;
  m.metallic = 1.0f;
  m.roughness = roughness;
  return m;
}

// The smooth boundary of a volume.
inline Material glass(float ior) {
  Material m;
  m.roughness = 0.0f;
  m.transmission = 1.0f;
  m.thin_walled = false;
  m.ior = ior;
  return m;
}

inline Material absorbing_glass(float ior, const Color& transmittance, float distance) {
  Material m = glass(ior);
  m.attenuation_color = transmittance;
  m.attenuation_distance = distance;
  return m;
}

// A smooth infinitely thin sheet.
inline Material thin_sheet(const Color& tint) {
  Material m;
  m.base_color = tint;
  m.roughness = 0.0f;
  m.transmission = 1.0f;
  m.double_sided = true;
  return m;
}

// ---- shapes -----------------------------------------------------------------------------------

// A parallelogram of two triangles; the front looks along edge_u × edge_v. The UVs run from (0, 0)
// at the corner along the edges.
inline Mesh quad(const V3f& corner, const V3f& edge_u, const V3f& edge_v) {
  Mesh mesh;
  mesh.positions = {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
  mesh.uvs = {{V2f(0, 0), V2f(1, 0), V2f(1, 1), V2f(0, 1)}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

// The same surface as quad, in n × n × 2 triangles.
inline Mesh grid(const V3f& corner, const V3f& edge_u, const V3f& edge_v, unsigned n) {
  Mesh mesh;
  mesh.uvs.resize(1);
  for (unsigned j = 0; j <= n; ++j) {
    for (unsigned i = 0; i <= n; ++i) {
      const V2f uv(static_cast<float>(i) / static_cast<float>(n),
                   static_cast<float>(j) / static_cast<float>(n));
      mesh.positions.push_back(corner + edge_u * uv.x + edge_v * uv.y);
      mesh.uvs[0].push_back(uv);
    }
  }
  for (unsigned j = 0; j < n; ++j) {
    for (unsigned i = 0; i < n; ++i) {
      const unsigned a = j * (n + 1) + i;
      mesh.triangles.push_back({a, a + 1, a + n + 2});
      mesh.triangles.push_back({a, a + n + 2, a + n + 1});
    }
  }
  return mesh;
}

// An axis-aligned box, front outside; inward: front inside.
inline Mesh box(const V3f& low, const V3f& high, bool inward = false) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.positions.emplace_back((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y,
                                (i & 4) ? high.z : low.z);
  }
  const unsigned faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    mesh.triangles.push_back({f[0], f[inward ? 2 : 1], f[inward ? 1 : 2]});
    mesh.triangles.push_back({f[0], f[inward ? 3 : 2], f[inward ? 2 : 3]});
  }
  return mesh;
}

// A sphere around the origin of 20 · 4^levels triangles with corners on the sphere. smooth: with
// the sphere's normals.
inline Mesh icosphere(float radius, int levels, bool smooth = false) {
  const double t = (1.0 + std::sqrt(5.0)) / 2.0;
  std::vector<V3d> points = {{-1, t, 0}, {1, t, 0}, {-1, -t, 0}, {1, -t, 0},
                             {0, -1, t}, {0, 1, t}, {0, -1, -t}, {0, 1, -t},
                             {t, 0, -1}, {t, 0, 1}, {-t, 0, -1}, {-t, 0, 1}};
  for (V3d& p : points) p.normalize();
  Mesh mesh;
  mesh.triangles = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                    {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                    {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                    {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<unsigned, unsigned>, unsigned> middles;
    const auto middle = [&](unsigned a, unsigned b) {
      const auto [it, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                   static_cast<unsigned>(points.size()));
      if (fresh) points.push_back((points[a] + points[b]).normalized());
      return it->second;
    };
    std::vector<Imath::Vec3<std::uint32_t>> finer;
    for (const Imath::Vec3<std::uint32_t>& f : mesh.triangles) {
      const unsigned ab = middle(f.x, f.y), bc = middle(f.y, f.z), ca = middle(f.z, f.x);
      finer.insert(finer.end(), {{f.x, ab, ca}, {f.y, bc, ab}, {f.z, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (const V3d& p : points) {
    mesh.positions.push_back(V3f(p * double(radius)));
    if (smooth) mesh.normals.push_back(V3f(p));
  }
  return mesh;
}

// ---- putting a scene together -----------------------------------------------------------------

inline int add_material(Scene& scene, const Material& material) {
  scene.materials.push_back(material);
  return static_cast<int>(scene.materials.size()) - 1;
}

// Each call stores its own copy of mesh and material; returns the index of the instance.
inline int add_mesh(Scene& scene, const Mesh& mesh, const Material& material,
                    const M44d& object_to_world = M44d()) {
  Instance instance;
  instance.mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back(mesh);
  instance.material = add_material(scene, material);
  instance.object_to_world = object_to_world;
  scene.instances.push_back(instance);
  return static_cast<int>(scene.instances.size()) - 1;
}

inline int add_sphere(Scene& scene, float radius, const Material& material,
                      const M44d& object_to_world) {
  Instance instance;
  instance.sphere = static_cast<int>(scene.spheres.size());
  scene.spheres.push_back(Sphere{radius});
  instance.material = add_material(scene, material);
  instance.object_to_world = object_to_world;
  scene.instances.push_back(instance);
  return static_cast<int>(scene.instances.size()) - 1;
}

// An 8-bit image of the given RGBA texels, row 0 on top.
inline int add_image(Scene& scene, int width, int height,
                     const std::vector<std::array<int, 4>>& texels) {
  Image image;
  image.width = width;
  image.height = height;
  for (const std::array<int, 4>& t : texels) {
    for (const int c : t) image.rgba8.push_back(static_cast<std::uint8_t>(c));
  }
  scene.images.push_back(image);
  return static_cast<int>(scene.images.size()) - 1;
}

// A latitude-longitude map, radiance(column, row) in each texel, becomes the environment.
template <typename Function>
void set_environment(Scene& scene, int width, int height, Function radiance) {
  Image image;
  image.width = width;
  image.height = height;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Color c = radiance(x, y);
      image.rgba32f.insert(image.rgba32f.end(), {c.x, c.y, c.z, 1.0f});
    }
  }
  scene.images.push_back(image);
  scene.environment.image = static_cast<int>(scene.images.size()) - 1;
  scene.environment.radiance = Color(1.0f);
}

// A dim sky with a sun that scattered rays still find: 0.04 sr, with two thirds of the light.
inline void set_sky_and_sun(Scene& scene) {
  set_environment(scene, 32, 16, [](int column, int row) {
    return column == 20 && row == 4 ? Color(300.0f, 280.0f, 250.0f) : Color(0.4f, 0.5f, 0.7f);
  });
}

// Radiance above from directions with y > 0, below from the others; half a texel of 1/64 of the
// half turn lies between.
inline void set_sky_and_ground(Scene& scene, const Color& above, const Color& below) {
  set_environment(scene, 8, 64, [&](int, int row) { return row < 32 ? above : below; });
}

inline M44d look_at(const V3d& eye, const V3d& target, const V3d& up) {
  const V3d z = (eye - target).normalized();
  const V3d x = up.cross(z).normalized();
  const V3d y = z.cross(x);
  return {x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, eye.x, eye.y, eye.z, 1};
}

inline V3d any_up(const V3d& forward) {
  return std::abs(forward.normalized().y) > 0.9 ? V3d(0, 0, -1) : V3d(0, 1, 0);
}

inline Camera orthographic_camera(const V3d& eye, const V3d& target, float half_size) {
  Camera camera;
  camera.kind = CameraKind::orthographic;
  camera.xmag = camera.ymag = half_size;
  camera.camera_to_world = look_at(eye, target, any_up(target - eye));
  return camera;
}

inline Camera perspective_camera(const V3d& eye, const V3d& target, double yfov) {
  Camera camera;
  camera.yfov = static_cast<float>(yfov);
  camera.camera_to_world = look_at(eye, target, any_up(target - eye));
  return camera;
}

// ---- rendering --------------------------------------------------------------------------------

inline RenderSettings square(int size, int samples, std::uint64_t seed = 1) {
  RenderSettings settings;
  settings.width = settings.height = size;
  settings.samples = samples;
  settings.seed = seed;
  return settings;
}

// Renders and fails the test if any sample was not finite.
inline Framebuffer render_clean(const Scene& scene, const Camera& camera,
                                const RenderSettings& settings) {
  RenderStatistics statistics;
  Framebuffer picture = render(scene, camera, settings, statistics);
  for (std::size_t t = 0; t < term_count; ++t) {
    EXPECT_EQ(statistics.dropped[t], 0u) << "non-finite samples in " << term_names[t];
  }
  return picture;
}

inline const std::vector<Color>& term(const Framebuffer& picture, Term t) {
  return picture.terms[static_cast<std::size_t>(t)];
}

inline std::vector<Color> beauty(const Framebuffer& picture) {
  std::vector<Color> pixels(picture.pixel_count());
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = picture.beauty(i);
  return pixels;
}

// ---- statistics -------------------------------------------------------------------------------

struct Mean {
  double value = 0.0;
  double error = 0.0;  // standard error
};

// Of one channel of pixels that all have the same expectation; pixels are independent.
inline Mean mean_of(const std::vector<Color>& pixels, int channel = 0) {
  double sum = 0.0, squares = 0.0;
  for (const Color& c : pixels) sum += c[channel];
  const auto n = static_cast<double>(pixels.size());
  for (const Color& c : pixels) squares += (c[channel] - sum / n) * (c[channel] - sum / n);
  return {sum / n, std::sqrt(squares / (n * (n - 1.0)))};
}

// Of the difference of two pictures of the same expectation, pixel by pixel, all channels.
inline Mean mean_difference(const std::vector<Color>& a, const std::vector<Color>& b) {
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const double d = double(a[i][c]) - b[i][c];
      sum += d;
      squares += d * d;
    }
  }
  // The channels of a pixel are not independent: counted as one.
  const auto n = static_cast<double>(a.size());
  return {sum / (3.0 * n), std::sqrt(squares / 3.0) / n};
}

// Rounding of single precision, relative, that no number of samples takes away.
constexpr double rounding = 2e-4;
constexpr double sigmas = 4.0;

// The mean is the expected value as far as its own error tells, and that error is a small share of
// the value.
inline void expect_mean(const Mean& mean, double expected, double largest_error = 0.005) {
  if (expected == 0.0) {
    EXPECT_EQ(mean.value, 0.0);
    return;
  }
  EXPECT_NEAR(mean.value, expected, sigmas * mean.error + rounding * std::abs(expected))
      << "standard error " << mean.error << ", off by " << mean.value / expected - 1.0;
  EXPECT_LT(mean.error, largest_error * std::abs(expected)) << "too noisy to tell";
}

inline void expect_black(const std::vector<Color>& pixels) {
  for (const Color& c : pixels) {
    if (!(c == Color(0.0f))) {
      ADD_FAILURE() << "light where there is none: " << c.x << ' ' << c.y << ' ' << c.z;
      return;
    }
  }
}

// Two pictures of the same expectation agree in their means as far as their noise tells.
inline void expect_same_mean(const std::vector<Color>& a, const std::vector<Color>& b,
                             double largest_error = 0.01) {
  const double level = 0.5 *
                       (std::abs(mean_of(a, 0).value) + std::abs(mean_of(b, 0).value) +
                        std::abs(mean_of(a, 1).value) + std::abs(mean_of(b, 1).value) +
                        std::abs(mean_of(a, 2).value) + std::abs(mean_of(b, 2).value)) /
                       3.0;
  const Mean d = mean_difference(a, b);
  EXPECT_NEAR(d.value, 0.0, sigmas * d.error + rounding * level) << "of " << level;
  EXPECT_LT(d.error, largest_error * level) << "too noisy to tell";
}

}  // namespace lumivec::test
