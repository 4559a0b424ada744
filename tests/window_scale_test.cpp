#include "viewer/window/window_scale.h"

#include <gtest/gtest.h>

namespace lumivec {
namespace {

TEST(WindowScale, IsEitherInTheWindowOrInTheDots) {
  EXPECT_EQ(window_scale(1.0f, 800, 800), (WindowScale{1.0f, 1.0f}));
  EXPECT_EQ(window_scale(2.0f, 1600, 1600), (WindowScale{2.0f, 1.0f})) << "X11, Windows";
  EXPECT_EQ(window_scale(2.0f, 800, 1600), (WindowScale{1.0f, 2.0f})) << "macOS, Wayland";
  EXPECT_EQ(window_scale(3.0f, 800, 1600), (WindowScale{1.5f, 2.0f}));
}

TEST(WindowScale, IsUsualWhereNothingIsKnown) {
  EXPECT_EQ(window_scale(0.5f, 800, 800), (WindowScale{1.0f, 1.0f})) << "letters stay legible";
  EXPECT_EQ(window_scale(1.0f, 0, 0), (WindowScale{1.0f, 1.0f})) << "minimised";
}

}  // namespace
}  // namespace lumivec
