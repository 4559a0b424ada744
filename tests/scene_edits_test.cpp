#include "viewer/window/scene_edits.h"

#include <gtest/gtest.h>

namespace lumivec {
namespace {

MaterialEdit rougher(const LoadedScene& scene, float roughness) {
  MaterialEdit edit;
  edit.before = edit.after = scene.scene.materials[0];
  edit.after.roughness = roughness;
  return edit;
}

class Edits : public testing::Test {
 protected:
  Edits() {
    auto scene = std::make_shared<LoadedScene>();
    scene->scene.materials.resize(2);
    scene->scene.materials[0].roughness = 0.9f;
    scene->scene.lights.resize(1);
    original_ = scene_ = scene;
  }
  float roughness() const { return scene_->scene.materials[0].roughness; }

  std::shared_ptr<const LoadedScene> original_, scene_;
  SceneEdits edits_;
};

TEST_F(Edits, LeaveTheSceneAlone) {
  scene_ = edits_.apply(*scene_, rougher(*scene_, 0.2f), 0);
  EXPECT_EQ(roughness(), 0.2f);
  EXPECT_EQ(original_->scene.materials[0].roughness, 0.9f);
}

TEST_F(Edits, AreUndoneAndRedone) {
  scene_ = edits_.apply(*scene_, rougher(*scene_, 0.5f), 0);
  scene_ = edits_.apply(*scene_, rougher(*scene_, 0.2f), 0);
  LightEdit light;
  light.after.intensity = Color(7.0f);
  scene_ = edits_.apply(*scene_, light, 0);
  scene_ = edits_.undo(*scene_);
  EXPECT_EQ(scene_->scene.lights[0].intensity, Color(1.0f));
  scene_ = edits_.undo(*scene_);
  EXPECT_EQ(roughness(), 0.5f);
  scene_ = edits_.undo(*scene_);
  EXPECT_EQ(roughness(), 0.9f);
  EXPECT_FALSE(edits_.undo(*scene_));
  scene_ = edits_.redo(*scene_);
  EXPECT_EQ(roughness(), 0.5f);
  scene_ = edits_.apply(*scene_, rougher(*scene_, 0.1f), 0);
  EXPECT_FALSE(edits_.redo(*scene_)) << "what was undone is replaced";
}

// A slider that is dragged is one thing to undo.
TEST_F(Edits, JoinWithinAGesture) {
  for (int i = 1; i < 20; ++i)
    scene_ = edits_.apply(*scene_, rougher(*scene_, 0.9f - 0.01f * float(i)), 1);
  EXPECT_EQ(edits_.done(), 1u);
  MaterialEdit other;
  other.index = 1;
  scene_ = edits_.apply(*scene_, other, 1);
  EXPECT_EQ(edits_.done(), 2u) << "it is another material";
  scene_ = edits_.undo(*scene_);
  scene_ = edits_.undo(*scene_);
  EXPECT_EQ(roughness(), 0.9f);
}

TEST_F(Edits, DoNotJoinAcrossGestures) {
  scene_ = edits_.apply(*scene_, rougher(*scene_, 0.5f), 1);
  scene_ = edits_.apply(*scene_, rougher(*scene_, 0.4f), 2);
  scene_ = edits_.apply(*scene_, rougher(*scene_, 0.3f), 2);
  EXPECT_EQ(edits_.done(), 2u);
  scene_ = edits_.undo(*scene_);
  EXPECT_EQ(roughness(), 0.5f);
  scene_ = edits_.apply(*scene_, rougher(*scene_, 0.2f), 1);
  EXPECT_EQ(edits_.done(), 2u) << "undoing ends a gesture";
}

}  // namespace
}  // namespace lumivec
