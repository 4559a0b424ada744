// Light that arrives at a point by direction, against the closed form of a closed grey room.
#include "integrator/incident_light.h"

#include "integrator/live_tracer.h"
#include "test_scenes.h"

namespace lumivec::test {
namespace {

constexpr float albedo = 0.5f, emitted = 2.0f;

// All walls give light and reflect it: radiance is emitted / (1 − albedo) everywhere, and what is
// not seen of it directly is albedo times that.
constexpr float indirect = albedo * emitted / (1.0f - albedo);

Scene grey_room() {
  Scene scene;
  Material material = diffuse(Color(albedo));
  material.emission = Color(emitted);
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}, true), material);
  return scene;
}

TEST(incident_light, is_even_in_a_closed_grey_room) {
  for (const Integrator integrator : {Integrator::path, Integrator::light_vectors}) {
    const Scene scene = grey_room();
    RenderSettings settings = square(16, 1);
    settings.integrator = integrator;
    LiveTracer tracer(scene, settings);
    tracer.set_view(perspective_camera({0, 0.5, 0}, {0.3, -1, 0}, 0.8), 16, 16);
    constexpr double no_limit = 1e3;  // seconds
    for (int i = 0; i < 256; ++i) tracer.improve(no_limit, no_limit, false);
    const std::optional<IncidentLight> light = tracer.incident_light(8, 8);
    ASSERT_TRUE(light.has_value());
    EXPECT_NEAR(light->normal.y, 1.0f, 1e-5f);
    // Of the 320 faces half lie above the floor, and those that it cuts.
    EXPECT_GT(light->faces.size(), 160u);
    EXPECT_LT(light->faces.size(), 230u);
    double sum = 0.0, squares = 0.0, solid_angle = 0.0;
    int whole = 0;
    for (const IncidentFace& face : light->faces) {
      const bool above = std::all_of(face.corners.begin(), face.corners.end(),
                                     [&](const V3f& c) { return c.dot(light->normal) > 0.0f; });
      if (!above) continue;
      ++whole;
      sum += double(face.radiance.x);
      squares += double(face.radiance.x) * double(face.radiance.x);
      solid_angle += double(face.solid_angle);
    }
    const double mean = sum / whole;
    const double error = std::sqrt(std::max(0.0, squares / whole - mean * mean) / whole);
    EXPECT_NEAR(mean, double(indirect), sigmas * error + 0.01 * double(indirect));
    // The floor cuts faces up to 17° above it.
    EXPECT_LT(solid_angle, 2.0 * pi);
    EXPECT_GT(solid_angle, 1.4 * pi);
    const double irradiance = pi * double(indirect);
    EXPECT_NEAR(double(light->irradiance_of_faces().x), irradiance,
                (sigmas * error / mean + 0.01) * irradiance);
    EXPECT_LT(error, 0.03 * mean) << "too noisy to tell";
    if (integrator == Integrator::path) {
      EXPECT_EQ(light->records, 0);
    } else {
      EXPECT_GT(light->records, 0);
      EXPECT_NEAR(double(light->irradiance_of_vector().x), irradiance, 0.03 * irradiance);
    }
  }
}

TEST(incident_light, is_none_where_nothing_is_seen) {
  const Scene scene = grey_room();
  LiveTracer tracer(scene, square(16, 1));
  tracer.set_view(perspective_camera({0, 5, 0}, {0.3, 9, 0}, 0.8), 16, 16);
  EXPECT_FALSE(tracer.incident_light(8, 8).has_value());
}

}  // namespace
}  // namespace lumivec::test
