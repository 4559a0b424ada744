#include "viewer/walk/walk_engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "cornell_scene.h"
#include "test_scenes.h"
#include "viewer/walk/camera_path.h"

namespace lumivec::test {
namespace {

constexpr std::uint32_t all_terms = (1u << term_count) - 1;
constexpr double long_frame = 1e3;  // seconds: every pixel is traced

RenderSettings walk_settings(int size) {
  return square(size, 1, 5);
}

// At rest the picture becomes that of a still.
TEST(walk_engine, resting_converges_to_the_still) {
  const Scene scene = cornell_scene();
  const Camera camera = cornell_camera();
  const Framebuffer still = render_clean(scene, camera, square(24, 512));
  const std::array<WalkMode, 3> modes = {
      {{Reuse::shading, false}, {Reuse::shading, true}, {Reuse::image, true}}};
  for (const auto& [reuse, light_vectors] : modes) {
    SCOPED_TRACE(std::string(reuse == Reuse::image ? "image, " : "shading, ") +
                 (light_vectors ? "light vectors" : "paths"));
    WalkEngine engine(scene, walk_settings(24), {reuse, light_vectors});
    std::vector<Color> picture;
    // What was seen from elsewhere does not stay.
    for (const Camera& c :
         camera_path(parse_camera_path("--path", "orbit:-9"), camera, V3d(0.0), 4))
      engine.advance(c, 1e-6, all_terms, picture);
    for (int i = 0; i < 128; ++i) engine.advance(camera, long_frame, all_terms, picture);
    const Mean d = mean_difference(picture, beauty(still));
    const double level = mean_of(beauty(still), 1).value;
    EXPECT_NEAR(d.value, 0.0, sigmas * d.error + (light_vectors ? 0.01 : 0.0) * level);
    EXPECT_LT(d.error, 0.05 * level) << "too noisy to tell";
  }
}

TEST(live_tracer, light_is_cached_for_a_smaller_error_at_rest) {
  const Scene scene = cornell_scene();
  RenderSettings settings = walk_settings(16);
  settings.integrator = Integrator::light_vectors;
  LiveTracer tracer(scene, settings);
  tracer.set_view(cornell_camera(), 16, 16);
  constexpr int places = 256;
  const auto improve = [&](bool resting) {
    for (int i = 0; i < places; ++i) tracer.improve(long_frame, long_frame, resting);
  };
  improve(false);
  const std::size_t moving = tracer.record_cache().entries;
  const unsigned generation = tracer.generation();
  improve(false);
  EXPECT_LT(tracer.record_cache().entries, moving + moving / 20 + 2);
  EXPECT_EQ(tracer.generation(), generation);
  improve(true);
  EXPECT_GT(tracer.record_cache().entries, moving + moving / 10);
  EXPECT_GT(tracer.generation(), generation);
}

// What is edited shows, and only that: the picture becomes the still of the changed scene.
TEST(walk_engine, changes_show) {
  constexpr int lamp = 5, block = 6;  // instances
  constexpr int size = 16;
  const Camera camera = cornell_camera();
  struct Edit {
    const char* name;
    std::function<SceneChanges(Scene&)> apply;
  };
  const auto emission_of_lamp = [](Scene& scene) -> Color& {
    return scene.materials[std::size_t(scene.instances[lamp].material)].emission;
  };
  const std::vector<Edit> edits = {
      {"light",
       [&](Scene& scene) {
         emission_of_lamp(scene) *= Color(3.0f, 1.0f, 0.3f);
         return SceneChanges{{}, {}, true};
       }},
      {"object",
       [&](Scene& scene) {
         scene.instances[block].object_to_world *= translation({0.5, 0.5, 0.2});
         return SceneChanges{{block}, {}, false};
       }},
      {"hidden",
       [&](Scene& scene) {
         scene.instances[block].visible = false;
         return SceneChanges{{block}, {}, false};
       }},
  };
  for (const Edit& edit : edits) {
    for (const bool light_vectors : {false, true}) {
      SCOPED_TRACE(std::string(edit.name) + (light_vectors ? ", light vectors" : ", paths"));
      Scene scene = cornell_scene();
      WalkEngine engine(scene, walk_settings(size), {Reuse::shading, light_vectors});
      std::vector<Color> picture;
      for (int i = 0; i < 16; ++i) engine.advance(camera, long_frame, all_terms, picture);
      engine.update(edit.apply(scene));
      for (int i = 0; i < 96; ++i) engine.advance(camera, long_frame, all_terms, picture);
      const Framebuffer still = render_clean(scene, camera, square(size, 256));
      const Mean d = mean_difference(picture, beauty(still));
      const double level = mean_of(beauty(still), 1).value;
      EXPECT_NEAR(d.value, 0.0, sigmas * d.error + (light_vectors ? 0.01 : 0.0) * level);
      EXPECT_LT(d.error, 0.08 * level) << "too noisy to tell";
    }
  }
}

// Terms are chosen without any tracing, and add up.
TEST(walk_engine, layers_sum_to_the_picture) {
  const Scene scene = cornell_scene();
  WalkEngine engine(scene, walk_settings(24), {});
  std::vector<Color> picture, layer;
  const WalkEngine::Frame frame = engine.advance(cornell_camera(), long_frame, all_terms, picture);
  EXPECT_EQ(frame.holes, 0u);
  std::vector<Color> sum(picture.size(), Color(0.0f));
  for (std::size_t t = 0; t < term_count; ++t) {
    engine.layer(static_cast<Term>(t), layer);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += layer[i];
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(sum[i][c], picture[i][c], 1e-5f * (1.0f + picture[i][c]));
  }
}

// A board of two unlit squares before a third: what is carried over keeps to its surface, and what
// comes into view is filled from nothing else once it is traced.
TEST(walk_engine, edges_stay_exact_while_the_eye_moves) {
  Scene scene;
  const auto flat = [&](const Mesh& mesh, const Color& color) {
    Material material = emitter(color, true);
    add_mesh(scene, mesh, material);
  };
  flat(quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), Color(1.0f, 0.0f, 0.0f));
  flat(quad({-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}), Color(0.0f, 1.0f, 0.0f));
  const Camera camera = perspective_camera({0, 0, 4}, {0, 0, 0}, 0.6);
  WalkEngine engine(scene, walk_settings(48), {Reuse::shading, false});
  const std::vector<Camera> path =
      camera_path(parse_camera_path("--path", "orbit:24"), camera, V3d(0.0), 25);
  std::vector<Color> picture;
  engine.advance(path[0], long_frame, 1u << unsigned(Term::emitted), picture);
  for (std::size_t i = 1; i < path.size(); ++i) {
    // As few samples as the engine takes; pixel centres must show what a ray through them meets.
    engine.advance(path[i], 1e-6, 1u << unsigned(Term::emitted), picture);
    LiveTracer truth(scene, walk_settings(48));
    truth.set_view(path[i], 48, 48);
    VisibleSurfaces points;
    truth.see(points);
    int wrong = 0;
    for (std::size_t k = 0; k < picture.size(); ++k) {
      const bool green = points.object[k] == 1;
      if ((picture[k].y > picture[k].x) != green) ++wrong;
    }
    EXPECT_LE(wrong, 2) << "of " << picture.size() << " pixels in frame " << i;
  }
}

// At rest edges become smooth; when the eye goes on, what their pixels mixed stays on no surface.
TEST(walk_engine, smooth_edges_leave_no_dots_behind) {
  constexpr int size = 48;
  Scene scene;
  add_mesh(scene, quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), emitter(Color(1, 0, 0), true));
  add_mesh(scene, quad({-0.5f, -0.4f, 0}, {1, 0.2f, 0}, {-0.2f, 1, 0}),
           emitter(Color(0, 1, 0), true));
  const Camera camera = perspective_camera({0, 0, 4}, {0, 0, 0}, 0.6);
  const std::vector<Camera> path =
      camera_path(parse_camera_path("--path", "orbit:24"), camera, V3d(0.0), 13);
  constexpr std::uint32_t shown = 1u << unsigned(Term::emitted);
  WalkEngine engine(scene, walk_settings(size), {Reuse::shading, false});
  std::vector<Color> picture;
  for (int i = 0; i < 16; ++i) engine.advance(path[0], long_frame, shown, picture);
  const auto is_mixed = [](const Color& c) { return c.x > 0.02f && c.y > 0.02f; };
  EXPECT_GT(std::count_if(picture.begin(), picture.end(), is_mixed), size / 2)
      << "edges are not smooth";
  for (std::size_t i = 1; i < path.size(); ++i) {
    engine.advance(path[i], 1e-6, shown, picture);
    EXPECT_EQ(std::count_if(picture.begin(), picture.end(), is_mixed), 0) << "in frame " << i;
  }
}

// What a mirror shows moves over it with the eye, and is not carried along with the mirror.
TEST(walk_engine, reflections_move_with_the_eye) {
  constexpr int size = 64;
  constexpr std::uint32_t shown = 1u << unsigned(Term::specular);
  struct Shape {
    const char* name;
    std::function<void(Scene&)> add;
    double most_pixels;  // that the reflection may be off
  };
  const Material mirror = metal(Color(1.0f));
  const std::vector<Shape> shapes = {
      {"flat",
       [&](Scene& s) {
         add_mesh(s, quad({-2, -2, 0}, {4, 0, 0}, {0, 4, 0}), mirror);
       },
       0.5},
      // By the curvature at a point that light meets head-on.
      {"ball", [&](Scene& s) { add_sphere(s, 1.2f, mirror, M44d()); }, 0.8},
  };
  for (const Shape& shape : shapes) {
    SCOPED_TRACE(shape.name);
    Scene scene;
    shape.add(scene);
    // The lamp, above the eye; the walls behind it give what else the mirror shows.
    add_mesh(scene, quad({-0.4f, 0.8f, 5}, {0.8f, 0, 0}, {0, 0.8f, 0}), emitter(Color(5.0f), true));
    add_mesh(scene, quad({-40, -40, 20}, {80, 0, 0}, {0, 80, 0}), emitter(Color(0.05f), true));
    const Camera camera = perspective_camera({0, 0, 4}, {0, 0, 0}, 0.6);
    const std::vector<Camera> path =
        camera_path(parse_camera_path("--path", "orbit:8"), camera, V3d(0.0), 9);
    // Where the light is, pixels.
    const auto middle = [](const std::vector<Color>& picture) {
      V2f sum(0.0f);
      float weight = 0.0f;
      for (int i = 0; i < size * size; ++i) {
        const float w = picture[std::size_t(i)].y > 0.5f ? picture[std::size_t(i)].y : 0.0f;
        sum += V2f(float(i % size), float(i / size)) * w;
        weight += w;
      }
      return sum * (1.0f / weight);
    };
    WalkEngine engine(scene, walk_settings(size), {Reuse::shading, false});
    std::vector<Color> picture;
    engine.advance(path[0], long_frame, shown, picture);
    const V2f first = middle(picture);
    std::size_t traced = 0;
    for (std::size_t i = 1; i < path.size(); ++i)
      traced += engine.advance(path[i], 1e-6, shown, picture).traced;
    EXPECT_LT(traced, picture.size() / 4) << "too many samples to see what is carried over";
    const Framebuffer still = render_clean(scene, path.back(), square(size, 16));
    const V2f truth = middle(term(still, Term::specular));
    const V2f now = middle(picture);
    EXPECT_GT((truth - first).length(), 3.0 * shape.most_pixels) << "it hardly moved";
    EXPECT_LT((truth - now).length(), shape.most_pixels);
  }
}

// The cache in image space only guesses between points, but points go where they are seen.
TEST(walk_engine, points_in_image_space_move_with_what_they_show) {
  Scene scene;
  add_mesh(scene, quad({-9, -9, -2}, {18, 0, 0}, {0, 18, 0}), emitter(Color(1, 0, 0), true));
  add_mesh(scene, quad({-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}), emitter(Color(0, 1, 0), true));
  constexpr int size = 48;
  const Camera camera = perspective_camera({0, 0, 4}, {0, 0, 0}, 0.6);
  const std::vector<Camera> path =
      camera_path(parse_camera_path("--path", "orbit:24"), camera, V3d(0.0), 25);
  constexpr std::uint32_t shown = 1u << unsigned(Term::emitted);
  WalkEngine engine(scene, walk_settings(size), {Reuse::image, false});
  std::vector<Color> picture;
  engine.advance(path[0], long_frame, shown, picture);
  for (std::size_t i = 1; i < path.size(); ++i) {
    engine.advance(path[i], 1e-6, shown, picture);
    LiveTracer truth(scene, walk_settings(size));
    truth.set_view(path[i], size, size);
    VisibleSurfaces points;
    truth.see(points);
    int wrong = 0, edges = 0;
    for (std::size_t k = 0; k + size < picture.size(); ++k) {
      const bool green = points.object[k] == 1;
      wrong += (picture[k].y > picture[k].x) != green ? 1 : 0;
      edges += (points.object[k + 1] == 1) != green || (points.object[k + size] == 1) != green;
    }
    // Within about a pixel of the outline, of which the eye sees both sides.
    EXPECT_LE(wrong, 2 * edges) << "in frame " << i;
  }
}

TEST(shading_cache, traces_about_as_many_pixels_as_asked) {
  const Scene scene = cornell_scene();
  LiveTracer tracer(scene, walk_settings(64));
  tracer.set_view(cornell_camera(), 64, 64);
  Visibility visibility(64, 64);
  visibility.see_all(tracer);
  ShadingCache cache(64, 64);
  cache.see(tracer, visibility);
  std::vector<LiveRequest> requests;
  for (const std::size_t count : {50u, 400u, 4096u}) {
    cache.rest(visibility.now());
    cache.choose(count, requests);
    EXPECT_NEAR(double(requests.size()), double(count), 0.02 * double(count) + 16.0);
    std::set<std::uint32_t> pixels;
    std::array<int, 4> quarters{};
    for (const LiveRequest& r : requests) {
      EXPECT_TRUE(pixels.insert(r.pixel).second) << "twice in a frame";
      ++quarters[std::size_t((r.pixel % 64 >= 32 ? 1 : 0) + (r.pixel / 64 >= 32 ? 2 : 0))];
    }
    for (const int n : quarters) EXPECT_NEAR(n, double(count) / 4.0, 0.1 * double(count) + 8.0);
  }
}

// Cached light that has become better takes nothing from what is known of the rest.
TEST(shading_cache, doubts_cached_light_alone) {
  const Scene scene = cornell_scene();
  LiveTracer tracer(scene, walk_settings(8));
  tracer.set_view(cornell_camera(), 8, 8);
  Visibility visibility(8, 8);
  visibility.see_all(tracer);
  ShadingCache cache(8, 8);
  cache.see(tracer, visibility);
  const auto add = [&](float light) {
    LiveSample sample;
    sample.terms.fill(Color(light));
    sample.pixel = 27;
    cache.add({sample});
  };
  constexpr int before = 10;
  for (int i = 0; i < before; ++i) add(1.0f);
  cache.doubt_cached(1.0f);
  add(2.0f);
  std::vector<Color> layer;
  for (std::size_t t = 0; t < term_count; ++t) {
    cache.resolve(1u << t, visibility.now(), layer);
    const bool cached = Term(t) != Term::emitted && Term(t) != Term::direct;
    EXPECT_NEAR(layer[27].y, cached ? 1.5f : 1.0f + 1.0f / (before + 1.0f), 1e-5f) << term_names[t];
  }
}

// Each pixel's samples go through a sequence of its own without a gap, which covers its domain
// evenly. At rest a pixel that an edge goes through, whose samples differ, has several at once.
TEST(shading_cache, numbers_the_samples_of_each_pixel) {
  const Scene scene = cornell_scene();
  LiveTracer tracer(scene, walk_settings(32));
  tracer.set_view(cornell_camera(), 32, 32);
  Visibility visibility(32, 32);
  visibility.see_all(tracer);
  ShadingCache cache(32, 32);
  cache.see(tracer, visibility);
  const std::vector<std::int32_t>& object = visibility.now().object;
  const auto unsure = [&](std::uint32_t pixel) {
    return pixel % 32 > 0 && object[pixel] != object[pixel - 1];
  };
  std::vector<std::uint32_t> next(1024, 0);
  std::vector<LiveRequest> requests;
  std::vector<LiveSample> samples;
  std::uint32_t most = 0;
  for (int i = 0; i < 20; ++i) {
    cache.choose(512, requests);
    samples.clear();
    for (const LiveRequest& r : requests) {
      EXPECT_EQ(r.sample, next[r.pixel]);
      next[r.pixel] += r.count;
      if (unsure(r.pixel)) most = std::max(most, r.count);
      LiveSample sample;
      sample.terms.fill(Color(0.0f));
      sample.terms[0] = Color(unsure(r.pixel) && i % 2 == 0 ? 5.0f : 1.0f);
      sample.pixel = r.pixel;
      sample.count = r.count;
      samples.push_back(sample);
    }
    cache.add(samples);
    cache.rest(visibility.now());
  }
  EXPECT_GT(most, 1u);
  std::array<double, 2> taken{}, pixels{};  // of sure ones, of others
  for (std::uint32_t i = 0; i < 1024; ++i) {
    EXPECT_GT(next[i], 2u);
    taken[unsure(i) ? 1 : 0] += next[i];
    pixels[unsure(i) ? 1 : 0] += 1.0;
  }
  EXPECT_GT(taken[1] / pixels[1], 2.0 * taken[0] / pixels[0]);
}

// What has been traced waits; what shows nothing yet comes first.
TEST(shading_cache, untraced_pixels_come_first) {
  const Scene scene = cornell_scene();
  LiveTracer tracer(scene, walk_settings(32));
  tracer.set_view(cornell_camera(), 32, 32);
  Visibility visibility(32, 32);
  visibility.see_all(tracer);
  ShadingCache cache(32, 32);
  cache.see(tracer, visibility);
  std::vector<LiveRequest> requests;
  std::vector<LiveSample> samples;
  cache.choose(512, requests);
  tracer.trace(requests, true, samples);
  cache.add(samples);
  EXPECT_EQ(cache.hole_count(), 1024 - requests.size());
  std::set<std::uint32_t> traced;
  for (const LiveRequest& r : requests) traced.insert(r.pixel);
  cache.rest(visibility.now());
  cache.choose(256, requests);
  for (const LiveRequest& r : requests) EXPECT_EQ(traced.count(r.pixel), 0u);
}

}  // namespace
}  // namespace lumivec::test
