// The paper's records of indirect light against closed forms.
#include "integrator/paper_gather.h"

#include "cornell_scene.h"

namespace lumivec::test {
namespace {

struct Gathering {
  explicit Gathering(const Scene& s)
      : scene(s),
        traced(scene, 1),
        lights(traced),
        view(perspective_camera({0, 0, 0}, {0, 0, -1}, 1.0), traced, 16, 16),
        tracer(traced, lights, view, square(16, 1)) {}

  // Of a surface at the origin that faces up, as one sees it who stands obliquely above.
  PaperPoint point(const SurfaceParameters& surface) const {
    PaperPoint p;
    p.place.position = V3f(-traced.origin());
    p.place.geometric_normal = p.place.normal = V3f(0, 1, 0);
    p.place.error = 1e-6f;
    p.view = V3f(0.6f, 0.8f, 0.0f);
    p.surface = surface;
    p.surface.normal = p.surface.coat_normal = V3f(0, 1, 0);
    return p;
  }
  Bsdf bsdf(const PaperPoint& p) const {
    return Bsdf(p.surface, p.place.geometric_normal, p.view, traced.albedo_tables(), 0.15f);
  }
  PaperRecord make(const PaperPoint& p, int samples) const {
    RenderStatistics statistics;
    return make_paper_record(tracer, traced, p, bsdf(p), samples, 1, statistics);
  }

  const Scene scene;
  TracedScene traced;
  Lights lights;
  CameraView view;
  PathTracer tracer;
};

SurfaceParameters lambertian(const Color& albedo) {
  SurfaceParameters surface;
  surface.base_color = albedo;
  surface.specular = 0.0f;
  return surface;
}

constexpr float radius = 2.0f;

// A sphere around the origin that emits e and reflects ρ: indirect light of the radiance
// e ρ / (1 − ρ) comes from everywhere, and from the same distance.
Scene glowing_sphere() {
  Material wall = diffuse(Color(0.5f));
  wall.emission = Color(1.0f, 2.0f, 0.0f);
  wall.double_sided = true;
  Scene scene;
  add_sphere(scene, radius, wall, M44d());
  return scene;
}

constexpr int samples = 200'000;
constexpr double tolerance = 0.01;  // roulette and light sampling scatter paths by about their mean

TEST(paper_gather, light_from_everywhere) {
  const Gathering g(glowing_sphere());
  const PaperRecord r = g.make(g.point(lambertian(Color(0.5f))), samples);
  EXPECT_EQ(r.light.form, LightVectorForm::exact);
  EXPECT_NEAR(r.light.direction.y, 1.0, tolerance);
  EXPECT_NEAR(r.light.magnitude.x, pi, tolerance * pi);  // the irradiance
  EXPECT_NEAR(r.light.magnitude.y, 2.0 * pi, tolerance * 2.0 * pi);
  EXPECT_EQ(r.light.magnitude.z, 0.0f);
}

// E = π L, and ∇E = ∫ L (cosθ ω − n) / r dω = −4 π L / (3 r) n.
TEST(paper_gather, distance_and_variation) {
  const Gathering g(glowing_sphere());
  const PaperRecord r = g.make(g.point(lambertian(Color(0.5f))), samples);
  EXPECT_NEAR(r.mean_distance, radius, 1e-4 * radius);
  EXPECT_NEAR(r.relative_variation, 4.0 / (3.0 * radius), tolerance);
}

// At its own point the record is the light that the lobes reflect, whatever they are.
TEST(paper_gather, reproduces_what_is_reflected) {
  const Gathering g(glowing_sphere());
  SurfaceParameters rough_metal;
  rough_metal.normal = rough_metal.coat_normal = V3f(0.0f, 0.0f, 1.0f);
  rough_metal.base_color = Color(0.9f, 0.6f, 0.3f);
  rough_metal.metallic = 1.0f;
  rough_metal.roughness = 0.5f;
  SurfaceParameters plastic = rough_metal;
  plastic.metallic = 0.0f;
  for (const SurfaceParameters& surface : {rough_metal, plastic}) {
    const PaperPoint p = g.point(surface);
    const Bsdf bsdf = g.bsdf(p);
    ASSERT_EQ(paper_kinds(bsdf, p.surface),
              kind_bit(LobeKind::diffuse) * (surface.metallic < 1) + kind_bit(LobeKind::broad));
    const PaperRecord r = g.make(p, samples);
    Color albedo(0.0f);  // ∫ f cosθ dω
    constexpr int rings = 200, sectors = 400;
    for (int j = 0; j < rings; ++j) {
      for (int k = 0; k < sectors; ++k) {
        const float cosine = (float(j) + 0.5f) / rings, sine = std::sqrt(1.0f - cosine * cosine);
        const float turn = 2.0f * float(pi) * (float(k) + 0.5f) / sectors;
        const V3f w(sine * std::cos(turn), cosine, sine * std::sin(turn));
        albedo += bsdf.eval(w).of_broad() * (2.0f * float(pi) / (rings * sectors));
      }
    }
    const Color seen = relit(r.light, bsdf.eval(r.light.direction).of_broad());
    EXPECT_NEAR(seen.x, albedo.x, 2.0 * tolerance * albedo.x);
    EXPECT_NEAR(seen.y, 2.0 * albedo.y, 2.0 * tolerance * 2.0 * albedo.y);
    EXPECT_EQ(seen.z, 0.0f);
  }
}

// Nothing around: records hold, and are black.
TEST(paper_gather, empty_surroundings) {
  Scene scene;
  add_sphere(scene, 1.0f, diffuse(Color(0.5f)), translation({0, -3, 0}));
  const Gathering g(scene);
  const PaperRecord r = g.make(g.point(lambertian(Color(0.5f))), 1);
  EXPECT_EQ(r.light.magnitude, Color(0.0f));
  EXPECT_EQ(r.relative_variation, 0.0f);
  EXPECT_GT(r.mean_distance, 1.0f);
  EXPECT_TRUE(std::isfinite(r.mean_distance));
}

}  // namespace
}  // namespace lumivec::test
