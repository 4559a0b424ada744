// How light is shared among lamps, and how bright it is.
#include "hard_case.h"

namespace lumivec::test {
namespace {

constexpr int size = 16, block = 2;

class emission : public each_integrator {
 protected:
  static std::vector<Color> picture(const Scene& scene, int samples = 4, std::uint64_t seed = 1) {
    RenderSettings settings = settings_for(GetParam(), size, samples, seed);
    settings.terms = only(Term::indirect);
    return term(render_case(scene, cornell_camera(), settings), Term::indirect);
  }
};
INSTANTIATE_TEST_SUITE_P(of, emission, integrators, integrator_name);

// Numbers are doubled, and no decision may depend on them: the pictures are exactly so.
TEST_P(emission, twice_as_bright) {
  CornellOptions brighter;
  brighter.emission *= 2.0f;
  for (const int n : {4, 16}) {
    const std::vector<Color> a = picture(diffuse_room(), n);
    const std::vector<Color> b = picture(diffuse_room(brighter), n);
    double largest = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const double scale = std::max(2.0 * a[i][c], double(b[i][c]));
        if (scale > 0.0) largest = std::max(largest, std::abs(b[i][c] - 2.0 * a[i][c]) / scale);
      }
    }
    // Rounding alone: a few units in the last place, summed over samples.
    expect_error("twice the emission, " + std::to_string(n) + " samples", largest, 1e-6);
  }
}

// Neither so dim that squares vanish nor so bright that they overflow.
TEST_P(emission, extremes) {
  const double level = mean_level(picture(diffuse_room()));
  for (const float bright : {1e-15f, 1e15f}) {
    CornellOptions o;
    o.emission = bright;
    expect_error(bright < 1.0f ? "emission 1e-15" : "emission 1e15",
                 mean_error(picture(diffuse_room(o)), level * double(bright) / 10.0), 1e-3);
  }
}

TEST_P(emission, one_lamp_or_two_of_half_its_power) {
  Light light;
  light.intensity = Color(4.0f);
  light.object_to_world = translation({0.3, 0.5, 0.6});
  CornellOptions dark;
  dark.emission = 0.0f;
  Scene one = diffuse_room(dark), two = one;
  one.lights = {light};
  light.intensity = Color(2.0f);
  two.lights = {light, light};
  const std::vector<Color> a = picture(one);
  // The random numbers choose between lamps of which it does not matter which is taken.
  expect_error("two lamps of half the power", block_difference(a, picture(two), block), 1e-3);
}

// A dim thing beside a bright one, in different channels: records keep each.
TEST_P(emission, dim_colours_beside_bright_ones) {
  CornellOptions o;
  Scene scene = diffuse_room(o);
  for (Material& m : scene.materials) {
    if (m.emission != Color(0.0f)) m.emission = Color(1e6f, 1.0f, 1e-6f);
    m.base_color = Color(m.base_color.x);
  }
  const std::vector<Color> p = picture(scene);
  double largest = 0.0;
  for (const Color& c : p) {
    // Grey surfaces keep the lamp's ratios; a cached direction for each channel rounds apart.
    if (!(c.x > 0.0f)) continue;
    largest = std::max({largest, std::abs(1e6 * double(c.y) / c.x - 1.0),
                        std::abs(1e12 * double(c.z) / c.x - 1.0)});
  }
  expect_error("radiance 1e6 beside 1e-6", largest, 1e-3);
}

}  // namespace
}  // namespace lumivec::test
