// The five terms are a partition of all light: what belongs to one is in no other, masks and the
// specular threshold move nothing else.
#include "integrator/partition.h"

#include "cornell_scene.h"

namespace lumivec::test {
namespace {

TEST(partition, events) {
  constexpr LobeKind d = LobeKind::broad, s = LobeKind::specular;
  const auto path = [](std::initializer_list<LobeKind> events) {
    Term t = Term::emitted;
    for (const LobeKind kind : events) t = after_event(t, kind);
    return t;
  };
  EXPECT_EQ(path({}), Term::emitted);
  EXPECT_EQ(path({s}), Term::specular);
  EXPECT_EQ(path({s, d, s, d}), Term::specular);
  EXPECT_EQ(path({d}), Term::direct);
  EXPECT_EQ(path({d, s}), Term::caustic);
  EXPECT_EQ(path({d, s, s, s}), Term::caustic);
  EXPECT_EQ(path({d, d}), Term::indirect);
  EXPECT_EQ(path({d, s, d}), Term::indirect);
  EXPECT_EQ(path({d, s, d, s}), Term::indirect);
  EXPECT_EQ(path({d, d, s}), Term::indirect);
}

TEST(partition, reachable_terms) {
  constexpr std::array<Term, 5> all = {Term::emitted, Term::specular, Term::direct, Term::indirect,
                                       Term::caustic};
  for (const Term from : all) {
    EXPECT_TRUE(reachable_terms(from) & term_bit(from));
    for (const LobeKind kind : {LobeKind::broad, LobeKind::specular}) {
      const std::uint32_t next = reachable_terms(after_event(from, kind));
      EXPECT_EQ(next & reachable_terms(from), next);
    }
  }
}

void expect_only(const Scene& scene, const Camera& camera, std::vector<Term> expected) {
  const Framebuffer picture = render_clean(scene, camera, square(16, 32));
  for (std::size_t t = 0; t < term_count; ++t) {
    const bool wanted = std::find(expected.begin(), expected.end(), Term(t)) != expected.end();
    if (wanted) {
      EXPECT_GT(mean_of(picture.terms[t]).value, 1e-4) << term_names[t];
    } else {
      SCOPED_TRACE(term_names[t]);
      expect_black(picture.terms[t]);
    }
  }
}

const Camera down = orthographic_camera({0, 0.5, 0}, {0, 0, 0}, 0.2f);
const Mesh ground = quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
const Mesh lamp = quad({-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1});

TEST(partition, lamp_alone_is_emitted) {
  Scene scene;
  add_mesh(scene, ground, emitter(Color(1.0f)));
  expect_only(scene, down, {Term::emitted});
}
TEST(partition, environment_alone_is_emitted) {
  Scene scene;
  scene.environment.radiance = Color(1.0f);
  expect_only(scene, down, {Term::emitted});
}
TEST(partition, unlit_surface_is_emitted) {
  Scene scene;
  Material material;
  material.unlit = true;
  scene.environment.radiance = Color(1.0f);
  add_mesh(scene, ground, material);
  expect_only(scene, down, {Term::emitted});
}
TEST(partition, lamp_in_a_mirror_is_specular) {
  Scene scene;
  add_mesh(scene, ground, metal(Color(0.9f)));
  add_mesh(scene, lamp, emitter(Color(1.0f)));
  expect_only(scene, down, {Term::specular});
}
TEST(partition, lit_surface_in_a_mirror_is_specular) {
  Scene scene;
  add_mesh(scene, ground, metal(Color(0.9f)));
  add_mesh(scene, lamp, diffuse(Color(1.0f)));
  add_sphere(scene, 0.1f, emitter(Color(9.0f)), translation({0.8, 0.5, 0.8}));
  expect_only(scene, down, {Term::specular});
}
TEST(partition, lamp_over_a_diffuse_floor_is_direct) {
  Scene scene;
  add_mesh(scene, ground, diffuse(Color(0.5f)));
  add_mesh(scene, lamp, emitter(Color(1.0f)));
  expect_only(scene, down, {Term::direct});
}
TEST(partition, lamp_over_a_glossy_floor_is_direct) {
  Scene scene;
  add_mesh(scene, ground, metal(Color(0.5f), 0.4f));
  add_mesh(scene, lamp, emitter(Color(1.0f)));
  expect_only(scene, down, {Term::direct});
}
TEST(partition, lamp_over_a_varnished_floor_is_direct_and_specular) {
  Scene scene;
  Material varnished;
  varnished.roughness = 0.05f;
  add_mesh(scene, ground, varnished);
  add_mesh(scene, lamp, emitter(Color(1.0f)));
  expect_only(scene, down, {Term::direct, Term::specular});
}
TEST(partition, cut_out_in_between_is_no_event) {
  Scene scene;
  Material veil = diffuse(Color(0.0f));
  veil.alpha_mode = AlphaMode::blend;
  veil.opacity = 0.5f;
  add_mesh(scene, ground, diffuse(Color(0.5f)));
  add_mesh(scene, quad({-1, 0.3f, -1}, {0, 0, 2}, {2, 0, 0}), veil);
  add_mesh(scene, lamp, emitter(Color(1.0f)));
  expect_only(scene, down, {Term::direct});
}
TEST(partition, sheet_over_a_lit_floor) {
  // Seen through the sheet: specular. The eye below the sheet: direct is left where the sheet does
  // not reach, caustic through it.
  Scene scene;
  add_mesh(scene, ground, diffuse(Color(0.5f)));
  add_mesh(scene, quad({-9, 0.6f, -9}, {0, 0, 18}, {18, 0, 0}), thin_sheet(Color(1.0f)));
  add_mesh(scene, lamp, emitter(Color(1.0f)));
  expect_only(scene, down, {Term::caustic, Term::indirect});
  expect_only(scene, orthographic_camera({0, 0.9, 0}, {0, 0, 0}, 0.2f), {Term::specular});
}
TEST(partition, light_from_a_wall_is_indirect) {
  Scene scene;
  add_mesh(scene, ground, diffuse(Color(0.5f)));
  add_mesh(scene, quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}), diffuse(Color(0.5f)));
  // Shines up only.
  add_mesh(scene, quad({-0.5f, 0.7f, -0.5f}, {0, 0, 1}, {1, 0, 0}), emitter(Color(1.0f)));
  expect_only(scene, down, {Term::indirect});
}

// ---- the same light whichever terms are asked for ---------------------------------------------

constexpr int size = 32;

TEST(partition, masks_leave_the_other_terms_as_they_are) {
  const Scene scene = cornell_scene();
  const Camera camera = cornell_camera();
  const Framebuffer all = render_clean(scene, camera, square(size, 128));
  for (std::size_t t = 0; t < term_count; ++t) {
    SCOPED_TRACE(term_names[t]);
    RenderSettings settings = square(size, 128, 2);
    settings.terms = 1u << t;
    const Framebuffer one = render_clean(scene, camera, settings);
    for (std::size_t other = 0; other < term_count; ++other) {
      if (other != t) expect_black(one.terms[other]);
    }
    EXPECT_GT(mean_of(all.terms[t]).value, 0.0);
    expect_same_mean(all.terms[t], one.terms[t], Term(t) == Term::caustic ? 0.1 : 0.03);
  }
}

TEST(partition, nothing_asked_for_is_black) {
  RenderSettings settings = square(8, 4);
  settings.terms = 0;
  expect_black(beauty(render_clean(cornell_scene(), cornell_camera(), settings)));
}

// The threshold decides what is called specular; all light stays.
TEST(partition, threshold_moves_light_between_terms) {
  const Scene scene = cornell_scene();
  const Camera camera = cornell_camera();
  std::array<Framebuffer, 3> pictures;
  const float thresholds[] = {0.0f, 0.15f, 0.5f};
  for (std::size_t i = 0; i < 3; ++i) {
    RenderSettings settings = square(size, 128, 10 + i);
    settings.specular_roughness = thresholds[i];
    pictures[i] = render_clean(scene, camera, settings);
  }
  expect_same_mean(beauty(pictures[0]), beauty(pictures[1]));
  expect_same_mean(beauty(pictures[1]), beauty(pictures[2]));
  // Smooth lobes are specular at any threshold, the glossy box only at the last.
  expect_same_mean(term(pictures[0], Term::specular), term(pictures[1], Term::specular), 0.03);
  EXPECT_GT(mean_of(term(pictures[2], Term::specular)).value,
            1.05 * mean_of(term(pictures[1], Term::specular)).value);
}

TEST(partition, threshold_moves_direct_light_to_specular) {
  Scene scene;
  add_mesh(scene, ground, metal(Color(0.5f), 0.4f));
  add_mesh(scene, lamp, emitter(Color(1.0f)));
  RenderSettings settings = square(16, 256);
  const Framebuffer rough = render_clean(scene, down, settings);
  settings.specular_roughness = 0.5f;
  settings.seed = 2;
  const Framebuffer smooth = render_clean(scene, down, settings);
  expect_black(term(smooth, Term::direct));
  expect_black(term(rough, Term::specular));
  expect_same_mean(term(rough, Term::direct), term(smooth, Term::specular), 0.005);
}

TEST(partition, depth_limit_cuts_long_paths_only) {
  const Scene scene = cornell_scene();
  const Camera camera = cornell_camera();
  const Framebuffer all = render_clean(scene, camera, square(size, 128));
  RenderSettings settings = square(size, 128, 2);
  settings.max_depth = 1;
  const Framebuffer cut = render_clean(scene, camera, settings);
  expect_same_mean(term(all, Term::emitted), term(cut, Term::emitted), 0.03);
  expect_same_mean(term(all, Term::direct), term(cut, Term::direct), 0.03);
  expect_black(term(cut, Term::indirect));
  EXPECT_LT(mean_of(term(cut, Term::specular)).value, mean_of(term(all, Term::specular)).value);
}

}  // namespace
}  // namespace lumivec::test
