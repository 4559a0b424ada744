#include "viewer/window/scene_edits.h"

#include <gtest/gtest.h>

namespace lumivec {
namespace {

class Edits : public testing::Test {
 protected:
  Edits() {
    scene_.materials.resize(2);
    scene_.materials[0].roughness = 0.9f;
    scene_.lights.resize(1);
    scene_.instances.resize(1);
  }
  MaterialEdit rougher(float to) const {
    MaterialEdit edit;
    edit.before = edit.after = edits_.patch().material(scene_, 0);
    edit.after.roughness = to;
    return edit;
  }
  float roughness() const { return edits_.patch().material(scene_, 0).roughness; }

  Scene scene_;
  SceneEdits edits_;
};

TEST_F(Edits, LeaveTheSceneAlone) {
  edits_.apply(rougher(0.2f), 0);
  EXPECT_EQ(roughness(), 0.2f);
  EXPECT_EQ(scene_.materials[0].roughness, 0.9f);
  EXPECT_EQ(edits_.patch().materials.size(), 1u) << "what was not edited is not copied";
}

TEST_F(Edits, AreUndoneAndRedone) {
  edits_.apply(rougher(0.5f), 0);
  edits_.apply(rougher(0.2f), 0);
  LightEdit light;
  light.after.intensity = Color(7.0f);
  edits_.apply(light, 0);
  EXPECT_EQ(edits_.patch().light(scene_, 0).intensity, Color(7.0f));
  EXPECT_TRUE(edits_.undo());
  EXPECT_EQ(edits_.patch().light(scene_, 0).intensity, Color(1.0f));
  edits_.undo();
  EXPECT_EQ(roughness(), 0.5f);
  edits_.undo();
  EXPECT_EQ(roughness(), 0.9f);
  EXPECT_FALSE(edits_.undo());
  EXPECT_TRUE(edits_.redo());
  EXPECT_EQ(roughness(), 0.5f);
  edits_.apply(rougher(0.1f), 0);
  EXPECT_FALSE(edits_.redo()) << "what was undone is replaced";
}

// A slider that is dragged is one thing to undo.
TEST_F(Edits, JoinWithinAGesture) {
  for (int i = 1; i < 20; ++i) edits_.apply(rougher(0.9f - 0.01f * float(i)), 1);
  EXPECT_EQ(edits_.done(), 1u);
  MaterialEdit other;
  other.index = 1;
  edits_.apply(other, 1);
  EXPECT_EQ(edits_.done(), 2u) << "it is another material";
  edits_.undo();
  edits_.undo();
  EXPECT_EQ(roughness(), 0.9f);
}

TEST_F(Edits, DoNotJoinAcrossGestures) {
  edits_.apply(rougher(0.5f), 1);
  edits_.apply(rougher(0.4f), 2);
  edits_.apply(rougher(0.3f), 2);
  EXPECT_EQ(edits_.done(), 2u);
  edits_.undo();
  EXPECT_EQ(roughness(), 0.5f);
  edits_.apply(rougher(0.2f), 1);
  EXPECT_EQ(edits_.done(), 2u) << "undoing ends a gesture";
}

// The engine's copy, which was changed before, becomes what the edits come to: undone ones too.
TEST_F(Edits, ArePutIntoACopy) {
  Scene copy = scene_;
  edits_.apply(rougher(0.2f), 0);
  PlaceEdit place;
  place.after.translate(V3d(1.0, 2.0, 3.0));
  edits_.apply(place, 0);
  EnvironmentEdit sky;
  sky.after.radiance = Color(3.0f);
  edits_.apply(sky, 0);
  apply_patch(edits_.patch(), copy);
  EXPECT_EQ(copy.materials[0].roughness, 0.2f);
  EXPECT_EQ(copy.instances[0].object_to_world, place.after);
  EXPECT_EQ(copy.environment.radiance, Color(3.0f));
  for (int i = 0; i < 3; ++i) edits_.undo();
  apply_patch(edits_.patch(), copy);
  EXPECT_EQ(copy.materials[0].roughness, 0.9f);
  EXPECT_EQ(copy.instances[0].object_to_world, M44d());
  EXPECT_EQ(copy.environment.radiance, Color(0.0f));
}

TEST_F(Edits, TellTheEngineWhatHasChanged) {
  edits_.apply(rougher(0.2f), 0);
  EXPECT_TRUE(edits_.changes().light);
  edits_.apply(PlaceEdit(), 0);
  EXPECT_FALSE(edits_.changes().light);
  EXPECT_EQ(edits_.changes().moved, std::vector<int>{0});
  edits_.undo();
  EXPECT_EQ(edits_.changes().moved, std::vector<int>{0});
  edits_.begin();
  EXPECT_TRUE(edits_.patch().empty());
  EXPECT_FALSE(edits_.undo());
}

}  // namespace
}  // namespace lumivec
