#include "viewer/walk/visibility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "test_scenes.h"
#include "viewer/walk/camera_path.h"
#include "viewer/walk/shading_cache.h"

namespace lumivec::test {
namespace {

constexpr int size = 128;

// A wall, a ball, a tilted board, and wires thinner than a pixel to three pixels wide.
Scene wires() {
  Scene scene;
  const Material material = emitter(Color(1.0f), true);
  add_mesh(scene, quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), material);
  add_mesh(scene, quad({-1.4f, -1, -0.5f}, {1, 0, 0.8f}, {0, 1.5f, 0}), material);
  for (int i = 0; i < 4; ++i) {
    const float x = -1.0f + 0.6f * static_cast<float>(i), width = 0.03f * static_cast<float>(i + 1);
    add_mesh(scene, quad({x, -1, 0.3f}, {width, 0.1f, 0}, {0.2f, 2, 0}), material);
  }
  add_sphere(scene, 0.5f, material, M44d().translate(V3d(0.7, 0.4, 0.0)));
  return scene;
}

// With a third of the rays, what is seen is what all rays see, but for pixels that edges go
// through.
TEST(visibility, few_rays_see_what_all_see) {
  const Scene scene = wires();
  for (const char* movement : {"orbit:24", "dolly:1.5"}) {
    SCOPED_TRACE(movement);
    const Camera camera = perspective_camera({0, 0, 4}, {0, 0, 0}, 0.6);
    const std::vector<Camera> path =
        camera_path(parse_camera_path("--path", movement), camera, V3d(0.0), 25);
    RenderSettings settings = square(size, 1, 5);
    LiveTracer tracer(scene, settings);
    Visibility visibility(size, size);
    ShadingCache shading(size, size);
    VisibleSurfaces truth;
    for (std::size_t i = 0; i < path.size(); ++i) {
      tracer.set_view(path[i], size, size);
      i == 0 ? visibility.see_all(tracer) : visibility.see_next(tracer);
      shading.see(tracer, visibility);
      tracer.see(truth);
      const VisibleSurfaces& seen = visibility.now();
      int wrong = 0;
      for (std::size_t k = 0; k < truth.size(); ++k) {
        if (seen.object[k] != truth.object[k]) {
          ++wrong;
          continue;
        }
        if (truth.object[k] < 0) continue;
        const float pixel = tracer.view().footprint(truth.depth[k]);
        EXPECT_NEAR(seen.depth[k], truth.depth[k], 2.0f * pixel) << "pixel " << k;
        EXPECT_TRUE(normals_alike(seen.normal[k], truth.normal[k])) << "pixel " << k;
      }
      EXPECT_LE(wrong, 16) << "of " << truth.size() << " pixels in frame " << i;
      if (i > 0) {
        EXPECT_LT(visibility.ray_count(), truth.size() * 6 / 10);
      }
    }
    std::vector<std::uint32_t> others;
    visibility.see_again(tracer, others);
    for (std::size_t k = 0; k < truth.size(); ++k)
      EXPECT_EQ(visibility.now().object[k], truth.object[k]) << "guesses end at rest: " << k;
  }
}

}  // namespace
}  // namespace lumivec::test
