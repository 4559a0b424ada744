// The direct light of the environment's even part from a cache: the same picture, term by term, as
// by light sampling.
#include <gtest/gtest.h>

#include "test_scenes.h"

namespace lumivec::test {
namespace {

// A block on a floor, a glossy one beside it, and a pane of tinted glass that shades a part of it.
Scene terrace() {
  Scene scene;
  set_sky_and_sun(scene);
  add_mesh(scene, quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12}), diffuse(Color(0.6f, 0.5f, 0.4f)));
  add_mesh(scene, box({-0.9f, 0.0f, -0.5f}, {-0.1f, 0.9f, 0.3f}), diffuse(Color(0.7f)));
  Material lacquer;
  lacquer.base_color = Color(0.2f, 0.5f, 0.3f);
  lacquer.roughness = 0.4f;
  add_mesh(scene, box({0.3f, 0.0f, -0.2f}, {0.8f, 0.5f, 0.3f}), lacquer);
  add_mesh(scene, quad({-2.0f, 1.2f, 1.0f}, {1.5f, 0, 0}, {0, 0, -1.5f}),
           thin_sheet(Color(0.9f, 0.5f, 0.5f)));
  return scene;
}

RenderSettings by_light_vectors(bool direct_cache) {
  RenderSettings settings = square(32, 64, 2);
  settings.integrator = Integrator::light_vectors;
  settings.validity_parts.direct_cache = direct_cache;
  return settings;
}

TEST(direct_cache, same_light_as_by_sampling) {
  const Scene scene = terrace();
  const Camera camera = perspective_camera({0.5, 2.2, 4.0}, {0.0, 0.3, 0.0}, 0.6);
  const Framebuffer reference = render_clean(scene, camera, square(32, 512));
  RenderStatistics with, without;
  const Framebuffer sampled = render(scene, camera, by_light_vectors(false), without);
  const Framebuffer cached = render(scene, camera, by_light_vectors(true), with);
  EXPECT_GT(with.records, without.records) << "there are records of direct light";
  for (const Term t : {Term::direct, Term::indirect, Term::caustic}) {
    SCOPED_TRACE(term_names[static_cast<std::size_t>(t)]);
    // Records err by 1% of the light, beside the noise.
    const Mean d = mean_difference(term(cached, t), term(reference, t));
    const double level = mean_of(term(reference, t), 1).value;
    EXPECT_GT(level, 0.0);
    EXPECT_NEAR(d.value, 0.0, sigmas * d.error + 0.01 * level) << "of " << level;
    EXPECT_LT(d.error, 0.03 * level) << "too noisy to tell";
  }
  // What the mirrors of the pane show is no business of the cache.
  EXPECT_EQ(term(cached, Term::emitted), term(sampled, Term::emitted));
}

// Through a slit paths seldom find the sky: there it is sampled as without the cache.
TEST(direct_cache, declined_where_records_would_be_noisy) {
  Scene scene;
  set_sky_and_sun(scene);
  Material wall = diffuse(Color(0.5f));
  wall.double_sided = true;
  add_mesh(scene, quad({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}), wall);
  add_mesh(scene, quad({-1, 1, 1}, {0, 0, -2}, {1.98f, 0, 0}), wall);
  add_mesh(scene, quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}), wall);
  add_mesh(scene, quad({-1, -1, 1}, {0, 0, -2}, {0, 2, 0}), wall);
  add_mesh(scene, quad({1, -1, 1}, {0, 2, 0}, {0, 0, -2}), wall);
  add_mesh(scene, quad({-1, -1, 1}, {0, 2, 0}, {2, 0, 0}), wall);
  const Camera camera = perspective_camera({0.0, 0.0, 0.9}, {0.0, -0.2, -1.0}, 0.9);
  RenderStatistics with, without;
  const Framebuffer sampled = render(scene, camera, by_light_vectors(false), without);
  const Framebuffer cached = render(scene, camera, by_light_vectors(true), with);
  EXPECT_EQ(term(cached, Term::direct), term(sampled, Term::direct));
}

}  // namespace
}  // namespace lumivec::test
