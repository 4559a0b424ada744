// Light that photons bring, against closed forms and against the path tracer.
#include "integrator/photon_map.h"

#include <functional>

#include "cornell_scene.h"

namespace lumivec::test {
namespace {

constexpr float albedo = 0.5f;

Light point_light(float intensity, const V3d& position) {
  Light light;
  light.intensity = Color(intensity);
  light.object_to_world = translation(position);
  return light;
}

RenderSettings by_light_vectors(int size, int samples, std::uint64_t seed = 0) {
  RenderSettings settings = square(size, samples, seed);
  settings.integrator = Integrator::light_vectors;
  return settings;
}

void add_floor(Scene& scene, float half) {
  add_mesh(scene, quad({-half, 0, -half}, {0, 0, 2 * half}, {2 * half, 0, 0}),
           diffuse(Color(albedo)));
}

// Means of the terms' green channels over pixels that a test chooses, over seeds: pixels of one
// picture share photons, so that their spread says nothing of the mean's.
using Chosen = std::function<bool(int x, int y)>;
std::array<Mean, term_count> mean_terms(const Scene& scene, const Camera& camera,
                                        RenderSettings settings, int seeds,
                                        const Chosen& chosen = {}) {
  std::array<Mean, term_count> result;
  std::array<double, term_count> squares{};
  for (int s = 1; s <= seeds; ++s) {
    settings.seed = static_cast<std::uint64_t>(s);
    const Framebuffer picture = render_clean(scene, camera, settings);
    for (std::size_t t = 0; t < term_count; ++t) {
      double sum = 0.0;
      int count = 0;
      for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
          if (chosen && !chosen(x, y)) continue;
          sum += picture.terms[t][std::size_t(y * picture.width + x)].y;
          ++count;
        }
      }
      result[t].value += sum / count / seeds;
      squares[t] += sum / count * (sum / count) / seeds;
    }
  }
  for (std::size_t t = 0; t < term_count; ++t) {
    const double variance = std::max(0.0, squares[t] - result[t].value * result[t].value);
    result[t].error = std::sqrt(variance / (seeds - 1));
  }
  return result;
}
Mean mean_of_term(const Scene& scene, const Camera& camera, const RenderSettings& settings, Term of,
                  const Chosen& chosen = {}) {
  return mean_terms(scene, camera, settings, 6, chosen)[static_cast<std::size_t>(of)];
}

// sigmas of few seeds, and what the disc blurs.
void expect_brightness(const Mean& mean, double expected, double tolerance = 0.01) {
  EXPECT_NEAR(mean.value, expected, 5.0 * mean.error + tolerance * expected)
      << "off by " << mean.value / expected - 1.0 << ", error " << mean.error / expected;
  EXPECT_LT(mean.error, 0.03 * expected) << "too noisy to tell";
}

// Through a plate of index 1, on a floor little larger than what is seen: the discs of its rim's
// pixels reach beyond it.
TEST(photon_map, point_and_ball_lights_on_a_small_floor) {
  const V3d at(0.3, 2, 0);
  const double expected = albedo / pi * 7.0 * at.normalized().y / at.length2();
  for (const double radius : {0.0, 0.1, 0.5}) {
    Scene scene;
    if (radius == 0.0) {
      scene.lights = {point_light(7.0f, at)};
    } else {
      add_sphere(scene, static_cast<float>(radius),
                 emitter(Color(static_cast<float>(7.0 / (pi * radius * radius)))), translation(at));
    }
    add_mesh(scene, box({-0.5f, 0.5f, -0.5f}, {0.5f, 0.8f, 0.5f}), glass(1.0f));
    // A solid body: its sides are where the floor ends.
    add_mesh(scene, box({-0.11f, -0.2f, -0.11f}, {0.11f, 0.0f, 0.11f}), diffuse(Color(albedo)));
    const Camera camera = orthographic_camera({0, 0.01, 0}, {0, 0, 0}, 0.1f);
    expect_brightness(mean_of_term(scene, camera, by_light_vectors(16, 8), Term::caustic), expected,
                      0.02);
  }
}

// At the foot of a black wall the floor is as bright as in the open.
TEST(photon_map, walls_leave_no_dark_rim) {
  Scene scene;
  scene.lights = {point_light(700.0f, {0, 20, 0})};
  add_mesh(scene, box({-3, 5, -3}, {3, 5.5f, 3}), glass(1.0f));
  add_floor(scene, 1.0f);
  add_mesh(scene, box({-0.5f, 0, -0.9f}, {0.0f, 0.4f, 0.9f}), diffuse(Color(0.0f)));
  const Camera camera = orthographic_camera({0.4, 3, 0}, {0.4, 0, 0}, 0.4f);
  const RenderSettings settings = by_light_vectors(64, 8);
  const Framebuffer where = render_clean(scene, camera, square(64, 1));
  for (const auto& [from, to] : {std::pair(0.013f, 0.04f), std::pair(0.2f, 0.6f)}) {
    const Mean mean = mean_of_term(scene, camera, settings, Term::caustic,
                                   [&, from = from, to = to](int x, int y) {
                                     const float at = where.position[std::size_t(y * 64 + x)].x;
                                     return at > from && at < to;
                                   });
    expect_brightness(mean, albedo / pi * 700.0 / 400.0, from < 0.1f ? 0.05 : 0.01);
  }
}

// What eye paths and light paths that are connected to the eye both miss: a punctual light's
// caustic seen through glass.
TEST(photon_map, caustic_of_a_point_light_seen_through_glass) {
  Scene scene;
  const V3d at(0.3, 2, 0);
  scene.lights = {point_light(7.0f, at)};
  add_mesh(scene, box({-2, 0.5f, -2}, {2, 0.8f, 2}), absorbing_glass(1.0f, Color(0.5f), 0.3f));
  add_floor(scene, 0.5f);
  const Camera camera = orthographic_camera({0, 1.5, 0}, {0, 0, 0}, 0.1f);
  const double cosine = at.normalized().y;
  const double expected =
      albedo / pi * 7.0 * cosine / at.length2() * std::pow(0.5, 1.0 / cosine) * 0.5;
  expect_brightness(mean_of_term(scene, camera, by_light_vectors(16, 8), Term::specular), expected,
                    0.02);
}

// Every path is counted once, whatever specular and glossy events it is made of.
TEST(photon_map, every_term_agrees_with_paths) {
  for (const float roughness : {0.05f, 0.25f}) {
    Scene scene = cornell_scene();
    Material shiny = metal(Color(0.9f));
    shiny.roughness = roughness;
    add_sphere(scene, 0.3f, shiny, translation({-0.5, -0.6, 0.3}));
    add_sphere(scene, 0.25f, glass(1.5f), translation({0.5, -0.7, 0.5}));
    const Camera camera = cornell_camera();
    const auto reference = mean_terms(scene, camera, square(24, 512), 4);
    const auto cached = mean_terms(scene, camera, by_light_vectors(24, 16), 4);
    for (std::size_t t = 0; t < term_count; ++t) {
      const double error = std::hypot(reference[t].error, cached[t].error);
      EXPECT_NEAR(cached[t].value, reference[t].value, 5.0 * error + 0.02 * reference[t].value)
          << term_names[t] << ", roughness " << roughness << ": off by "
          << cached[t].value / reference[t].value - 1.0;
    }
  }
}

// The same under a sky with a sun, all of whose caustics photons bring.
TEST(photon_map, every_term_agrees_with_paths_under_a_sun) {
  Scene scene;
  set_sky_and_sun(scene);
  Material varnished = diffuse(Color(albedo));
  varnished.specular = 1.0f;
  varnished.roughness = 0.5f;
  add_mesh(scene, quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}), varnished);
  add_sphere(scene, 0.4f, glass(1.5f), translation({0.5, 0.5, 0.2}));
  Material brushed = metal(Color(0.9f, 0.8f, 0.6f));
  brushed.roughness = 0.25f;
  add_sphere(scene, 0.4f, brushed, translation({-0.5, 0.4, 0.2}));
  add_sphere(scene, 0.3f, diffuse(Color(0.8f, 0.3f, 0.2f)), translation({0.0, 0.3, 0.9}));
  const Camera camera = orthographic_camera({0, 3, 4}, {0, 0.2, 0}, 1.2f);
  const auto reference = mean_terms(scene, camera, square(24, 1024), 4);
  const auto cached = mean_terms(scene, camera, by_light_vectors(24, 16), 4);
  for (std::size_t t = 0; t < term_count; ++t) {
    const double error = std::hypot(reference[t].error, cached[t].error);
    EXPECT_NEAR(cached[t].value, reference[t].value, 5.0 * error + 0.02 * reference[t].value)
        << term_names[t] << ": off by " << cached[t].value / reference[t].value - 1.0;
    // Without photons, what mirrors show of the sun's caustics is left to chance.
    EXPECT_LT(error, (Term(t) == Term::specular ? 0.15 : 0.05) * reference[t].value)
        << term_names[t];
  }
}

// Discs shrink from map to map: the picture nears the reference, at the sharp edge of the light
// that a mirror throws, where the squared error goes with the radius: with the fourth root of the
// number of maps, of which eight times as many samples have four to seven times as many.
TEST(photon_map, error_falls_as_maps_are_added) {
  Scene scene;
  scene.lights = {point_light(7.0f, {0.5, 1.0, 0.0})};
  add_mesh(scene, quad({-0.75f, 0, -0.3f}, {0, 0.6f, 0}, {0, 0, 0.6f}), metal(Color(1.0f)));
  add_floor(scene, 1.0f);
  const Camera camera = orthographic_camera({0, 3, 0}, {0, 0, 0}, 0.7f);
  const Framebuffer reference = render_clean(scene, camera, square(32, 4096));
  double last = 0.0;
  for (const int samples : {4, 32, 256}) {
    const Framebuffer picture = render_clean(scene, camera, by_light_vectors(32, samples));
    double squares = 0.0;
    for (std::size_t i = 0; i < picture.pixel_count(); ++i) {
      const double d = term(picture, Term::caustic)[i].y - term(reference, Term::caustic)[i].y;
      squares += d * d;
    }
    if (last > 0.0) {
      EXPECT_LT(squares, 0.9 * last) << samples;
    }
    last = squares;
  }
}

TEST(photon_map, same_for_any_number_of_threads) {
  Scene scene = cornell_scene();
  add_sphere(scene, 0.3f, glass(1.5f), translation({0.3, -0.6, 0.3}));
  RenderSettings settings = by_light_vectors(24, 6);
  settings.threads = 1;
  const Framebuffer one = render_clean(scene, cornell_camera(), settings);
  settings.threads = 3;
  const Framebuffer three = render_clean(scene, cornell_camera(), settings);
  for (std::size_t t = 0; t < term_count; ++t) EXPECT_EQ(one.terms[t], three.terms[t]);
}

}  // namespace
}  // namespace lumivec::test
