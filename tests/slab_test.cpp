// Light through plates of glass: Fresnel's and Beer's laws in closed form.
#include "test_scenes.h"

namespace lumivec::test {
namespace {

const Color above(1.0f, 2.0f, 4.0f);
const Color below(3.0f, 1.0f, 0.5f);

// Reflectance of unpolarised light at a boundary, n beyond over before.
double fresnel(double cosine, double n) {
  const double sine2 = (1.0 - cosine * cosine) / (n * n);
  if (sine2 >= 1.0) return 1.0;
  const double cos_t = std::sqrt(1.0 - sine2);
  const double p = (n * cosine - cos_t) / (n * cosine + cos_t);
  const double s = (cosine - n * cos_t) / (cosine + n * cos_t);
  return 0.5 * (p * p + s * s);
}

double cosine_inside(double cosine, double n) {
  return std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
}

// A picture of a point of the plane y = 0 by a parallel view that comes down at an angle.
Camera view_down(double angle) {
  const V3d direction(std::sin(angle), std::cos(angle), 0.0);
  return orthographic_camera(direction * 5.0, V3d(0.0), 0.01f);
}

// A plate from y = -thickness to y = 0, so wide that its sides are out of reach.
void add_plate(Scene& scene, float thickness, const Material& material) {
  add_mesh(scene, box({-50, -thickness, -50}, {50, 0, 50}), material);
}

// Everything that the eye sees came over specular events.
std::vector<Color> specular_only(const Scene& scene, const Camera& camera, int samples) {
  const Framebuffer picture = render_clean(scene, camera, square(16, samples));
  for (const Term t : {Term::emitted, Term::direct, Term::indirect, Term::caustic}) {
    expect_black(term(picture, t));
  }
  return term(picture, Term::specular);
}

TEST(slab, absorbs_exponentially) {
  const Color transmittance(0.9f, 0.5f, 0.01f);
  for (const double angle : {0.0, 0.5, 1.2}) {
    for (const float thickness : {0.1f, 1.0f, 2.0f}) {
      Scene scene;
      scene.environment.radiance = above;
      add_plate(scene, thickness, absorbing_glass(1.0f, transmittance, 0.5f));
      const std::vector<Color> seen = specular_only(scene, view_down(angle), 64);
      for (int c = 0; c < 3; ++c) {
        const double expected =
            above[c] * std::pow(double(transmittance[c]), thickness / std::cos(angle) / 0.5);
        // Rays start a little off the surface they leave, which shortens thin plates.
        if (expected > 1e-6) {
          const Mean mean = mean_of(seen, c);
          EXPECT_NEAR(mean.value, expected, sigmas * mean.error + 0.005 * expected);
          EXPECT_LT(mean.error, 0.05 * expected);
        }
      }
    }
  }
}

// Reflected and transmitted parts of a plate of index n of internal transmittance t.
struct Plate {
  double reflected, transmitted;
};
Plate plate(double cosine, double n, double t) {
  const double r = fresnel(cosine, n);
  const double twice = 1.0 - r * r * t * t;
  return {r + (1 - r) * (1 - r) * r * t * t / twice, (1 - r) * (1 - r) * t / twice};
}

TEST(slab, reflects_and_transmits) {
  const Color transmittance(1.0f, 0.6f, 0.2f);
  for (const double angle : {0.0, 0.25 * pi, 1.2}) {
    Scene scene;
    set_sky_and_ground(scene, above, below);
    add_plate(scene, 0.3f, absorbing_glass(1.5f, transmittance, 0.3f));
    const std::vector<Color> seen = specular_only(scene, view_down(angle), 256);
    for (int c = 0; c < 3; ++c) {
      const double t =
          std::pow(double(transmittance[c]), 1.0 / cosine_inside(std::cos(angle), 1.5));
      const Plate p = plate(std::cos(angle), 1.5, t);
      expect_mean(mean_of(seen, c), p.reflected * above[c] + p.transmitted * below[c], 0.01);
    }
  }
}

TEST(slab, clear_glass_in_a_constant_environment_is_invisible) {
  Scene scene;
  scene.environment.radiance = above;
  add_plate(scene, 0.3f, glass(1.5f));
  add_sphere(scene, 1.0f, glass(1.33f), translation({0, 2, 0}));
  const std::vector<Color> seen = specular_only(scene, view_down(0.3), 64);
  for (int c = 0; c < 3; ++c) expect_mean(mean_of(seen, c), above[c]);
}

TEST(slab, black_glass_reflects_by_fresnel) {
  for (const float ior : {1.1f, 1.5f, 2.4f}) {
    for (const double angle : {0.0, 0.5, 1.0, 1.4, 1.55}) {
      Scene scene;
      scene.environment.radiance = above;
      add_plate(scene, 1.0f, absorbing_glass(ior, Color(1e-6f), 1e-2f));
      const std::vector<Color> seen = specular_only(scene, view_down(angle), 256);
      expect_mean(mean_of(seen, 1), fresnel(std::cos(angle), ior) * above.y, 0.02);
    }
  }
}

// The incoherent sum over a stack of boundaries, from the far side up: what comes back up.
double stack_radiance(const std::vector<double>& reflectances, double up, double down) {
  // Reflectance and transmittance of the boundaries so far, by adding (no absorption).
  double r = reflectances.back(), t = 1.0 - r;
  for (std::size_t i = reflectances.size() - 1; i-- > 0;) {
    const double r1 = reflectances[i], t1 = 1.0 - r1;
    const double twice = 1.0 - r1 * r;
    const double sum_r = r1 + t1 * t1 * r / twice;
    t = t1 * t / twice;
    r = sum_r;
  }
  return r * up + t * down;
}

TEST(slab, nested_boxes) {
  for (const float inner : {1.0f, 1.33f, 1.5f, 2.0f}) {
    Scene scene;
    set_sky_and_ground(scene, above, below);
    add_plate(scene, 1.0f, glass(1.5f));
    add_mesh(scene, box({-40, -0.7f, -40}, {40, -0.3f, 40}), glass(inner));
    const double r = fresnel(1.0, 1.5), q = fresnel(1.0, inner / 1.5);
    const std::vector<Color> seen = specular_only(scene, view_down(0.0), 256);
    for (int c = 0; c < 3; ++c) {
      expect_mean(mean_of(seen, c), stack_radiance({r, q, q, r}, above[c], below[c]), 0.01);
    }
  }
}

// A box in a box of the same material: there is no boundary, going in or coming out.
TEST(slab, nested_boxes_of_the_same_material) {
  Scene scene;
  set_sky_and_ground(scene, above, below);
  add_plate(scene, 1.0f, glass(1.5f));
  const int inner = add_mesh(scene, box({-40, -0.7f, -40}, {40, -0.3f, 40}), glass(1.5f));
  scene.instances[std::size_t(inner)].material = 0;
  const double r = fresnel(1.0, 1.5);
  const std::vector<Color> seen = specular_only(scene, view_down(0.0), 256);
  for (int c = 0; c < 3; ++c) {
    expect_mean(mean_of(seen, c), stack_radiance({r, r}, above[c], below[c]), 0.01);
  }
}

// Radiance divided by the squared index is what a beam keeps: inside, the same surroundings are n²
// as bright, and clear glass that has an outlet shows nothing else.
TEST(slab, eye_inside_glass) {
  Scene scene;
  scene.environment.radiance = above;
  add_plate(scene, 1.0f, glass(1.5f));
  const double inside_angles[] = {0.0, 0.3, 0.6};
  for (const double angle : inside_angles) {
    const V3d eye(0, -0.5, 0);
    const Camera camera =
        orthographic_camera(eye, eye + V3d(std::sin(angle), std::cos(angle), 0), 0.01f);
    const std::vector<Color> seen = specular_only(scene, camera, 256);
    for (int c = 0; c < 3; ++c) expect_mean(mean_of(seen, c), 2.25 * above[c]);
  }
}

TEST(slab, eye_inside_absorbing_glass) {
  Scene scene;
  set_sky_and_ground(scene, above, below);
  const Color transmittance(1.0f, 0.6f, 0.2f);
  add_plate(scene, 1.0f, absorbing_glass(1.5f, transmittance, 1.0f));
  const Camera camera = orthographic_camera({0, -0.25, 0}, {0, 0, 0}, 0.01f);
  const std::vector<Color> seen = specular_only(scene, camera, 256);
  const double r = fresnel(1.0, 1.5);
  for (int c = 0; c < 3; ++c) {
    const double t = transmittance[c];
    const double n2 = 1.5 * 1.5, first = std::pow(t, 0.25);
    const double expected =
        n2 * first * (1 - r) * (above[c] + r * t * below[c]) / (1 - r * r * t * t);
    expect_mean(mean_of(seen, c), expected, 0.01);
  }
}

// Light that total reflection keeps in a box for ever: nothing to be seen, and the paths end.
TEST(slab, total_reflection) {
  Scene scene;
  scene.environment.radiance = above;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}), glass(1.5f));
  const Camera diagonal = orthographic_camera({0.1, 0.2, -0.1}, {1.1, 1.2, 0.9}, 0.01f);
  expect_black(beauty(render_clean(scene, diagonal, square(4, 4))));

  // A plate's lower face reflects all light of 60° against the normal; so does the upper one, up to
  // the dark rim.
  Scene wide;
  wide.environment.radiance = above;
  add_plate(wide, 1.0f, absorbing_glass(1.5f, Color(0.5f), 1.0f));
  const V3d eye(0, -0.5, 0);
  const Camera flat =
      orthographic_camera(eye, eye + V3d(std::sin(pi / 3), -std::cos(pi / 3), 0), 0.01f);
  for (const Color& c : beauty(render_clean(wide, flat, square(4, 16)))) EXPECT_LT(c.y, 1e-6f);
}

// ---- thin sheets ------------------------------------------------------------------------------

const Color tint(0.9f, 0.5f, 0.1f);

void add_sheet(Scene& scene, float height, const Material& material,
               const M44d& transform = M44d()) {
  add_mesh(scene, quad({-50, height, -50}, {0, 0, 100}, {100, 0, 0}), material, transform);
}

TEST(thin_sheet, reflects_and_transmits) {
  for (const double angle : {0.0, 0.25 * pi, 1.2}) {
    Scene scene;
    set_sky_and_ground(scene, above, below);
    add_sheet(scene, 0.0f, thin_sheet(tint));
    const std::vector<Color> seen = specular_only(scene, view_down(angle), 64);
    const double f = fresnel(std::cos(angle), 1.5);
    for (int c = 0; c < 3; ++c) {
      expect_mean(mean_of(seen, c), f * above[c] + (1 - f) * tint[c] * below[c], 0.01);
    }
  }
}

constexpr float albedo = 0.5f;

// A small floor at the origin, seen from just above; what reaches it must have come through sheets.
std::vector<Color> floor_caustic(Scene scene, int samples) {
  add_mesh(scene, quad({-0.01f, 0, -0.01f}, {0, 0, 0.02f}, {0.02f, 0, 0}), diffuse(Color(albedo)));
  const Framebuffer picture = render_clean(
      scene, orthographic_camera({0, 0.001, 0}, {0, 0, 0}, 1e-3f), square(16, samples));
  // The floor sees a little of itself in the sheet, and of the horizon past it.
  const double caustic = mean_of(term(picture, Term::caustic)).value;
  for (const Term t : {Term::emitted, Term::direct, Term::indirect, Term::specular}) {
    EXPECT_LT(mean_of(term(picture, t)).value, 1e-4 * caustic) << term_names[std::size_t(t)];
  }
  return term(picture, Term::caustic);
}

Light point_light(const Color& intensity, const V3d& position) {
  Light light;
  light.intensity = intensity;
  light.object_to_world = translation(position);
  return light;
}

TEST(thin_sheet, between_a_point_light_and_a_floor) {
  const V3d light(0.8, 2.0, 0.0);
  const double cosine = light.normalized().y;
  // Turned sheets make sure that the angle is taken against the sheet's own normal.
  for (const double turn : {0.0, 0.4}) {
    Scene scene;
    scene.lights = {point_light(Color(7.0f), light)};
    add_sheet(scene, 0.0f, thin_sheet(tint), rotation({0, 0, 1}, turn) * translation({0, 0.5, 0}));
    const V3d normal(-std::sin(turn), std::cos(turn), 0.0);
    const double through = 1.0 - fresnel(std::abs(light.normalized().dot(normal)), 1.5);
    const std::vector<Color> seen = floor_caustic(scene, 16);
    for (int c = 0; c < 3; ++c) {
      const double irradiance = 7.0 * cosine / light.length2() * through * tint[c];
      const Mean mean = mean_of(seen, c);
      EXPECT_NEAR(mean.value, irradiance * albedo / pi, 0.002 * irradiance);
    }
  }
}

// As an instance by reference, of which Embree shows the filters another space.
TEST(thin_sheet, instanced_between_a_point_light_and_a_floor) {
  const V3d light(0.8, 2.0, 0.0);
  Scene scene;
  scene.lights = {point_light(Color(7.0f), light)};
  const Mesh mesh = grid({-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, 160);
  add_mesh(scene, mesh, thin_sheet(tint), rotation({0, 0, 1}, 0.4) * translation({0, 0.5, 0}));
  add_mesh(scene, quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}), thin_sheet(tint),
           scaling({0.2, -3, 0.3}) * rotation({0, 0, 1}, -0.2) * translation({0.1, 0.9, 0}));
  scene.instances[1].mesh = 0;
  double through = 1.0;
  for (const double turn : {0.4, -0.2}) {
    const V3d normal(-std::sin(turn), std::cos(turn), 0.0);
    through *= 1.0 - fresnel(std::abs(light.normalized().dot(normal)), 1.5);
  }
  const std::vector<Color> seen = floor_caustic(scene, 16);
  for (int c = 0; c < 3; ++c) {
    const double irradiance =
        7.0 * light.normalized().y / light.length2() * through * tint[c] * tint[c];
    EXPECT_NEAR(mean_of(seen, c).value, irradiance * albedo / pi, 0.002 * irradiance);
  }
}

// A hollow sphere of a thin wall around a point light, round and flattened.
TEST(thin_sheet, bubble_around_a_point_light) {
  for (const double stretch : {1.0, 2.0}) {
    const V3d light(0.8, 2.0, 0.0);
    Scene scene;
    scene.lights = {point_light(Color(7.0f), light)};
    const M44d transform =
        scaling({0.3, 0.3, 0.3 * stretch}) * rotation({0, 1, 0}, 0.7) * translation(light);
    add_sphere(scene, 1.0f, thin_sheet(tint), transform);
    // The ray from the centre leaves where the ellipsoid's normal is M⁻ᵀ of the sphere's.
    V3d object, normal;
    transform.inverse().multDirMatrix(-light, object);
    transform.inverse().transposed().multDirMatrix(object.normalized(), normal);
    const double through =
        1.0 - fresnel(std::abs(normal.normalized().dot(light.normalized())), 1.5);
    const std::vector<Color> seen = floor_caustic(scene, 16);
    for (int c = 0; c < 3; ++c) {
      const double irradiance = 7.0 * light.normalized().y / light.length2() * through * tint[c];
      EXPECT_NEAR(mean_of(seen, c).value, irradiance * albedo / pi, 0.002 * irradiance);
    }
  }
}

// Σ over a fine grid on the rectangle of what passes the sheets above the origin.
double rectangle_through_sheet(const V3d& corner, const V3d& u, const V3d& v, double transmittance,
                               int sheets) {
  constexpr int n = 400;
  const V3d normal = u.cross(v).normalized();
  const double area = u.cross(v).length() / (double(n) * n);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const V3d p = corner + u * ((i + 0.5) / n) + v * ((j + 0.5) / n);
      const V3d w = p.normalized();
      const double through = (1.0 - fresnel(w.y, 1.5)) * transmittance;
      sum += std::pow(through, sheets) * w.y * std::abs(w.dot(normal)) / p.length2() * area;
    }
  }
  return sum;
}

TEST(thin_sheet, between_an_area_light_and_a_floor) {
  // Large and close, so that scattered rays and light samples share the work.
  const V3f corner(-1, 0.6f, -1), u(2, 0, 0), v(0, 0, 2);
  for (int sheets = 1; sheets <= 2; ++sheets) {
    Scene scene;
    add_mesh(scene, quad(corner, u, v), emitter(Color(5.0f)));
    for (int i = 0; i < sheets; ++i) {
      add_sheet(scene, 0.2f + 0.2f * static_cast<float>(i), thin_sheet(tint));
    }
    const std::vector<Color> seen = floor_caustic(scene, 512);
    // Two sheets also pass on what they reflect to each other: a little, and rarely found.
    for (int c = 0; c < 3; ++c) {
      const double straight =
          5.0 * albedo / pi * rectangle_through_sheet(V3d(corner), V3d(u), V3d(v), tint[c], sheets);
      const Mean mean = mean_of(seen, c);
      if (sheets == 1) {
        expect_mean(mean, straight, 0.01);
      } else {
        EXPECT_GT(mean.value, straight * 0.999);
        EXPECT_LT(mean.value, straight * 1.1);
      }
    }
  }
}

TEST(thin_sheet, between_an_environment_and_a_floor) {
  Scene scene;
  scene.environment.radiance = Color(3.0f);
  add_sheet(scene, 0.2f, thin_sheet(tint));
  // The floor is small, so that the sheet reflects the environment's lower half and nothing else.
  double average = 0.0;
  constexpr int n = 10000;
  for (int i = 0; i < n; ++i) average += fresnel(std::sqrt((i + 0.5) / n), 1.5) / n;
  add_mesh(scene, quad({-60, -0.1f, -60}, {0, 0, 120}, {120, 0, 0}), diffuse(Color(0.0f)));
  const std::vector<Color> seen = floor_caustic(scene, 512);
  for (int c = 0; c < 3; ++c) {
    expect_mean(mean_of(seen, c), 3.0 * albedo * (1.0 - average) * tint[c], 0.01);
  }
}

// A sheet inside of glass: light samples and scattered rays must agree on what it lets through. A
// bright lamp in a closed box draws nearly all light samples and leaves the work to scattered rays.
TEST(thin_sheet, inside_glass) {
  Scene scene;
  add_mesh(scene, box({-60, -1, -60}, {60, 3, 60}), glass(1.5f));
  add_mesh(scene, quad({-2, 0.6f, -1}, {2, 0, 0}, {0, 0, 2}), emitter(Color(5.0f)));
  add_sheet(scene, 0.2f, thin_sheet(tint));
  add_mesh(scene, quad({-0.01f, 0, -0.01f}, {0, 0, 0.02f}, {0.02f, 0, 0}), diffuse(Color(albedo)));
  // From outside, so that paths know which glass they are in.
  const double outside = std::asin(1.5 * std::sin(0.6));
  const V3d entry(3.0 * std::tan(0.6), 3.0, 0.0);
  const Camera camera =
      orthographic_camera(entry + V3d(std::sin(outside), std::cos(outside), 0.0), entry, 1e-3f);
  const std::vector<Color> by_lights = beauty(render_clean(scene, camera, square(16, 512)));
  scene.lights = {point_light(Color(1e4f), {-1, 1.5, 0})};
  add_mesh(scene, box({-1.1f, 1.4f, -0.1f}, {-0.9f, 1.6f, 0.1f}), diffuse(Color(0.0f)));
  const std::vector<Color> by_scattering = beauty(render_clean(scene, camera, square(16, 1024)));
  expect_same_mean(by_lights, by_scattering, 0.01);
}

}  // namespace
}  // namespace lumivec::test
