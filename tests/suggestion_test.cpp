#include "viewer/suggestion.h"

#include <gtest/gtest.h>

using lumivec::closest;
using lumivec::edit_distance;
using lumivec::suggestion;

TEST(EditDistance, IsZeroForEqualWords) {
  EXPECT_EQ(edit_distance("caustic", "caustic"), 0u);
}
TEST(EditDistance, OfAnEmptyWordIsTheLength) {
  EXPECT_EQ(edit_distance("", "tent"), 4u);
}
TEST(EditDistance, CountsAnInsertion) {
  EXPECT_EQ(edit_distance("emited", "emitted"), 1u);
}
TEST(EditDistance, CountsADeletion) {
  EXPECT_EQ(edit_distance("dirrect", "direct"), 1u);
}
TEST(EditDistance, CountsASubstitution) {
  EXPECT_EQ(edit_distance("tint", "tent"), 1u);
}
TEST(EditDistance, CountsASwapOnce) {
  EXPECT_EQ(edit_distance("caustci", "caustic"), 1u);
}
TEST(EditDistance, IsSymmetric) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("sitting", "kitten"), 3u);
}
TEST(EditDistance, EditsNoPartTwice) {
  EXPECT_EQ(edit_distance("ca", "abc"), 3u);
}

TEST(Closest, FindsTheNearest) {
  EXPECT_EQ(closest("boxx", {"tent", "box"}), "box");
}
TEST(Closest, IgnoresCase) {
  EXPECT_EQ(closest("SRGB", {"Display P3", "sRGB"}), "sRGB");
}
TEST(Closest, TakesABeginning) {
  EXPECT_EQ(closest("spec", {"emitted", "specular"}), "specular");
}
TEST(Closest, TakesTheFirstOfEqualOnes) {
  EXPECT_EQ(closest("cam3", {"cam1", "cam2"}), "cam1");
}
TEST(Closest, FindsNothingFarAway) {
  EXPECT_FALSE(closest("mitchell", {"box", "tent"}));
}
TEST(Closest, DoesNotGuessShortWords) {
  EXPECT_FALSE(closest("12", {"8", "16"}));
  EXPECT_EQ(closest("p3", {"P3"}), "P3");
}
TEST(Closest, FindsNothingAmongNothing) {
  EXPECT_FALSE(closest("box", {}));
}

TEST(Suggestion, AsksForTheNearest) {
  EXPECT_EQ(suggestion("emited", {"emitted", "direct"}), "did you mean 'emitted'?");
}
TEST(Suggestion, ListsWhatIsKnown) {
  EXPECT_EQ(suggestion("mitchell", {"box", "tent"}), "known are box, tent");
}
TEST(Suggestion, EndsALongList) {
  EXPECT_EQ(suggestion("other", std::vector<std::string>(14, "x")),
            "known are x, x, x, x, x, x, x, x, x, x, x, x and 2 more");
}
