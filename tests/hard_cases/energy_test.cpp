// A cached picture has the light of the reference, and roughness has no step where lobes change
// their kind.
#include "hard_case.h"

namespace lumivec::test {
namespace {

constexpr int size = 24;

TEST(energy, of_the_cached_picture) {
  for (const bool specular : {false, true}) {
    CornellOptions o;
    o.specular = specular;
    const Scene scene = cornell_scene(o);
    const Camera camera = cornell_camera();
    const Mean reference =
        mean_of_seeds(scene, camera, settings_for(Integrator::path, size, 64), 8, Term::indirect);
    const Mean cached = mean_of_seeds(
        scene, camera, settings_for(Integrator::light_vectors, size, 8, 11), 4, Term::indirect);
    const double noise = std::hypot(reference.error, cached.error) / reference.value;
    EXPECT_LT(noise, specular ? 0.006 : 0.004) << "too noisy to tell";
    expect_error(
        specular ? "mean of all indirect light, glass and mirrors" : "mean of all indirect light",
        Integrator::light_vectors, std::abs(cached.value / reference.value - 1.0),
        RenderSettings().cache_error + sigmas * noise);
  }
}

class roughness : public each_integrator {};
INSTANTIATE_TEST_SUITE_P(of, roughness, integrators, integrator_name);

// A room with a coated floor and a metal box. From below the threshold to above it the sum of the
// terms goes on smoothly, though light moves from the specular term to others.
TEST_P(roughness, through_the_threshold) {
  const float threshold = RenderSettings().specular_roughness;
  std::vector<std::vector<Color>> sums;
  std::vector<double> specular;
  for (const float r : {threshold - 1e-4f, threshold + 1e-4f}) {
    CornellOptions o;
    o.specular = false;
    Scene scene = cornell_scene(o);
    for (Material& m : scene.materials) {
      m.roughness = r;
      if (m.metallic == 0.0f && m.emission == Color(0.0f)) m.specular = 1.0f;
    }
    const Framebuffer picture =
        render_case(scene, cornell_camera(), settings_for(GetParam(), 24, 32, sums.size() + 1));
    sums.push_back(beauty(picture));
    specular.push_back(mean_level(term(picture, Term::specular)));
  }
  EXPECT_GT(specular[0], 10.0 * specular[1]) << "nothing crossed the threshold";
  const double level = mean_level(sums[0]);
  const Mean difference = mean_difference(sums[0], sums[1]);
  EXPECT_LT(difference.error, 0.01 * level) << "too noisy to tell";
  expect_error("roughness through the specular threshold", std::abs(difference.value) / level,
               sigmas * difference.error / level +
                   (GetParam() == Integrator::path ? 0.0 : RenderSettings().cache_error));
}

// From mirror to chalk nothing becomes infinite or negative.
TEST_P(roughness, from_0_to_1) {
  for (const float r : {0.0f, 0.01f, 1.0f}) {
    CornellOptions o;
    Scene scene = cornell_scene(o);
    for (Material& m : scene.materials) {
      m.roughness = r;
      m.specular = 1.0f;
    }
    RenderSettings settings = settings_for(GetParam(), 8, 4);
    settings.cache_error = 0.1;
    EXPECT_GT(mean_level(beauty(render_case(scene, cornell_camera(), settings))), 0.0);
  }
}

}  // namespace
}  // namespace lumivec::test
