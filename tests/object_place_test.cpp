#include "viewer/window/object_place.h"

#include <gtest/gtest.h>

#include "test_scenes.h"

namespace lumivec::test {
namespace {

TEST(ObjectPlace, MakesTheTransformAgain) {
  M44d skewed;
  skewed.shear(V3d(0.3, -0.2, 0.1));
  M44d squeezed;
  squeezed.scale(V3d(0.5, 2.0, 3.0));
  M44d mirrored;
  mirrored.scale(V3d(-1.0, 1.0, 2.0));
  const M44d turned = rotation({1, 2, 3}, 1.1) * translation({4, -5, 6});
  for (const M44d& m : {M44d(), turned, squeezed * turned, mirrored * turned,
                        skewed * squeezed * turned, rotation({0, 1, 0}, 1.5707963267948966)}) {
    EXPECT_TRUE(transform_of(place_of(m)).equalWithAbsError(m, 1e-9)) << m;
  }
}

TEST(ObjectPlace, SpeaksOfDegreesAndFactors) {
  ObjectPlace place;
  place.turn = V3d(0.0, 90.0, 0.0);
  place.size = V3d(2.0, 1.0, 1.0);
  place.place = V3d(1.0, 2.0, 3.0);
  V3d x;
  transform_of(place).multVecMatrix(V3d(1.0, 0.0, 0.0), x);
  EXPECT_TRUE(x.equalWithAbsError(V3d(1.0, 2.0, 1.0), 1e-12)) << x << ": +X turns to -Z";
}

TEST(ObjectPlace, HasNothingForWhatIsFlat) {
  M44d flat;
  flat.scale(V3d(1.0, 0.0, 1.0));
  EXPECT_EQ(place_of(flat).size, V3d(1.0));
}

}  // namespace
}  // namespace lumivec::test
