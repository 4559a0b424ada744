// Photon maps of views that change: they grow while the view moves, and others follow at rest.
#include "integrator/live_photons.h"

#include <optional>
#include <thread>

#include "integrator/camera_view.h"
#include "integrator/lights.h"
#include "test_scenes.h"

namespace lumivec::test {
namespace {

constexpr double no_limit = 1e9;  // seconds

struct Traced {
  Scene scene;
  RenderSettings settings = square(16, 1);
  tbb::task_arena arena{2};
  std::optional<TracedScene> traced;
  std::optional<Lights> lights;
  std::optional<CameraView> view;
  std::vector<BoundingSphere> casters;
  std::optional<LightTracer> tracer;

  explicit Traced(bool with_glass) {
    Light light;
    light.intensity = Color(7.0f);
    light.object_to_world = translation({0, 2, 0});
    scene.lights = {light};
    add_mesh(scene, quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0}), diffuse(Color(0.5f)));
    if (with_glass) add_sphere(scene, 0.3f, glass(1.5f), translation({0, 1, 0}));
    settings.integrator = Integrator::light_vectors;
    traced.emplace(scene, 2);
    lights.emplace(*traced);
    view.emplace(perspective_camera({0, 1, 4}, {0, 0, 0}, 0.7), *traced, 16, 16);
    casters = caustic_casters(*traced, settings.specular_roughness);
    if (!casters.empty()) lights->leave_caustics_to_light_paths(true);
    tracer.emplace(*traced, *lights, *view, settings, casters);
  }
};

// Calls gather until what is being built has arrived.
PhotonChange gather_until_changed(LivePhotons& photons, PhotonDemand demand, Traced& t,
                                  RenderStatistics& statistics) {
  constexpr int patience = 100000;
  for (int i = 0; i < patience; ++i) {
    const PhotonChange change = photons.gather(no_limit, demand, t.arena, statistics);
    if (change != PhotonChange::none) return change;
    std::this_thread::yield();
  }
  return PhotonChange::none;
}

TEST(live_photons, grow_while_the_view_moves_and_are_others_at_rest) {
  Traced t(true);
  ASSERT_TRUE(t.tracer->active());
  LivePhotons photons(*t.traced, 1 << 30);
  RenderStatistics statistics;
  EXPECT_EQ(photons.in_use(), nullptr);
  photons.restart(*t.tracer, 16 * 16, t.arena, statistics);
  const PhotonMap* const first = photons.in_use();
  ASSERT_NE(first, nullptr);
  std::size_t size = photons.size();
  EXPECT_GT(size, 1000u);
  // From 2^13 light paths to 2^16.
  for (int doubling = 0; doubling < 3; ++doubling) {
    ASSERT_EQ(gather_until_changed(photons, PhotonDemand::grow, t, statistics),
              PhotonChange::better);
    EXPECT_NEAR(double(photons.size()), 2.0 * double(size), 0.1 * double(size));
    size = photons.size();
  }
  const PhotonMap* const wide = photons.in_use();
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(photons.gather(no_limit, PhotonDemand::grow, t.arena, statistics),
              PhotonChange::none);
    EXPECT_EQ(photons.gather(no_limit, PhotonDemand::keep, t.arena, statistics),
              PhotonChange::none);
  }
  ASSERT_EQ(gather_until_changed(photons, PhotonDemand::another, t, statistics),
            PhotonChange::another);
  EXPECT_NE(photons.in_use(), wide);
  EXPECT_NEAR(double(photons.size()), double(size), 0.1 * double(size));
  // The wide one again.
  EXPECT_EQ(gather_until_changed(photons, PhotonDemand::grow, t, statistics),
            PhotonChange::another);
  EXPECT_EQ(photons.in_use(), wide);
  EXPECT_EQ(photons.size(), size);
}

TEST(live_photons, grow_no_further_than_memory_allows) {
  Traced t(true);
  LivePhotons photons(*t.traced, 1);
  RenderStatistics statistics;
  photons.restart(*t.tracer, 16 * 16, t.arena, statistics);
  const std::size_t size = photons.size();
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(photons.gather(no_limit, PhotonDemand::grow, t.arena, statistics),
              PhotonChange::none);
  }
  EXPECT_EQ(photons.size(), size);
}

TEST(live_photons, none_where_nothing_throws_caustics) {
  Traced t(false);
  LivePhotons photons(*t.traced, 1 << 30);
  RenderStatistics statistics;
  photons.restart(*t.tracer, 16 * 16, t.arena, statistics);
  EXPECT_EQ(photons.in_use(), nullptr);
  EXPECT_EQ(photons.gather(no_limit, PhotonDemand::another, t.arena, statistics),
            PhotonChange::none);
}

}  // namespace
}  // namespace lumivec::test
