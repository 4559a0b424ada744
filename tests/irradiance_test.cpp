// Irradiance on a Lambertian patch under every kind of light, against closed forms.
#include <functional>

#include "test_scenes.h"

namespace lumivec::test {
namespace {

constexpr float albedo = 0.5f;
constexpr float patch_size = 1e-3f;

struct Receiver {
  V3d position{0.0};
  V3d normal{0.0, 1.0, 0.0};
};

// Irradiance on a small patch in the scene, from a picture of it by a camera just above it.
std::array<Mean, 3> measure(Scene scene, const Receiver& receiver = {}, int samples = 64) {
  const V3d n = receiver.normal.normalized();
  const V3d t = any_up(n).cross(n).normalized(), b = n.cross(t);
  const float s = 4.0f * patch_size;
  add_mesh(scene, quad(V3f((-t - b) * double(s)), V3f(t * (2.0 * s)), V3f(b * (2.0 * s))),
           diffuse(Color(albedo)), translation(receiver.position));
  const Camera camera = orthographic_camera(receiver.position + n * (0.5 * patch_size),
                                            receiver.position, patch_size);
  const Framebuffer picture = render_clean(scene, camera, square(16, samples));
  for (const Term t2 : {Term::emitted, Term::specular, Term::indirect, Term::caustic}) {
    expect_black(term(picture, t2));
  }
  std::array<Mean, 3> result;
  for (int c = 0; c < 3; ++c) {
    result[std::size_t(c)] = mean_of(term(picture, Term::direct), c);
    result[std::size_t(c)].value *= pi / albedo;
    result[std::size_t(c)].error *= pi / albedo;
  }
  return result;
}

// Irradiance from a polygon of radiance 1, whichever way it faces: Lambert's formula over the part
// above the horizon.
double polygon_irradiance(const std::vector<V3d>& corners, const Receiver& receiver) {
  const V3d n = receiver.normal.normalized();
  std::vector<V3d> above;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const V3d a = corners[i] - receiver.position;
    const V3d b = corners[(i + 1) % corners.size()] - receiver.position;
    const double ha = a.dot(n), hb = b.dot(n);
    if (ha > 0.0) above.push_back(a);
    if ((ha > 0.0) != (hb > 0.0)) above.push_back(a + (b - a) * (ha / (ha - hb)));
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < above.size(); ++i) {
    const V3d a = above[i].normalized(), b = above[(i + 1) % above.size()].normalized();
    const V3d edge = a.cross(b);
    if (edge.length() > 0.0) {
      sum += std::atan2(edge.length(), a.dot(b)) * edge.normalized().dot(n);
    }
  }
  return std::abs(sum) / 2.0;
}

std::vector<V3d> rectangle(const V3d& corner, const V3d& u, const V3d& v) {
  return {corner, corner + u, corner + u + v, corner + v};
}

// Irradiance from the front sides of a convex mesh of radiance 1.
double convex_irradiance(const Mesh& mesh, const M44d& transform, const Receiver& receiver) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const V3d a = V3d(mesh.positions[t.x]) * transform, b = V3d(mesh.positions[t.y]) * transform,
              c = V3d(mesh.positions[t.z]) * transform;
    if ((b - a).cross(c - a).dot(receiver.position - a) > 0.0) {
      sum += polygon_irradiance({a, b, c}, receiver);
    }
  }
  return sum;
}

// ∫ f(direction) cosθ dω over the hemisphere, by the midpoint rule.
double hemisphere_integral(const Receiver& receiver, const std::function<double(const V3d&)>& f) {
  const V3d n = receiver.normal.normalized();
  const V3d t = any_up(n).cross(n).normalized(), b = n.cross(t);
  constexpr int rings = 400, spokes = 800;
  double sum = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double sin2 = (i + 0.5) / rings;  // equal steps of sin²θ take care of the cosine
    const double sine = std::sqrt(sin2), cosine = std::sqrt(1.0 - sin2);
    for (int j = 0; j < spokes; ++j) {
      const double phi = 2.0 * pi * (j + 0.5) / spokes;
      sum += f(n * cosine + t * (sine * std::cos(phi)) + b * (sine * std::sin(phi)));
    }
  }
  return pi * sum / (double(rings) * spokes);
}

const Receiver level{};
const Receiver tilted{{0.1, -0.2, 0.3}, {0.4, 0.8, -0.3}};

// ---- spheres ----------------------------------------------------------------------------------

void expect_sphere(const V3d& center, double radius, const Receiver& receiver, float radiance) {
  Scene scene;
  add_sphere(scene, static_cast<float>(radius), emitter(Color(radiance)), translation(center));
  const V3d to = center - receiver.position;
  const double d = to.length(), cosine = to.dot(receiver.normal.normalized()) / d;
  ASSERT_GT(cosine * d, radius) << "not wholly above the horizon";
  expect_mean(measure(scene, receiver)[0], pi * radiance * radius * radius / (d * d) * cosine);
}

TEST(irradiance, sphere) {
  expect_sphere({0.4, 1.0, 0.2}, 0.3, level, 10.0f);
  expect_sphere({0.4, 1.0, 0.2}, 0.3, tilted, 10.0f);
}
TEST(irradiance, far_sphere) {
  expect_sphere({300.0, 900.0, -100.0}, 2.0, level, 1e5f);
}
TEST(irradiance, tiny_sphere) {
  expect_sphere({0.1, 1.0, 0.0}, 1e-4, level, 1e6f);
}
TEST(irradiance, tiny_sphere_close) {
  expect_sphere({0.0, 0.05, 0.02}, 1e-4, level, 1e6f);
}
TEST(irradiance, sphere_that_fills_the_view) {
  expect_sphere({0.0, 1.02, 0.0}, 1.0, level, 3.0f);
}
TEST(irradiance, huge_sphere_close) {
  expect_sphere({0.0, 1010.0, 0.0}, 1000.0, level, 3.0f);
}

TEST(irradiance, sphere_partly_below_the_horizon) {
  for (const double height : {-0.3, 0.0, 0.3}) {
    const V3d center(1.0, height, 0.0);
    Scene scene;
    add_sphere(scene, 0.6f, emitter(Color(2.0f)), translation(center));
    const double expected = 2.0 * hemisphere_integral(level, [&](const V3d& w) {
                              const double along = w.dot(center);
                              return along > 0.0 && center.length2() - along * along < 0.36;
                            });
    expect_mean(measure(scene)[0], expected);
  }
}

TEST(irradiance, inside_a_sphere) {
  Scene two_sided;
  add_sphere(two_sided, 5.0f, emitter(Color(2.0f), true), translation({1.0, 2.0, 0.5}));
  expect_mean(measure(two_sided)[0], 2.0 * pi);
  Scene one_sided;
  add_sphere(one_sided, 5.0f, emitter(Color(2.0f)), translation({1.0, 2.0, 0.5}));
  expect_mean(measure(one_sided)[0], 0.0);
}

TEST(irradiance, sphere_scaled_by_its_instance) {
  Scene scene;
  add_sphere(scene, 0.1f, emitter(Color(10.0f)),
             scaling(V3d(-3.0)) * rotation({1, 2, 3}, 1.0) * translation({0.0, 1.0, 0.0}));
  expect_mean(measure(scene)[0], pi * 10.0 * 0.09);
}

TEST(irradiance, ellipsoid) {
  const M44d transforms[] = {
      scaling({1.0, 0.3, 0.6}) * rotation({1, 1, 0}, 0.7) * translation({0.5, 1.0, 0.2}),
      scaling({-0.1, 0.9, 0.4}) * rotation({0, 1, 3}, 2.0) * translation({-0.3, 1.2, 0.0}),
      scaling({2.0, 0.01, 2.0}) * translation({0.5, 1.0, 0.0})};
  for (const M44d& transform : transforms) {
    Scene scene;
    add_sphere(scene, 0.5f, emitter(Color(4.0f)), transform);
    const double expected = 4.0 * convex_irradiance(icosphere(0.5f, 6), transform, tilted);
    expect_mean(measure(scene, tilted, 256)[0], expected, 0.01);
  }
}

// ---- rectangles and triangles -----------------------------------------------------------------

void expect_rectangle(const V3d& corner, const V3d& u, const V3d& v, const Receiver& receiver,
                      double largest_error = 0.005) {
  for (const bool behind : {false, true}) {
    Scene scene;
    const V3d &first = behind ? v : u, &second = behind ? u : v;
    add_mesh(scene, quad(V3f(corner), V3f(first), V3f(second)), emitter(Color(5.0f), behind));
    const bool faces = first.cross(second).dot(receiver.position - corner) > 0.0;
    const double expected =
        faces || behind ? 5.0 * polygon_irradiance(rectangle(corner, u, v), receiver) : 0.0;
    expect_mean(measure(scene, receiver)[0], expected, largest_error);
  }
}

TEST(irradiance, rectangle) {
  expect_rectangle({-0.5, 1.0, -0.3}, {1, 0, 0}, {0, 0, 1}, level);
}
TEST(irradiance, rectangle_from_behind) {
  expect_rectangle({-0.5, 1.0, -0.3}, {0, 0, 1}, {1, 0, 0}, level);
}
TEST(irradiance, close_rectangle) {
  expect_rectangle({-0.5, 0.03, -0.3}, {1, 0, 0}, {0, 0, 1}, level);
}
TEST(irradiance, far_rectangle) {
  expect_rectangle({-5.0, 300.0, -3.0}, {1, 0, 0}, {0, 0, 1}, level);
}
TEST(irradiance, middling_rectangle) {  // on both sides of the switch to area sampling
  expect_rectangle({0.0, 10.0, 0.0}, {0.32, 0, 0}, {0, 0, 0.32}, level);
  expect_rectangle({0.0, 10.0, 0.0}, {0.30, 0, 0}, {0, 0, 0.30}, level);
}
TEST(irradiance, tilted_rectangle) {
  expect_rectangle({0.3, 0.9, -0.3}, {0.5, 0.5, 0}, {0.4, -0.4, 0.8}, tilted);
}
TEST(irradiance, rectangle_partly_below_the_horizon) {
  expect_rectangle({0.7, -0.6, -0.3}, {0, 1.1, 0}, {0, 0, 1}, level, 0.01);
}
TEST(irradiance, rectangle_below_the_horizon) {
  Scene scene;
  add_mesh(scene, quad({0.7f, -0.6f, -0.3f}, {0, 0.5f, 0}, {0, 0, 1}), emitter(Color(5.0f), true));
  expect_mean(measure(scene)[0], 0.0);
}
TEST(irradiance, long_rectangle) {
  expect_rectangle({0.2, 0.4, -50.0}, {0.01, 0, 0}, {0, 0, 100}, level, 0.01);
}
TEST(irradiance, rectangle_that_fills_the_view) {
  expect_rectangle({-500.0, 0.5, -500.0}, {1000, 0, 0}, {0, 0, 1000}, level);
}

// The rectangle {(-0.5, 1, -0.3) + u (1, 0, 0) + v (0, 0, 1)} as triangles that face down.
Mesh odd_triangles() {
  Mesh mesh;
  mesh.positions = {
      {-0.5f, 1, -0.3f}, {0.5f, 1, -0.3f}, {0.5f, 1, 0.7f}, {-0.5f, 1, 0.7f}, {-0.2f, 1, 0.7f}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {0, 4, 3}};
  return mesh;
}

TEST(irradiance, triangles) {
  const double expected =
      5.0 * polygon_irradiance(rectangle({-0.5, 1.0, -0.3}, {1, 0, 0}, {0, 0, 1}), tilted);
  Scene joined;
  add_mesh(joined, odd_triangles(), emitter(Color(5.0f)));
  expect_mean(measure(joined, tilted)[0], expected);
  Scene apart;
  for (const auto& triangle : odd_triangles().triangles) {
    Mesh one = odd_triangles();
    one.triangles = {triangle};
    add_mesh(apart, one, emitter(Color(5.0f)));
  }
  expect_mean(measure(apart, tilted)[0], expected);
}

TEST(irradiance, parallelogram) {
  Scene scene;
  add_mesh(scene, quad({-0.5f, 1, -0.3f}, {1, 0, 0.4f}, {0.3f, 0, 1}), emitter(Color(5.0f)));
  expect_mean(
      measure(scene)[0],
      5.0 * polygon_irradiance(rectangle({-0.5, 1, -0.3}, {1, 0, 0.4}, {0.3, 0, 1}), level));
}

TEST(irradiance, two_triangles_folded_along_their_diagonal) {
  Mesh mesh = quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1});
  mesh.positions[3].y = 0.6f;
  Scene scene;
  add_mesh(scene, mesh, emitter(Color(5.0f)));
  expect_mean(measure(scene)[0], 5.0 * convex_irradiance(mesh, M44d(), level));
}

TEST(irradiance, small_and_sliver_triangles) {
  Mesh mesh;
  mesh.positions = {{-2, 1, 0},   {2, 1, 0.001f},    {2, 1, 0.02f},
                    {0, 0.5f, 0}, {0.001f, 0.5f, 0}, {0, 0.5f, 0.001f}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  Scene scene;
  add_mesh(scene, mesh, emitter(Color(50.0f)));
  expect_mean(measure(scene, level, 256)[0], 50.0 * convex_irradiance(mesh, M44d(), level));
}

TEST(irradiance, mesh_of_many_triangles) {
  const M44d transform = scaling({0.5, 0.3, 0.7}) * translation({0.2, 0.8, -0.4});
  const Mesh mesh = icosphere(1.0f, 3);
  Scene scene;
  add_mesh(scene, mesh, emitter(Color(5.0f)), transform);
  expect_mean(measure(scene, tilted, 128)[0], 5.0 * convex_irradiance(mesh, transform, tilted),
              0.01);
}

TEST(irradiance, mirrored_and_rotated_instances) {
  const M44d transforms[] = {
      rotation({1, 0.3, 0.2}, 0.4) * translation({0.1, 1, 0}),
      scaling({-1, 1, 1}) * rotation({1, 0.3, 0.2}, 0.4) * translation({0.1, 1, 0}),
      scaling({0.5, -1, 2}) * rotation({1, 0.3, 0.2}, pi - 0.3) * translation({0.1, 1, 0}),
      scaling({-2, -1, -0.5}) * translation({0, 1, 0})};
  const Mesh meshes[] = {quad({-0.5f, 0, -0.3f}, {1, 0, 0}, {0, 0, 1}),
                         quad({-0.5f, 0, -0.3f}, {1, 0, 0.3f}, {0.1f, 0, 1})};
  for (const M44d& transform : transforms) {
    for (const Mesh& mesh : meshes) {
      std::vector<V3d> corners;
      for (const V3f& p : mesh.positions) corners.push_back(V3d(p) * transform);
      // The front is a matter of the object, so that normals transform by the inverse transpose.
      V3d normal;
      transform.inverse().transposed().multDirMatrix(V3d(0, -1, 0), normal);
      const bool faces = normal.dot(level.position - corners[0]) > 0.0;
      for (const bool double_sided : {false, true}) {
        Scene scene;
        add_mesh(scene, mesh, emitter(Color(5.0f), double_sided), transform);
        expect_mean(measure(scene)[0],
                    faces || double_sided ? 5.0 * polygon_irradiance(corners, level) : 0.0);
      }
    }
  }
}

// A mesh large enough to be instanced by reference emits as a flattened one does.
TEST(irradiance, instanced_mesh_lights) {
  const Mesh mesh = grid({-0.5f, 0, -0.5f}, {1, 0, 0}, {0, 0, 1}, 160);
  const M44d transforms[] = {
      scaling({0.5, 1, 0.7}) * rotation({1, 0.3, 0.2}, 0.4) * translation({0.6, 1, 0}),
      scaling({-0.6, 1, 0.5}) * rotation({0.1, 0.3, 1}, 0.3) * translation({-0.6, 1, 0})};
  Scene scene;
  double expected = 0.0;
  for (const M44d& transform : transforms) {
    add_mesh(scene, mesh, emitter(Color(5.0f)), transform);
    std::vector<V3d> corners;
    for (const V3d& p : rectangle({-0.5, 0, -0.5}, {1, 0, 0}, {0, 0, 1}))
      corners.push_back(p * transform);
    expected += 5.0 * polygon_irradiance(corners, level);
  }
  scene.instances[1].mesh = 0;
  expect_mean(measure(scene, level, 128)[0], expected, 0.01);
}

// ---- what varies over a light -----------------------------------------------------------------

TextureMap nearest_map(int image) {
  TextureMap map;
  map.image = image;
  map.filter = Filter::nearest;
  return map;
}

TEST(irradiance, emission_texture) {
  Scene scene;
  const int image = add_image(scene, 2, 1, {{255, 0, 255, 255}, {0, 51, 255, 255}});
  Material material = emitter(Color(5.0f));
  material.emission_map = nearest_map(image);
  add_mesh(scene, quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}), material);
  const double left =
      5.0 * polygon_irradiance(rectangle({-0.5, 1, -0.5}, {0.5, 0, 0}, {0, 0, 1}), tilted);
  const double right =
      5.0 * polygon_irradiance(rectangle({0.0, 1, -0.5}, {0.5, 0, 0}, {0, 0, 1}), tilted);
  const std::array<Mean, 3> irradiance = measure(scene, tilted, 256);
  expect_mean(irradiance[0], left, 0.01);
  expect_mean(irradiance[1], right * 0.2, 0.01);
  expect_mean(irradiance[2], left + right);
}

TEST(irradiance, emission_texture_on_a_mirrored_instance) {
  Scene scene;
  const int image = add_image(scene, 2, 1, {{255, 0, 0, 255}, {0, 255, 0, 255}});
  Material material = emitter(Color(5.0f));
  material.emission_map = nearest_map(image);
  add_mesh(scene, quad({0.2f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}), material, scaling({-1, 1, 1}));
  const std::array<Mean, 3> irradiance = measure(scene, level, 256);
  expect_mean(irradiance[0],
              5.0 * polygon_irradiance(rectangle({-0.2, 1, -0.5}, {-0.5, 0, 0}, {0, 0, 1}), level),
              0.01);
  expect_mean(irradiance[1],
              5.0 * polygon_irradiance(rectangle({-0.7, 1, -0.5}, {-0.5, 0, 0}, {0, 0, 1}), level),
              0.01);
}

// The map's dark half is seen by no light sample that the probes of a triangle foresee.
TEST(irradiance, emission_texture_with_one_bright_texel) {
  Scene scene;
  std::vector<std::array<int, 4>> texels(16 * 16, {0, 0, 0, 255});
  texels[5 * 16 + 11] = {255, 255, 255, 255};
  Material material = emitter(Color(500.0f));
  material.emission_map = nearest_map(add_image(scene, 16, 16, texels));
  add_mesh(scene, quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}), material);
  const double expected =
      500.0 * polygon_irradiance(rectangle({-0.5 + 11.0 / 16, 1, -0.5 + 5.0 / 16}, {1.0 / 16, 0, 0},
                                           {0, 0, 1.0 / 16}),
                                 level);
  expect_mean(measure(scene, level, 1024)[0], expected, 0.05);
}

TEST(irradiance, emission_texture_on_spheres) {
  Scene scene;
  // v runs from the pole: the upper half of the sphere is green, the lower half red.
  const int image = add_image(scene, 1, 2, {{0, 255, 0, 255}, {255, 0, 0, 255}});
  Material material = emitter(Color(5.0f));
  material.emission_map = nearest_map(image);
  add_sphere(scene, 0.5f, material, rotation({0, 0, 1}, pi / 2) * translation({0.0, 2.0, 0.0}));
  std::array<Mean, 3> irradiance = measure(scene, level, 256);
  const double half = 0.5 * pi * 5.0 / 16.0;
  expect_mean(irradiance[0], half, 0.01);
  expect_mean(irradiance[1], half, 0.01);
  scene.instances[0].object_to_world = scaling({1.0, 1.0, 1.001}) * translation({0.0, 2.0, 0.0});
  irradiance = measure(scene, level, 256);
  // Only the lower half is seen.
  expect_mean(irradiance[1], 0.0);
  EXPECT_NEAR(irradiance[0].value, 2.0 * half, 0.02 * half);
}

TEST(irradiance, light_with_holes) {
  for (const AlphaMode mode : {AlphaMode::mask, AlphaMode::blend}) {
    Scene scene;
    const int image = add_image(scene, 2, 1, {{255, 255, 255, 64}, {255, 255, 255, 191}});
    Material material = emitter(Color(5.0f));
    material.base_color_map = nearest_map(image);
    material.alpha_mode = mode;
    add_mesh(scene, quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}), material);
    const double left =
        5.0 * polygon_irradiance(rectangle({-0.5, 1, -0.5}, {0.5, 0, 0}, {0, 0, 1}), tilted);
    const double right =
        5.0 * polygon_irradiance(rectangle({0.0, 1, -0.5}, {0.5, 0, 0}, {0, 0, 1}), tilted);
    expect_mean(measure(scene, tilted, 256)[0],
                mode == AlphaMode::mask ? right : left * 64 / 255 + right * 191 / 255, 0.01);
  }
}

TEST(irradiance, sphere_light_with_holes) {
  for (const double stretch : {1.0, 1.001}) {
    Scene scene;
    Material material = emitter(Color(5.0f), true);
    material.base_color_map =
        nearest_map(add_image(scene, 1, 2, {{255, 255, 255, 255}, {255, 255, 255, 0}}));
    material.alpha_mode = AlphaMode::mask;
    add_sphere(scene, 0.5f, material, scaling({1.0, 1.0, stretch}) * translation({0.0, 2.0, 0.0}));
    // The lower half is a hole through which the upper half is seen from inside: its outline is
    // the widest circle.
    const double sine2 = 0.25 / (4.0 + 0.25);
    const Mean mean = measure(scene, level, 512)[0];
    EXPECT_NEAR(mean.value, pi * 5.0 * sine2, sigmas * mean.error + 0.002 * mean.value) << stretch;
    EXPECT_LT(mean.error, 0.02 * mean.value);
  }
}

// ---- lights without extent --------------------------------------------------------------------

Light light_of(LightKind kind, const Color& intensity, const V3d& position, const V3d& target) {
  Light light;
  light.kind = kind;
  light.intensity = intensity;
  light.object_to_world = look_at(position, target, any_up(target - position));
  return light;
}

TEST(irradiance, point_light) {
  for (const double distance : {1e-3, 1.0, 1e4}) {
    const V3d position = V3d(0.3, 1.0, -0.4).normalized() * distance;
    Scene scene;
    scene.lights = {light_of(LightKind::point, {7.0f, 1e-6f, 1e6f}, position, V3d(0.0))};
    // Over a patch of this size the nearest light varies.
    const double tolerance = distance < 0.01 ? 0.5 : 1e-3;
    const std::array<Mean, 3> irradiance = measure(scene);
    const double expected = position.normalized().y / (distance * distance);
    EXPECT_NEAR(irradiance[0].value / (7.0 * expected), 1.0, tolerance);
    EXPECT_NEAR(irradiance[1].value / (1e-6 * expected), 1.0, tolerance);
    EXPECT_NEAR(irradiance[2].value / (1e6 * expected), 1.0, tolerance);
  }
}

TEST(irradiance, spot_light) {
  const double inner = 0.3, outer = 0.5;
  const V3d position(0.5, 2.0, 0.2);
  for (const double angle : {0.0, 0.1, 0.29, 0.35, 0.45, 0.49, 0.51, 1.0, 3.0}) {
    const V3d toward = (level.position - position).normalized();
    const V3d axis = toward * rotation(toward.cross(V3d(1, 0, 0)), angle);
    Scene scene;
    scene.lights = {light_of(LightKind::spot, Color(7.0f), position, position + axis)};
    scene.lights[0].inner_cone = static_cast<float>(inner);
    scene.lights[0].outer_cone = static_cast<float>(outer);
    // KHR_lights_punctual: the squared ramp of the cosine.
    const double ramp = std::clamp(
        (std::cos(angle) - std::cos(outer)) / (std::cos(inner) - std::cos(outer)), 0.0, 1.0);
    const double expected = 7.0 * ramp * ramp * -toward.y / position.length2();
    const Mean mean = measure(scene)[0];
    EXPECT_NEAR(mean.value, expected, 0.002 * 7.0 / position.length2()) << "at angle " << angle;
    if (angle > outer) {
      EXPECT_EQ(mean.value, 0.0);
    }
  }
}

TEST(irradiance, narrow_and_wide_spot_lights) {
  for (const double outer : {1e-2, pi / 2}) {
    Scene scene;
    scene.lights = {light_of(LightKind::spot, Color(7.0f), {0, 2, 0}, V3d(0.0))};
    scene.lights[0].inner_cone = static_cast<float>(0.5 * outer);
    scene.lights[0].outer_cone = static_cast<float>(outer);
    const Mean mean = measure(scene)[0];
    EXPECT_NEAR(mean.value, 7.0 / 4.0, 0.002 * 7.0 / 4.0);
  }
}

TEST(irradiance, directional_light) {
  Scene scene;
  scene.lights = {light_of(LightKind::directional, Color(7.0f), {0, 0, 0}, {-1, -2, -3})};
  expect_mean(measure(scene)[0], 7.0 * 2.0 / std::sqrt(14.0));
  expect_mean(measure(scene, {{0, 0, 0}, {0, -1, 0}})[0], 0.0);
}

// ---- environments -----------------------------------------------------------------------------

TEST(irradiance, constant_environment) {
  Scene scene;
  scene.environment.radiance = Color(1.0f, 2.0f, 0.0f);
  const std::array<Mean, 3> irradiance = measure(scene, tilted);
  expect_mean(irradiance[0], pi);
  expect_mean(irradiance[1], 2.0 * pi);
  expect_mean(irradiance[2], 0.0);
}

// What a map of this size shows in a direction, bilinear, if it is not turned.
template <typename Function>
double map_radiance(const V3d& d, int width, int height, Function texel) {
  const double x = (std::atan2(d.x, -d.z) / (2.0 * pi) + 0.5) * width - 0.5;
  const double y =
      std::clamp(std::acos(std::clamp(d.y, -1.0, 1.0)) / pi * height - 0.5, 0.0, height - 1.0);
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  const double fx = x - x0, fy = y - y0;
  const auto at = [&](int i, int j) {
    return double(texel((i + width) % width, std::min(j, height - 1)).x);
  };
  return (at(x0, y0) * (1 - fx) + at(x0 + 1, y0) * fx) * (1 - fy) +
         (at(x0, y0 + 1) * (1 - fx) + at(x0 + 1, y0 + 1) * fx) * fy;
}

TEST(irradiance, environment_map) {
  constexpr int width = 32, height = 16;
  const auto quadrant = [](int x, int y) { return Color(x >= 20 && y < 8 ? 3.0f : 0.0f); };
  const auto spot = [](int x, int y) { return Color(x == 21 && y == 4 ? 1000.0f : 0.1f); };
  for (const float turn : {0.0f, 1.0f, -2.5f}) {
    const M44d back = rotation({0, 1, 0}, -turn);
    for (const V3d& normal : {V3d(0, 1, 0), V3d(1, 0.2, 0), V3d(0, 0.1, -1), V3d(-1, 0, 1)}) {
      const Receiver receiver{V3d(0.0), normal};
      Scene scene;
      set_environment(scene, width, height, quadrant);
      scene.environment.rotation = turn;
      double expected = hemisphere_integral(
          receiver, [&](const V3d& w) { return map_radiance(w * back, width, height, quadrant); });
      Mean mean = measure(scene, receiver, 256)[0];
      EXPECT_NEAR(mean.value, expected, sigmas * mean.error + 0.001 * pi);
      EXPECT_LT(mean.error, 0.01 * pi);
      set_environment(scene, width, height, spot);
      expected = hemisphere_integral(
          receiver, [&](const V3d& w) { return map_radiance(w * back, width, height, spot); });
      mean = measure(scene, receiver, 256)[0];
      EXPECT_NEAR(mean.value, expected, sigmas * mean.error + 0.003 * pi) << mean.error;
      EXPECT_LT(mean.error, 0.01 * std::max(expected, pi)) << "of " << expected;
    }
  }
}

// The conventions by hand: the right half of the map is +X, and turns toward -Z.
TEST(irradiance, environment_directions) {
  const auto right = [](int x, int) { return Color(x >= 64 ? 1.0f : 0.0f); };
  const auto expect_from = [&](const V3d& normal, float turn, double expected) {
    Scene scene;
    set_environment(scene, 128, 64, right);
    scene.environment.rotation = turn;
    EXPECT_NEAR(measure(scene, {V3d(0.0), normal})[0].value, expected, 0.02 * pi);
  };
  expect_from({1, 0, 0}, 0.0f, pi);
  expect_from({-1, 0, 0}, 0.0f, 0.0);
  expect_from({0, 0, 1}, 0.0f, pi / 2);
  expect_from({0, 1, 0}, 0.0f, pi / 2);
  expect_from({0, 0, -1}, static_cast<float>(pi / 2), pi);
  expect_from({0, 0, 1}, static_cast<float>(pi / 2), 0.0);
}

// ---- several lights ---------------------------------------------------------------------------

TEST(irradiance, sum_of_many_kinds) {
  std::vector<std::function<void(Scene&)>> lights = {
      [](Scene& s) {
        add_sphere(s, 0.2f, emitter(Color(9.0f)), translation({0.9, 1.0, 0.0}));
      },
      [](Scene& s) {
        add_mesh(s, quad({-1.5f, 1, -0.5f}, {0.5f, 0, 0}, {0, 0, 1}), emitter(Color(3.0f)));
      },
      [](Scene& s) {
        add_mesh(s, quad({-0.3f, 0.7f, 0.8f}, {0.7f, 0, 0.1f}, {0.1f, 0.5f, 0.2f}),
                 emitter(Color(3.0f), true));
      },
      [](Scene& s) {
        s.lights.push_back(light_of(LightKind::point, Color(2.0f), {0, 3, -2}, V3d(0.0)));
      },
      [](Scene& s) {
        s.lights.push_back(light_of(LightKind::spot, Color(9.0f), {-1, 2, -2}, V3d(0.0)));
      },
      [](Scene& s) {
        s.lights.push_back(light_of(LightKind::directional, Color(0.7f), {1, 3, -2}, V3d(0.0)));
      },
      [](Scene& s) {
        s.lights.push_back(light_of(LightKind::directional, Color(0.2f), {-1, 3, -2}, V3d(0.0)));
      }};
  Scene together;
  double expected = 0.0, noise2 = 0.0;
  for (const auto& add : lights) {
    Scene alone;
    add(alone);
    add(together);
    const Mean mean = measure(alone, tilted, 256)[0];
    EXPECT_GT(mean.value, 0.05);
    expected += mean.value;
    noise2 += mean.error * mean.error;
  }
  Mean mean = measure(together, tilted, 512)[0];
  mean.error = std::sqrt(mean.error * mean.error + noise2);
  expect_mean(mean, expected, 0.01);
}

TEST(irradiance, bright_light_next_to_a_dim_one) {
  Scene scene;
  scene.lights = {light_of(LightKind::point, {1e6f, 0, 0}, {0, 1, 0}, V3d(0.0)),
                  light_of(LightKind::point, {0, 1e-2f, 0}, {0.01, 1, 0}, V3d(0.0)),
                  light_of(LightKind::directional, {0, 0, 1e-3f}, {0, 1, 0}, V3d(0.0))};
  const std::array<Mean, 3> irradiance = measure(scene, level, 256);
  EXPECT_NEAR(irradiance[0].value, 1e6, sigmas * irradiance[0].error + 1e-3 * 1e6);
  EXPECT_NEAR(irradiance[2].value, 1e-3, sigmas * irradiance[2].error + 1e-6);
  EXPECT_LT(irradiance[2].error, 0.05 * 1e-3);
}

// ---- what is in between -----------------------------------------------------------------------

TEST(irradiance, partly_opaque_sheets_in_between) {
  Material veil = diffuse(Color(0.0f));
  veil.alpha_mode = AlphaMode::blend;
  veil.opacity = 0.3f;
  Scene scene;
  add_mesh(scene, quad({-0.5f, 1, -0.3f}, {1, 0, 0}, {0, 0, 1}), emitter(Color(5.0f)));
  const double open =
      5.0 * polygon_irradiance(rectangle({-0.5, 1, -0.3}, {1, 0, 0}, {0, 0, 1}), level);
  for (int sheets = 1; sheets <= 3; ++sheets) {
    const auto height = static_cast<float>(0.2 * sheets);
    add_mesh(scene, quad({-5, height, -5}, {10, 0, 0}, {0, 0, 10}), veil);
    expect_mean(measure(scene, level, 256)[0], open * std::pow(0.7, sheets), 0.01);
  }
}

TEST(irradiance, masked_sheet_in_between) {
  for (const float opacity : {0.49f, 0.51f}) {
    Material veil = diffuse(Color(0.0f));
    veil.alpha_mode = AlphaMode::mask;
    veil.opacity = opacity;
    Scene scene;
    add_mesh(scene, quad({-0.5f, 1, -0.3f}, {1, 0, 0}, {0, 0, 1}), emitter(Color(5.0f)));
    add_mesh(scene, quad({-5, 0.5f, -5}, {10, 0, 0}, {0, 0, 10}), veil);
    const double open =
        5.0 * polygon_irradiance(rectangle({-0.5, 1, -0.3}, {1, 0, 0}, {0, 0, 1}), level);
    expect_mean(measure(scene)[0], opacity < 0.5f ? open : 0.0);
  }
}

TEST(irradiance, opaque_disc_in_between) {
  Scene scene;
  add_mesh(scene, quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), emitter(Color(5.0f)));
  add_mesh(scene, quad({-0.25f, 0.5f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}), diffuse(Color(0.0f)));
  const double open = polygon_irradiance(rectangle({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), level);
  const double shade =
      polygon_irradiance(rectangle({-0.25, 0.5, -0.25}, {0.5, 0, 0}, {0, 0, 0.5}), level);
  expect_mean(measure(scene)[0], 5.0 * (open - shade));
}

}  // namespace
}  // namespace lumivec::test
