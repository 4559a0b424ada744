// Records of indirect light against closed forms, and their derivatives against differences.
#include "integrator/hemisphere_gather.h"

#include "cornell_scene.h"
#include "integrator/frame.h"

namespace lumivec::test {
namespace {

double sum(const Color& c) {
  return double(c.x) + c.y + c.z;
}

struct Gathering {
  explicit Gathering(const Scene& s)
      : scene(s),
        traced(scene, 1),
        lights(traced),
        view(perspective_camera({0, 0, 0}, {0, 0, -1}, 1.0), traced, 16, 16),
        tracer(traced, lights, view, square(16, 1)),
        gather(tracer, traced, {}, 1.0f) {}

  // The mean of that many hemispheres at a point.
  IrradianceRecord make(const V3f& position, const V3f& normal, std::uint32_t passes,
                        std::uint32_t seed = 1,
                        const HemisphereCells& cells = HemisphereGather::most_cells) const {
    RecordRequest request;
    request.point.position = V3f(V3d(position) - traced.origin());
    request.point.geometric_normal = request.point.normal = normal;
    request.point.error = 1e-5f;
    RenderStatistics statistics;
    IrradianceRecord r = gather.make(request, cells, seed, statistics);
    while (r.passes < passes) gather.refine(r, request, cells, seed, statistics);
    return r;
  }

  const Scene scene;
  TracedScene traced;
  Lights lights;
  CameraView view;
  PathTracer tracer;
  HemisphereGather gather;
};

// In a closed room whose walls emit e and reflect ρ, indirect light has the radiance e ρ / (1 − ρ)
// from everywhere: its vector is π times that along the normal, its flux 2 π times that.
TEST(hemisphere_gather, furnace) {
  constexpr float rho = 0.5f;
  Material wall = diffuse(Color(rho));
  wall.emission = Color(1.0f, 2.0f, 0.0f);
  wall.double_sided = true;
  Scene scene;
  add_mesh(scene, box({-1, -1, -1}, {1, 1, 1}, true), wall);
  const Gathering g(scene);
  constexpr std::uint32_t passes = 16;
  const IrradianceRecord r = g.make({0.2f, -1.0f, 0.1f}, {0, 1, 0}, passes);
  // Russian roulette and light sampling scatter single paths by less than their mean.
  const double relative = 4.0 / std::sqrt(double(passes) * HemisphereGather::most_cells.count());
  for (int c = 0; c < 2; ++c) {
    const double radiance = wall.emission[c] * rho / (1.0 - rho);
    const V3f& d = r.light.vector[std::size_t(c)];
    EXPECT_NEAR(d.y, pi * radiance, relative * pi * radiance);
    EXPECT_NEAR(d.x, 0.0, relative * pi * radiance);
    EXPECT_NEAR(d.z, 0.0, relative * pi * radiance);
    EXPECT_NEAR(r.light.flux[c], 2 * pi * radiance, relative * 2 * pi * radiance);
  }
  EXPECT_EQ(r.light.flux.z, 0.0f);
  EXPECT_EQ(r.passes, passes);
  EXPECT_GT(r.radius_small, 0.0f);
  EXPECT_GE(r.radius_large, r.radius_small);
}

// The variance that a record states is that of independent records, however finely the hemisphere
// is divided.
class hemisphere_gather_cells : public testing::TestWithParam<HemisphereCells> {};

TEST_P(hemisphere_gather_cells, stated_variance) {
  const Gathering g(cornell_scene());
  double total = 0.0, squares = 0.0, stated = 0.0;
  constexpr int count = 60;
  for (std::uint32_t seed = 1; seed <= count; ++seed) {
    const IrradianceRecord r = g.make({0.3f, -0.999f, 0.2f}, {0, 1, 0}, 1, seed, GetParam());
    const double e = sum(r.light.irradiance(r.normal)) / 3.0;
    total += e;
    squares += e * e;
    stated += double(r.variance) * e * e;
  }
  const double mean = total / count, variance = (squares - count * mean * mean) / (count - 1);
  stated /= count;
  // Strata that neighbours share make the statement cautious; it must not be too low by more than
  // the variance's own scatter.
  EXPECT_LT(variance, stated * (1.0 + 4.0 * std::sqrt(2.0 / count)));
  EXPECT_GT(variance, 0.2 * stated);
}

INSTANTIATE_TEST_SUITE_P(fineness, hemisphere_gather_cells,
                         testing::Values(HemisphereCells{8, 24}, HemisphereCells{12, 32},
                                         HemisphereGather::most_cells));

// First derivatives agree with differences of the irradiance itself.
TEST(hemisphere_gather, gradient) {
  CornellOptions options;
  options.specular = false;
  const Gathering g(cornell_scene(options));
  const V3f normal(0, 0, 1), at(0.3f, 0.4f, -1.0f);
  constexpr std::uint32_t passes = 40;
  const IrradianceRecord r = g.make(at, normal, passes);
  const Frame frame = make_frame(normal);
  constexpr float h = 0.15f;
  for (int axis = 0; axis < 2; ++axis) {
    const V3f d = axis == 0 ? frame.t : frame.b;
    const auto irradiance = [&](float offset, std::uint32_t seed) {
      const IrradianceRecord moved = g.make(at + d * offset, normal, passes, seed);
      return std::pair(sum(moved.light.irradiance(normal)) / 3.0, double(moved.variance));
    };
    const auto [ahead, variance_ahead] = irradiance(h, 2);
    const auto [behind, variance_behind] = irradiance(-h, 3);
    const double difference = (ahead - behind) / (2 * h);
    double slope = 0.0;
    for (const V2f& gradient : r.gradient) slope += (axis == 0 ? gradient.x : gradient.y) / 3.0;
    const double noise = std::sqrt(variance_ahead + variance_behind) * ahead / (2 * h);
    // The record's own gradient has a noise of about that of its irradiance over its distances.
    EXPECT_NEAR(slope, difference, 6.0 * noise + 0.05 * ahead) << axis;
  }
}

}  // namespace
}  // namespace lumivec::test
