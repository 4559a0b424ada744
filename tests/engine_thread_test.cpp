#include "viewer/window/engine_thread.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>

#include "cornell_scene.h"
#include "temporary_folder.h"
#include "test_scenes.h"

namespace lumivec::test {
namespace {

const std::filesystem::path scenes = std::filesystem::path(LUMIVEC_SOURCE_DIR) / "scenes";
constexpr int size = 32;

class Engine : public testing::Test {
 protected:
  // Until done, for at most a minute.
  template <class Done>
  bool wait(const Done& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (std::chrono::steady_clock::now() < end) {
      engine_.take_picture();
      engine_.take_layers();
      if (done()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return false;
  }

  void open(const std::filesystem::path& file) {
    const EngineStatus before = engine_.status();
    engine_.open({file, {}, {}, {}});
    ASSERT_TRUE(wait([&] {
      const EngineStatus now = engine_.status();
      return now.opened_number > before.opened_number || now.error_number > before.error_number;
    }));
  }

  void look(double rest_samples) {
    const EngineStatus status = engine_.status();
    view_.scene = status.scene_number;
    view_.camera = status.scene->scene.cameras.front();
    view_.width = view_.height = size;
    view_.rest_samples = rest_samples;
    engine_.request(view_);
  }

  std::atomic<int> news_ = 0;
  ViewRequest view_;
  EngineThread engine_{[this] { ++news_; }};
};

double level(const std::vector<Color>& pixels) {
  return mean_of(pixels, 1).value;
}

TEST_F(Engine, ShowsAScene) {
  open(scenes / "cornell_box_1.gltf");
  EXPECT_EQ(engine_.status().error, "");
  EXPECT_FALSE(engine_.status().scene->bounds.isEmpty());
  look(8.0);
  ASSERT_TRUE(wait([&] { return engine_.picture().samples >= 8.0; }));
  const EnginePicture& picture = engine_.picture();
  EXPECT_EQ(picture.width, size);
  EXPECT_EQ(picture.pixels.size(), std::size_t(size * size));
  EXPECT_EQ(picture.scene, engine_.status().scene_number);
  EXPECT_GT(level(picture.pixels), 0.0);
  EXPECT_GT(news_, 0);
}

// A view that rests costs nothing once it has its samples, and goes on when more are wanted.
TEST_F(Engine, RestsWhenThereIsNothingToDo) {
  open(scenes / "cornell_box_1.gltf");
  look(2.0);
  ASSERT_TRUE(wait([&] { return engine_.status().resting && engine_.picture().samples >= 2.0; }));
  const std::uint64_t number = engine_.picture().number;
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(engine_.take_picture());
  EXPECT_EQ(engine_.picture().number, number);
  look(4.0);
  EXPECT_TRUE(wait([&] { return engine_.picture().samples >= 4.0; }));
}

// Where cached light holds: ellipses on the surfaces of the room.
TEST_F(Engine, TellsOfItsRecords) {
  open(scenes / "cornell_box_1.gltf");
  view_.layers = view_.records = true;
  look(4.0);
  ASSERT_TRUE(wait([&] { return !engine_.layers().records.empty(); }));
  const Imath::Box3d& bounds = engine_.status().scene->bounds;
  const double slack = 1e-3 * bounds.size().length();
  const Imath::Box3d room(bounds.min - V3d(slack), bounds.max + V3d(slack));
  for (const RecordMark& mark : engine_.layers().records) {
    EXPECT_TRUE(room.intersects(mark.position)) << mark.position;
    EXPECT_NEAR(mark.normal.length(), 1.0, 1e-4);
    const double a = mark.half_axis[0].length(), b = mark.half_axis[1].length();
    EXPECT_GT(a, 0.0);
    EXPECT_GE(b, 0.999 * a);
    EXPECT_LT(b, bounds.size().length());
    EXPECT_NEAR(mark.half_axis[0].dot(mark.normal), 0.0, 1e-3 * a);
    EXPECT_NEAR(mark.half_axis[0].dot(mark.half_axis[1]), 0.0, 1e-3 * a * b);
  }
  view_.records = false;
  look(4.0);
  EXPECT_TRUE(wait([&] { return engine_.layers().records.empty(); }));
}

// With nothing to rest for, whatever changes is seen still: paused.
TEST_F(Engine, ShowsChangesWhilePaused) {
  open(scenes / "cornell_box_1.gltf");
  look(0.0);
  ASSERT_TRUE(wait([&] { return engine_.status().resting && engine_.picture().number > 0; }));
  const std::uint64_t number = engine_.picture().number;
  view_.terms = 1u << unsigned(Term::emitted);
  engine_.request(view_);
  ASSERT_TRUE(wait([&] { return engine_.picture().number > number; }));
  const double emitted = level(engine_.picture().pixels);
  view_.terms = all_terms;
  engine_.request(view_);
  ASSERT_TRUE(wait([&] { return engine_.picture().number > number + 1; }));
  EXPECT_GT(level(engine_.picture().pixels), emitted);
}

TEST_F(Engine, FollowsTheSize) {
  open(scenes / "cornell_box_1.gltf");
  look(64.0);
  ASSERT_TRUE(wait([&] { return engine_.picture().number > 2; }));
  const double before = level(engine_.picture().pixels);
  const std::uint64_t records = engine_.picture().records;
  for (const auto& [width, height] :
       {std::pair{48, 20}, std::pair{20, 48}, std::pair{1, 1}, std::pair{size, size}}) {
    view_.width = width;
    view_.height = height;
    engine_.request(view_);
    ASSERT_TRUE(wait(
        [&] { return engine_.picture().width == width && engine_.picture().height == height; }));
    EXPECT_EQ(engine_.picture().pixels.size(), std::size_t(width * height));
  }
  EXPECT_GE(engine_.picture().records, records) << "cached light is kept";
  ASSERT_TRUE(wait([&] { return engine_.picture().samples >= 4.0; }));
  EXPECT_NEAR(level(engine_.picture().pixels), before, 0.3 * before);
}

TEST_F(Engine, TellsLayersAndSurfaces) {
  open(scenes / "cornell_box_1.gltf");
  view_.layers = true;
  look(4.0);
  ASSERT_TRUE(wait([&] { return engine_.status().resting && engine_.layers().width == size; }));
  const LayerPicture& layers = engine_.layers();
  const EnginePicture& picture = engine_.picture();
  ASSERT_EQ(picture.pixels.size(), layers.layers[0].size());
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    Color sum(0.0f);
    for (const std::vector<Color>& layer : layers.layers) sum += layer[i];
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], picture.pixels[i][c], 1e-4f * (1.0f + sum[c]));
  }
  EXPECT_GE(layers.surfaces.object[size / 2 * size + size / 2], 0);
}

TEST_F(Engine, TellsWhatIsAtAPlace) {
  open(scenes / "cornell_box_1.gltf");
  look(1.0);
  view_.pick = {7, 0.5, 0.5};
  engine_.request(view_);
  ASSERT_TRUE(wait([&] { return engine_.picture().pick.number == 7; }));
  const PickAnswer& pick = engine_.picture().pick;
  EXPECT_GE(pick.object, 0);
  Imath::Box3d near = engine_.status().scene->bounds;
  const V3d margin = near.size() * 1e-3;
  near.min -= margin;
  near.max += margin;
  EXPECT_TRUE(near.intersects(pick.point)) << pick.point;
  const double side = near.size().length();
  EXPECT_NEAR((pick.point - engine_.picture().pivot).length() / side, 0.0, 0.05);
}

TEST_F(Engine, ComparesWithPathTracing) {
  open(scenes / "cornell_box_1.gltf");
  view_.compare = true;
  look(32.0);
  ASSERT_TRUE(wait(
      [&] { return engine_.picture().samples >= 32.0 && !engine_.picture().compared.empty(); }));
  const double light = level(engine_.picture().pixels);
  EXPECT_NEAR(level(engine_.picture().compared), light, 0.15 * light);
  view_.compare = false;
  view_.rest_samples = 64.0;
  engine_.request(view_);
  EXPECT_TRUE(wait([&] { return engine_.picture().compared.empty(); }));
}

TEST_F(Engine, KeepsTheSceneWhenAnotherCannotBeLoaded) {
  const TemporaryFolder folder;
  std::ofstream(folder / "broken.gltf") << "{";
  open(scenes / "cornell_box_1.gltf");
  look(1e9);
  const auto scene = engine_.status().scene;
  open(folder / "broken.gltf");
  EXPECT_NE(engine_.status().error.find("broken.gltf"), std::string::npos);
  EXPECT_EQ(engine_.status().error.find('\n'), std::string::npos);
  EXPECT_EQ(engine_.status().doing, "");
  EXPECT_EQ(engine_.status().scene, scene);
  const std::uint64_t number = engine_.picture().number;
  EXPECT_TRUE(wait([&] { return engine_.picture().number > number + 2; })) << "it goes on";
  open(scenes / "cornell_box_2.gltf");
  EXPECT_EQ(engine_.status().error, "");
  EXPECT_NE(engine_.status().scene, scene);
}

TEST_F(Engine, BeginsAgainWithOtherKnobs) {
  open(scenes / "cornell_box_1.gltf");
  look(4.0);
  ASSERT_TRUE(wait([&] { return engine_.status().resting; }));
  EngineKnobs knobs;
  knobs.light_vectors = false;
  engine_.set_knobs(knobs);
  ASSERT_TRUE(wait([&] { return engine_.picture().records == 0 && engine_.picture().number > 0; }));
  EXPECT_TRUE(wait([&] { return engine_.picture().samples >= 4.0; }));
}

TEST_F(Engine, ShowsAChangedScene) {
  open(scenes / "cornell_box_1.gltf");
  look(4.0);
  ASSERT_TRUE(wait([&] { return engine_.status().resting && engine_.picture().number > 0; }));
  const double before = level(engine_.picture().pixels);
  // The first change makes another engine, the second one changes the scene under it.
  const std::shared_ptr<const LoadedScene> scene = engine_.status().scene;
  for (const float factor : {4.0f, 16.0f}) {
    ScenePatch patch;
    for (std::size_t i = 0; i < scene->scene.materials.size(); ++i) {
      patch.materials[i] = scene->scene.materials[i];
      patch.materials[i].emission *= factor;
    }
    SceneChanges changes;
    changes.light = true;
    const std::uint64_t change = engine_.change(patch, changes, engine_.status().opened_number);
    ASSERT_TRUE(wait([&] {
      look(64.0);
      return engine_.picture().change == change && engine_.picture().samples >= 64.0;
    }));
    EXPECT_NEAR(level(engine_.picture().pixels), double(factor) * before,
                0.1 * double(factor) * before);
  }
  EXPECT_EQ(engine_.status().scene, scene) << "the file's scene stays as it is";
}

TEST_F(Engine, FollowsAnObjectThatIsMoved) {
  open(scenes / "cornell_box_1.gltf");
  look(4.0);
  view_.pick = {1, 0.5, 0.5};
  engine_.request(view_);
  ASSERT_TRUE(wait([&] { return engine_.picture().pick.number == 1; }));
  const int object = engine_.picture().pick.object;
  ASSERT_GE(object, 0);
  const double far = 10.0 * engine_.status().bounds.size().length();
  ScenePatch patch;
  M44d away = engine_.status().scene->scene.instances[std::size_t(object)].object_to_world;
  away[3][1] += far;
  patch.places[std::size_t(object)] = away;
  SceneChanges changes;
  changes.moved = {object};
  const std::uint64_t change = engine_.change(patch, changes, engine_.status().opened_number);
  view_.pick.number = 2;
  ASSERT_TRUE(wait([&] {
    look(4.0);
    return engine_.picture().change == change && engine_.picture().pick.number == 2;
  }));
  EXPECT_NE(engine_.picture().pick.object, object);
  EXPECT_GT(engine_.status().bounds.size().length(), 0.5 * far);
}

// What was done to the scene before does not land on the one that is opened, however late it comes.
TEST_F(Engine, LeavesAnotherSceneAlone) {
  open(scenes / "cornell_box_1.gltf");
  const EngineStatus before = engine_.status();
  ScenePatch patch;
  patch.environment = Environment();
  patch.environment->radiance = Color(100.0f);
  SceneChanges changes;
  changes.light = true;
  engine_.open({scenes / "cornell_box_2.gltf", {}, {}, {}});
  for (int i = 0; i < 50 && engine_.status().opened_number == before.opened_number; ++i) {
    engine_.change(patch, changes, before.opened_number);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_TRUE(wait([&] { return engine_.status().opened_number > before.opened_number; }));
  engine_.change(patch, changes, before.opened_number);
  look(4.0);
  ASSERT_TRUE(wait([&] { return engine_.picture().samples >= 4.0; }));
  EXPECT_EQ(engine_.status().scene->source.file.filename(), "cornell_box_2.gltf");
  EXPECT_LT(level(engine_.picture().pixels), 50.0);
}

// Ending while it loads or works waits for neither a picture nor a window.
TEST(EngineThread, EndsAtAnyTime) {
  for (int i = 0; i < 3; ++i) {
    EngineThread engine([] {});
    if (i > 0) engine.open({scenes / "cornell_box_1.gltf", {}, {}, {}});
    if (i > 1) std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
}

}  // namespace
}  // namespace lumivec::test
