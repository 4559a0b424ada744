// Light that reaches a floor over mirrors and through glass, against closed forms: from lights that
// eye paths find and from those that only light paths find.
#include "cornell_scene.h"
#include "integrator/path_tracer.h"

namespace lumivec::test {
namespace {

constexpr float albedo = 0.5f;

// Irradiance that the origin receives over specular surfaces, and directly.
struct Received {
  Mean caustic, direct;
};

Received receive(Scene scene, int samples, float floor_size = 0.11f, float view = 0.1f) {
  const float s = floor_size;
  add_mesh(scene, quad({-s, 0, -s}, {0, 0, 2 * s}, {2 * s, 0, 0}), diffuse(Color(albedo)));
  const Framebuffer picture =
      render_clean(scene, orthographic_camera({0, 0.01, 0}, {0, 0, 0}, view), square(16, samples));
  Received result{mean_of(term(picture, Term::caustic), 1),
                  mean_of(term(picture, Term::direct), 1)};
  for (Mean* m : {&result.caustic, &result.direct}) {
    m->value *= pi / albedo;
    m->error *= pi / albedo;
  }
  return result;
}

Light point_light(float intensity, const V3d& position) {
  Light light;
  light.intensity = Color(intensity);
  light.object_to_world = translation(position);
  return light;
}

// A sphere that is as bright from afar as a point light.
void add_ball_light(Scene& scene, double intensity, double radius, const V3d& position) {
  add_sphere(scene, static_cast<float>(radius),
             emitter(Color(static_cast<float>(intensity / (pi * radius * radius)))),
             translation(position));
}

void add_plate(Scene& scene, float from, float to, const Material& material, float size = 0.5f) {
  add_mesh(scene, box({-size, from, -size}, {size, to, size}), material);
}

void expect_received(const Mean& mean, double expected, double tolerance = 0.01,
                     double largest_error = 0.05) {
  EXPECT_NEAR(mean.value, expected, sigmas * mean.error + tolerance * expected)
      << "off by " << mean.value / expected - 1.0;
  EXPECT_LT(mean.error, largest_error * expected) << "too noisy to tell";
}

// Of index 1: nothing is bent or reflected, but it is an event.
TEST(caustic, point_light_through_a_plate_of_index_one) {
  Scene scene;
  scene.lights = {point_light(7.0f, {0.3, 2, 0})};
  add_plate(scene, 0.5f, 0.8f, absorbing_glass(1.0f, Color(0.5f), 0.3f));
  const Received r = receive(scene, 1024);
  const V3d d(0.3, 2, 0);
  const double cosine = d.normalized().y;
  expect_received(r.caustic, 7.0 * cosine / d.length2() * std::pow(0.5, 1.0 / cosine));
  EXPECT_EQ(r.direct.value, 0.0);
}

TEST(caustic, ball_lights_through_a_plate_of_index_one) {
  // Of sizes that light paths, eye paths, or both take care of.
  for (const double radius : {0.001, 0.1, 0.5}) {
    Scene scene;
    add_ball_light(scene, 7.0, radius, {0.3, 2, 0});
    add_plate(scene, 0.5f, 0.8f, glass(1.0f));
    const V3d d(0.3, 2, 0);
    expect_received(receive(scene, 1024).caustic, 7.0 * d.normalized().y / d.length2());
  }
}

// The image of the light moves up; further images by reflection in the plate, each dimmer.
double under_plate(double intensity, double distance, double thickness, double n) {
  const double r = std::pow((n - 1) / (n + 1), 2);
  double sum = 0.0, share = (1 - r) * (1 - r);
  for (int k = 0; k < 20; ++k) {
    const double d = distance - thickness + (2 * k + 1) * thickness / n;
    sum += intensity * share / (d * d);
    share *= r * r;
  }
  return sum;
}

TEST(caustic, lights_through_a_plate_of_glass) {
  Scene point;
  point.lights = {point_light(7.0f, {0, 2, 0})};
  add_plate(point, 0.5f, 0.7f, glass(1.5f));
  expect_received(receive(point, 1024).caustic, under_plate(7.0, 2.0, 0.2, 1.5));
  for (const double radius : {0.005, 0.1}) {
    Scene ball;
    add_ball_light(ball, 7.0, radius, {0, 2, 0});
    add_plate(ball, 0.5f, 0.7f, glass(1.5f));
    expect_received(receive(ball, 1024).caustic, under_plate(7.0, 2.0, 0.2, 1.5), 0.02);
  }
}

TEST(caustic, directional_light_through_a_plate_of_glass) {
  Scene scene;
  Light sun;
  sun.kind = LightKind::directional;
  sun.intensity = Color(3.0f);
  sun.object_to_world = look_at({0, 1, 0}, {0, 0, 0}, {0, 0, -1});
  scene.lights = {sun};
  add_plate(scene, 0.5f, 0.7f, glass(1.5f));
  const double r = 0.04;
  expect_received(receive(scene, 512).caustic, 3.0 * (1 - r) * (1 - r) / (1 - r * r));
}

// A mirror beside the floor shows the light a second time.
TEST(caustic, mirror_image_of_a_light) {
  const V3d light(0.5, 1.0, 0.0), image(-1.5 - 0.5, 1.0, 0.0);  // in the plane x = -0.75
  for (const double radius : {0.0, 0.005, 0.1}) {
    Scene scene;
    if (radius == 0.0) {
      scene.lights = {point_light(7.0f, light)};
    } else {
      add_ball_light(scene, 7.0, radius, light);
    }
    Material mirror = metal(Color(1.0f));
    add_mesh(scene, quad({-0.75f, 0, -0.3f}, {0, 0.6f, 0}, {0, 0, 0.6f}), mirror);
    const Received r = receive(scene, 1024);
    expect_received(r.direct, 7.0 * light.normalized().y / light.length2());
    expect_received(r.caustic, 7.0 * image.normalized().y / image.length2());
  }
}

// Spots keep their cone on light paths.
TEST(caustic, spot_light_over_a_mirror) {
  const V3d light(0.5, 1.0, 0.0), reflected(-0.75, 0.375 + 0.0, 0.0);
  // The mirror at x = -0.75 reflects where the line from the image (-2, 1, 0) to the origin meets
  // it.
  for (const double angle : {0.0, 0.45, 0.6}) {
    Scene scene;
    Light spot = point_light(7.0f, light);
    spot.kind = LightKind::spot;
    spot.inner_cone = 0.35f;
    spot.outer_cone = 0.5f;
    const V3d axis = (reflected - light) * rotation({0, 0, 1}, angle);
    spot.object_to_world = look_at(light, light + axis, {0, 0, 1});
    scene.lights = {spot};
    add_mesh(scene, quad({-0.75f, 0, -0.3f}, {0, 0.6f, 0}, {0, 0, 0.6f}), metal(Color(1.0f)));
    const double ramp =
        std::clamp((std::cos(angle) - std::cos(0.5)) / (std::cos(0.35) - std::cos(0.5)), 0.0, 1.0);
    const V3d image(-2.0, 1.0, 0.0);
    const double full = 7.0 * image.normalized().y / image.length2();
    const Mean mean = receive(scene, 512).caustic;
    EXPECT_NEAR(mean.value, ramp * ramp * full, sigmas * mean.error + 0.03 * full) << angle;
  }
}

// A glass ball focuses: small lights, which light paths take care of, bring what larger ones do,
// which eye paths find. All the light that the ball throws on a large floor is compared.
TEST(caustic, glass_ball) {
  std::vector<Mean> means;
  for (const double radius : {0.0, 0.06, 0.4}) {
    Scene scene;
    if (radius == 0.0) {
      scene.lights = {point_light(7.0f, {0, 3, 0})};
    } else {
      add_ball_light(scene, 7.0, radius, {0, 3, 0});
    }
    add_sphere(scene, 0.5f, glass(1.5f), translation({0, 1.2, 0}));
    add_mesh(scene, quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}), diffuse(Color(albedo)));
    const Camera camera = orthographic_camera({0, 0.3, 0}, {0, 0, 0}, 0.7f);
    std::vector<double> values;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      const Framebuffer picture = render_clean(scene, camera, square(16, 512, seed));
      values.push_back(mean_of(term(picture, Term::caustic), 1).value);
    }
    Mean mean;
    for (const double v : values) mean.value += v / 4.0;
    for (const double v : values) mean.error += (v - mean.value) * (v - mean.value) / 12.0;
    mean.error = std::sqrt(mean.error);
    means.push_back(mean);
  }
  for (const Mean& mean : means) {
    EXPECT_GT(mean.value, 0.0);
    EXPECT_NEAR(mean.value, means[0].value,
                6.0 * (mean.error + means[0].error) + 0.01 * means[0].value);
    EXPECT_LT(mean.error, 0.03 * mean.value);
  }
}

// A lamp inside of absorbing glass: its light is absorbed from the start.
TEST(caustic, lamp_inside_absorbing_glass) {
  for (const double radius : {0.0, 0.02}) {
    Scene scene;
    if (radius == 0.0) {
      scene.lights = {point_light(7.0f, {0, 1, 0})};
    } else {
      add_ball_light(scene, 7.0, radius, {0, 1, 0});
    }
    add_sphere(scene, 0.3f, absorbing_glass(1.0f, Color(0.5f), 0.3f), translation({0, 1, 0}));
    expect_received(receive(scene, 1024).caustic, 7.0 * 0.5, 0.05, 0.1);
  }
}

TEST(caustic, no_light_twice) {
  Scene scene;
  scene.lights = {point_light(7.0f, {0.3, 2, 0})};
  add_ball_light(scene, 3.0, 0.01, {-0.4, 1.5, 0.2});
  add_plate(scene, 0.5f, 0.8f, glass(1.0f));
  Scene both = scene;
  const Received plain = receive(scene, 1024);
  // A second plate of index 1 changes nothing.
  add_plate(both, 0.2f, 0.3f, glass(1.0f), 0.3f);
  Mean mean = receive(both, 1024).caustic;
  mean.error += plain.caustic.error;
  expect_received(mean, plain.caustic.value, 0.02, 0.05);
}

// All terms by eye paths alone, without the help of light paths; for lamps that they can find.
Framebuffer render_by_eye_paths(const Scene& scene, const Camera& camera,
                                const RenderSettings& settings) {
  const TracedScene traced(scene, 0);
  const Lights lights(traced);
  const CameraView view(camera, traced, settings.width, settings.height);
  const PathTracer tracer(traced, lights, view, settings);
  Framebuffer picture;
  picture.width = settings.width;
  picture.height = settings.height;
  for (std::vector<Color>& layer : picture.terms) layer.resize(picture.pixel_count(), Color(0.0f));
  constexpr int tile_size = 16;
  for (int y = 0; y < settings.height; y += tile_size) {
    for (int x = 0; x < settings.width; x += tile_size) {
      std::vector<PixelSums> sums(std::size_t(tile_size) * tile_size);
      RenderStatistics statistics;
      tracer.render_tile({x, y, tile_size, tile_size}, 0, std::uint32_t(settings.samples), sums,
                         statistics);
      for (int i = 0; i < tile_size * tile_size; ++i) {
        const std::size_t pixel =
            std::size_t((y + i / tile_size) * settings.width + x + i % tile_size);
        for (std::size_t t = 0; t < term_count; ++t) {
          picture.terms[t][pixel] =
              sums[std::size_t(i)].terms[t] * (1.0f / static_cast<float>(settings.samples));
        }
      }
    }
  }
  return picture;
}

// The division of labour between eye paths and light paths leaves nothing out and counts nothing
// twice, in any term.
void expect_same_by_eye_paths(const Scene& scene, const Camera& camera, int samples,
                              double caustic_error) {
  const Framebuffer alone = render_by_eye_paths(scene, camera, square(32, samples, 2));
  const Framebuffer both = render_clean(scene, camera, square(32, samples));
  for (std::size_t t = 0; t < term_count; ++t) {
    SCOPED_TRACE(term_names[t]);
    if (mean_of(both.terms[t]).value == 0.0 && mean_of(alone.terms[t]).value == 0.0) continue;
    expect_same_mean(alone.terms[t], both.terms[t],
                     Term(t) == Term::caustic ? caustic_error : 0.03);
  }
}

TEST(caustic, eye_paths_alone_bring_the_same) {
  expect_same_by_eye_paths(cornell_scene(), cornell_camera(), 256, 0.1);
}

TEST(caustic, eye_paths_alone_bring_the_same_through_absorbing_and_rough_glass) {
  CornellOptions options;
  options.specular = false;
  Scene scene = cornell_scene(options);
  add_sphere(scene, 0.3f, absorbing_glass(1.5f, {0.3f, 0.8f, 0.9f}, 0.4f),
             translation({0.5, -0.5, -0.2}));
  Material frosted = glass(1.4f);
  frosted.roughness = 0.1f;
  add_mesh(scene, box({-0.2f, -0.2f, -0.2f}, {0.2f, 0.2f, 0.2f}), frosted,
           rotation({1, 1, 0}, 0.5) * translation({-0.5, 0.0, -0.3}));
  Material varnish = diffuse({0.2f, 0.3f, 0.7f});
  varnish.specular = 1.0f;
  varnish.roughness = 0.05f;
  add_mesh(scene, quad({-0.9f, -0.6f, -0.9f}, {1.2f, 0, 0}, {0, 1.2f, 0.1f}), varnish);
  expect_same_by_eye_paths(scene, cornell_camera(), 256, 0.1);
}

TEST(caustic, eye_paths_alone_bring_the_same_between_bright_sheets) {
  CornellOptions options;
  options.specular = false;
  Scene scene = cornell_scene(options);
  Material sheet = thin_sheet({0.9f, 0.6f, 0.9f});
  sheet.ior = 4.0f;
  for (const float height : {-0.2f, 0.1f, 0.4f}) {
    add_mesh(scene, quad({-0.8f, height, -0.8f}, {0, 0, 1.6f}, {1.6f, 0.1f, 0}), sheet);
  }
  expect_same_by_eye_paths(scene, cornell_camera(), 256, 0.1);
}

TEST(caustic, eye_paths_alone_bring_the_same_over_glossy_metal) {
  CornellOptions options;
  options.specular = false;
  Scene scene = cornell_scene(options);
  Material brushed = diffuse({0.9f, 0.8f, 0.6f});
  brushed.specular = 1.0f;
  brushed.metallic = 1.0f;
  brushed.roughness = 0.25f;
  add_mesh(scene, box({-0.3f, -0.4f, -0.3f}, {0.3f, 0.4f, 0.3f}), brushed,
           rotation({0, 1, 0}, 0.4) * translation({-0.4, -0.6, -0.3}));
  Material mirror = brushed;
  mirror.roughness = 0.0f;
  add_mesh(scene, quad({0.9f, -0.9f, -0.9f}, {0, 0, 1.2f}, {-0.2f, 1.2f, 0}), mirror);
  add_sphere(scene, 0.25f, glass(1.5f), translation({0.4, -0.7, 0.2}));
  expect_same_by_eye_paths(scene, cornell_camera(), 512, 0.1);
}

// Light goes both ways from a panel without a back, and from a ball.
TEST(caustic, eye_paths_alone_bring_the_same_beside_two_sided_lamps) {
  Scene scene;
  add_mesh(scene, quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}), diffuse(Color(albedo)));
  add_mesh(scene, quad({-2, 0, -1}, {4, 0, 0}, {0, 3, 0}), diffuse(Color(albedo)));
  add_mesh(scene, quad({0, 0.5f, -0.3f}, {0, 0.6f, 0}, {0, 0, 0.6f}), emitter(Color(5.0f), true));
  add_sphere(scene, 0.15f, emitter(Color(3.0f, 4.0f, 6.0f), true), translation({0, 1.4, 0.2}));
  add_sphere(scene, 0.3f, glass(1.5f), translation({0.7, 0.5, 0.2}));
  add_sphere(scene, 0.3f, glass(1.5f), translation({-0.7, 0.5, 0.1}));
  const Camera camera = orthographic_camera({0, 3, 4}, {0, 0.2, 0}, 1.2f);
  const Framebuffer picture = render_clean(scene, camera, square(32, 64));
  EXPECT_GT(mean_of(picture.terms[unsigned(Term::caustic)]).value, 0.001);
  expect_same_by_eye_paths(scene, camera, 512, 0.1);
}

// Of the environment, light paths bring the caustics of the sun alone.
TEST(caustic, eye_paths_alone_bring_the_same_under_a_sun) {
  Scene scene;
  set_sky_and_sun(scene);
  add_mesh(scene, quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}), diffuse(Color(albedo)));
  add_sphere(scene, 0.4f, glass(1.5f), translation({0.5, 0.5, 0.2}));
  Material brushed = metal(Color(0.9f, 0.8f, 0.6f));
  brushed.roughness = 0.25f;
  add_sphere(scene, 0.4f, brushed, translation({-0.5, 0.4, 0.2}));
  expect_same_by_eye_paths(scene, orthographic_camera({0, 3, 4}, {0, 0.2, 0}, 1.2f), 512, 0.1);
}

// A sheet of index 1 is no obstacle, whichever way the light comes: an even sky shines through.
TEST(caustic, even_environment_through_a_plate_of_index_one) {
  Scene scene;
  scene.environment.radiance = Color(2.0f);
  add_plate(scene, 0.2f, 0.3f, glass(1.0f), 4.0f);
  const Received r = receive(scene, 1024);
  EXPECT_NEAR(r.caustic.value + r.direct.value, 2.0 * pi,
              sigmas * (r.caustic.error + r.direct.error) + 0.01 * pi);
  EXPECT_GT(r.caustic.value, 5.0);
}

}  // namespace
}  // namespace lumivec::test
