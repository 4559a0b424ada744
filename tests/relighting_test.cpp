// Cached light is lit again by the surface it falls on: detail that is finer than the records stays
// as sharp as in the reference, and what depends on the view follows the eye.
#include <cstdio>

#include "cornell_scene.h"

namespace lumivec::test {
namespace {

constexpr int size = 128, block = 16;

RenderSettings by_light_vectors(int side, int samples) {
  RenderSettings settings = square(side, samples, 0);
  settings.integrator = Integrator::light_vectors;
  return settings;
}

// A floor, and a wall beside it that a lamp turned towards it makes bright: indirect light comes
// from one side.
Scene floor_beside_a_wall(const Material& floor) {
  Scene scene;
  add_mesh(scene, quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}), floor);
  add_mesh(scene, quad({1.2f, 0, -2}, {0, 0, 4}, {0, 2, 0}), diffuse(Color(0.8f)));
  add_mesh(scene, quad({0.6f, 1.5f, -0.3f}, {0, 0, 0.6f}, {0, -0.3f, 0}), emitter(Color(20.0f)));
  return scene;
}

TextureMap texture_of(Scene& scene, const std::vector<std::array<int, 4>>& texels) {
  TextureMap map;
  map.image = add_image(scene, 64, 64, texels);
  map.filter = Filter::nearest;
  return map;
}

template <typename Texel>
std::vector<std::array<int, 4>> texels(const Texel& texel) {
  std::vector<std::array<int, 4>> all;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) all.push_back(texel(x, y));
  }
  return all;
}

// What each pixel differs by from the mean of the block around it, relative to that mean.
std::vector<double> detail(const std::vector<Color>& pixels) {
  const std::vector<Color> means = blocks(pixels, size, block);
  std::vector<double> result;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double mean = means[std::size_t(y / block * (size / block) + x / block)].y;
      result.push_back(pixels[std::size_t(y * size + x)].y / mean - 1.0);
    }
  }
  return result;
}

double product(const std::vector<double>& a, const std::vector<double>& b, int part, int parts) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (static_cast<int>(i / std::size_t(size) / block) % parts == part) sum += a[i] * b[i];
  }
  return sum;
}

// How much of the reference's detail the cached picture has. Two references, so that the noise of
// one does not count as detail.
void expect_full_contrast(const Scene& scene, double tolerance) {
  const Camera camera = orthographic_camera({0, 3, 0}, {0, 0, 0}, 0.98f);
  RenderSettings settings = by_light_vectors(size, 8);
  RenderStatistics statistics;
  const Framebuffer cached = render(scene, camera, settings, statistics);
  EXPECT_LT(statistics.records, size * size / 40u) << "not few records";
  const auto details = [](const Framebuffer& picture) {
    return detail(term(picture, Term::indirect));
  };
  const std::vector<double> ours = details(cached);
  const std::vector<double> a = details(render_clean(scene, camera, square(size, 256, 1))),
                            b = details(render_clean(scene, camera, square(size, 256, 2)));
  constexpr int parts = size / block;
  double sum = 0.0, squares = 0.0;
  for (int i = 0; i < parts; ++i) {
    const double contrast =
        0.5 * (product(ours, a, i, parts) + product(ours, b, i, parts)) / product(a, b, i, parts);
    sum += contrast;
    squares += contrast * contrast;
  }
  const double mean = sum / parts;
  const double error = std::sqrt(std::max(0.0, squares / parts - mean * mean) / (parts - 1));
  std::printf("contrast %.4f of the reference's, standard error %.4f, %zu records\n", mean, error,
              std::size_t(statistics.records));
  EXPECT_NEAR(mean, 1.0, sigmas * error + tolerance);
  EXPECT_LT(error, 0.03) << "too noisy to tell";
}

TEST(relighting, texture_keeps_its_contrast) {
  Scene scene = floor_beside_a_wall(diffuse(Color(1.0f)));
  scene.materials[0].base_color_map = texture_of(scene, texels([](int x, int y) {
                                                   const int c = (x / 4 + y / 4) % 2 ? 220 : 60;
                                                   return std::array{c, c, c, 255};
                                                 }));
  expect_full_contrast(scene, 0.01);
}

// Of light from one side and light from everywhere, which is what a record knows, the bent normals
// make a little less or more than of the light itself.
TEST(relighting, bumps_keep_their_contrast) {
  Scene scene = floor_beside_a_wall(diffuse(Color(0.6f)));
  scene.materials[0].normal_map = texture_of(scene, texels([](int x, int y) {
                                               const int u = x % 8 < 4 ? 170 : 86;
                                               const int v = y % 8 < 4 ? 150 : 106;
                                               return std::array{u, v, 240, 255};
                                             }));
  expect_full_contrast(scene, 0.1);
}

// The highlight of a glossy block follows the eye: at no view is the picture further off than at
// the first, but by chance.
TEST(relighting, glossy_reflections_follow_the_eye) {
  CornellOptions options;
  options.specular = false;
  Scene scene = cornell_scene(options);
  add_mesh(scene, box({-0.3f, -0.6f, -0.3f}, {0.3f, 0.6f, 0.3f}), metal(Color(0.9f), 0.2f),
           rotation({0, 1, 0}, 0.3) * translation({0.3, -0.4, -0.4}));
  constexpr int side = 64;
  double first = 0.0;
  for (int step = 0; step <= 3; ++step) {
    const double angle = step * 5.0 * pi / 180.0;
    const Camera camera =
        perspective_camera({3.2 * std::sin(angle), 0, 3.2 * std::cos(angle)}, V3d(0.0), 0.8);
    const Framebuffer reference = render_clean(scene, camera, square(side, 256, 3));
    const Framebuffer cached = render_clean(scene, camera, by_light_vectors(side, 16));
    double sum = 0.0;
    int count = 0;
    const int block_instance = static_cast<int>(scene.instances.size()) - 1;
    for (std::size_t i = 0; i < reference.object.size(); ++i) {
      if (reference.object[i] != block_instance || cached.object[i] != block_instance) continue;
      const double b = reference.beauty(i).y, d = cached.beauty(i).y - b;
      sum += d * d / (b * b + 0.01);
      ++count;
    }
    ASSERT_GT(count, 200);
    const double error = sum / count;
    if (step == 0) first = error;
    std::printf("%d degrees: relMSE %.5f over %d pixels\n", 5 * step, error, count);
    // Of a mean of squares over several hundred pixels, three times the standard error.
    EXPECT_LT(error, first * (1.0 + 3.0 * std::sqrt(2.0 * 2.0 / count)) * 1.25)
        << 5 * step << " degrees";
    EXPECT_LT(error, 0.05);
  }
}

}  // namespace
}  // namespace lumivec::test
