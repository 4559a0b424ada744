// Pictures by the method of 2003, against the path tracer's and against themselves.
#include <functional>

#include "cornell_scene.h"

namespace lumivec::test {
namespace {

// Open to the eye, with blocks and walls that only scatter diffusely, or one block of rough metal.
Scene room(bool with_metal) {
  CornellOptions options;
  options.specular = false;
  Scene scene = cornell_scene(options);
  for (Material& m : scene.materials) {
    if (m.metallic > 0.0f && !with_metal) m = diffuse(m.base_color);
  }
  return scene;
}

RenderSettings paper_settings(int size, int samples) {
  RenderSettings settings = square(size, samples);
  settings.integrator = Integrator::light_vectors;
  settings.validity = Validity::paper;
  settings.paper.seeds = 100;
  settings.paper.samples = 256;
  return settings;
}

struct Picture {
  Framebuffer frame;
  RenderStatistics statistics;
};

// Fails the test if any pixel of any term is negative or not finite.
Picture render_paper(const Scene& scene, const RenderSettings& settings) {
  Picture p;
  p.frame = render(scene, cornell_camera(), settings, p.statistics);
  for (const std::vector<Color>& pixels : p.frame.terms) {
    for (const Color& c : pixels) {
      for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(std::isfinite(c[i]) && c[i] >= 0.0f) << c.x << ' ' << c.y << ' ' << c.z;
      }
    }
  }
  for (const std::uint64_t dropped : p.statistics.dropped) EXPECT_EQ(dropped, 0u);
  return p;
}

double level(const std::vector<Color>& pixels) {
  return (mean_of(pixels, 0).value + mean_of(pixels, 1).value + mean_of(pixels, 2).value) / 3.0;
}

void expect_indirect_light_as_by_path(bool with_metal, double mean_tolerance) {
  constexpr int size = 48;
  const Scene scene = room(with_metal);
  const Framebuffer reference = render_clean(scene, cornell_camera(), square(size, 256, 7));
  const Picture picture = render_paper(scene, paper_settings(size, 4));
  const std::vector<Color>&expected = term(reference, Term::indirect),
        &found = term(picture.frame, Term::indirect);
  EXPECT_NEAR(level(found) / level(expected), 1.0, mean_tolerance);
  // Records are blotchy and too smooth in corners, by the method's nature.
  EXPECT_LT(differing_blocks(expected, found, size, 4, 0.15), 0.1);
  EXPECT_GT(picture.statistics.records, 100u);
  EXPECT_GT(picture.statistics.cache_hits, picture.statistics.samples * 3 / 4);
  // What is not cached is what it was.
  expect_same_mean(term(reference, Term::direct), term(picture.frame, Term::direct));
  EXPECT_EQ(level(term(picture.frame, Term::caustic)), 0.0);
}

TEST(paper_mode, diffuse_room) {
  expect_indirect_light_as_by_path(false, 0.02);
}

TEST(paper_mode, block_whose_light_depends_on_the_view) {
  expect_indirect_light_as_by_path(true, 0.02);
}

// With mirrors and glass too, whose light is what it is without a cache.
TEST(paper_mode, terms_add_up_to_the_same_light) {
  constexpr int size = 32;
  const Scene scene = cornell_scene();
  const Framebuffer reference = render_clean(scene, cornell_camera(), square(size, 512, 3));
  const Picture picture = render_paper(scene, paper_settings(size, 64));
  EXPECT_NEAR(level(beauty(picture.frame)) / level(beauty(reference)), 1.0, 0.03);
  double sum = 0.0;
  for (const std::vector<Color>& pixels : picture.frame.terms) {
    EXPECT_GT(level(pixels), 0.0);
    sum += level(pixels);
  }
  EXPECT_NEAR(sum, level(beauty(picture.frame)), 1e-5 * sum);
}

TEST(paper_mode, any_number_of_threads) {
  const Scene scene = cornell_scene();
  RenderSettings settings = paper_settings(32, 3);
  settings.threads = 1;
  const Picture one = render_paper(scene, settings);
  for (const int threads : {2, 3}) {
    settings.threads = threads;
    const Picture other = render_paper(scene, settings);
    EXPECT_EQ(one.frame.terms, other.frame.terms) << threads << " threads";
    EXPECT_EQ(one.statistics.records, other.statistics.records);
  }
}

TEST(paper_mode, every_parameter_has_an_effect) {
  const Scene scene = room(true);
  RenderSettings settings = paper_settings(24, 1);
  settings.paper.samples = 64;
  settings.paper.seeds = 20;
  const Picture usual = render_paper(scene, settings);
  using Change = std::function<void(PaperParameters&)>;
  const auto records = [&](const Change& change) {
    RenderSettings s = settings;
    change(s.paper);
    const Picture picture = render_paper(scene, s);
    EXPECT_NE(term(usual.frame, Term::indirect), term(picture.frame, Term::indirect));
    return picture.statistics.records;
  };
  const std::uint64_t n = usual.statistics.records;
  EXPECT_GT(records([](PaperParameters& p) { p.max_variation = 0.1f; }), n);
  EXPECT_GT(records([](PaperParameters& p) { p.min_direction_cosine = 0.999f; }), n);
  EXPECT_GT(records([](PaperParameters& p) { p.needed_records = 6; }), n);
  EXPECT_GT(records([](PaperParameters& p) { p.seeds = 400; }), n);
  records([](PaperParameters& p) { p.samples = 100; });
  EXPECT_EQ(records([](PaperParameters& p) { p.max_records = 15; }), 15u);
  EXPECT_EQ(records([](PaperParameters& p) { p.max_records = 30; }), 30u);
}

// Of a curved surface, since the room's normals are all at right angles or parallel.
TEST(paper_mode, curvature_has_an_effect) {
  Scene scene = room(false);
  add_sphere(scene, 0.4f, diffuse(Color(0.7f)), translation({0.4, 0.0, 0.0}));
  RenderSettings settings = paper_settings(24, 1);
  const std::uint64_t n = render_paper(scene, settings).statistics.records;
  settings.paper.min_normal_cosine = 0.99f;
  EXPECT_GT(render_paper(scene, settings).statistics.records, n);
}

TEST(paper_mode, counts_the_forms_of_light_vectors) {
  const Picture picture = render_paper(room(true), paper_settings(24, 1));
  std::uint64_t sum = 0;
  for (const std::uint64_t n : picture.statistics.light_vectors) sum += n;
  EXPECT_EQ(sum, picture.statistics.records);
  EXPECT_GT(picture.statistics.light_vectors[0], sum / 2);
}

TEST(paper_mode, a_cache_without_room_leaves_it_to_paths) {
  RenderSettings settings = paper_settings(24, 16);
  settings.cache_bytes = 1;
  const Picture picture = render_paper(room(false), settings);
  EXPECT_LE(picture.statistics.records, 1u);
  const Framebuffer reference = render_clean(room(false), cornell_camera(), square(24, 256, 3));
  expect_same_mean(term(reference, Term::indirect), term(picture.frame, Term::indirect), 0.05);
}

TEST(paper_mode, contradictions_are_refused) {
  const auto refuses = [](const std::function<void(PaperParameters&)>& change) {
    RenderSettings settings = paper_settings(4, 1);
    change(settings.paper);
    RenderStatistics statistics;
    EXPECT_THROW(render(Scene(), Camera(), settings, statistics), RenderError);
  };
  refuses([](PaperParameters& p) { p.max_variation = 0.0f; });
  refuses([](PaperParameters& p) { p.min_normal_cosine = 1.0f; });
  refuses([](PaperParameters& p) { p.min_direction_cosine = -1.5f; });
  refuses([](PaperParameters& p) { p.needed_records = 0; });
  refuses([](PaperParameters& p) { p.seeds = -1; });
  refuses([](PaperParameters& p) { p.samples = 0; });
  refuses([](PaperParameters& p) { p.max_records = -1; });
}

}  // namespace
}  // namespace lumivec::test
