#include "viewer/window/surface_view.h"

#include <gtest/gtest.h>

#include <limits>

#include "viewer/exposure.h"

namespace lumivec {
namespace {

constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

TEST(ErrorPicture, IsBrighterWhereTheErrorIsLarger) {
  const std::vector<Color> reference(4, Color(1.0f));
  const Picture map =
      error_picture({Color(1.0f), Color(1.1f), Color(0.7f), Color(9.0f)}, reference, 2, 2);
  for (std::size_t i = 1; i < 4; ++i)
    EXPECT_GT(luminance(map.pixels[i]), luminance(map.pixels[i - 1]) + 0.02f);
}

// What is not finite counts where it is and nowhere else.
TEST(ErrorPicture, KeepsNaNToItself) {
  const std::vector<Color> picture = {Color(1.0f), Color(1.2f), Color(nan_value), Color(1.0f)};
  const std::vector<Color> reference = {Color(1.0f), Color(1.0f), Color(1.0f), Color(nan_value)};
  const Picture map = error_picture(picture, reference, 2, 2);
  const Picture clean = error_picture({Color(1.0f), Color(1.2f), Color(9.0f), Color(1.0f)},
                                      std::vector<Color>(4, Color(1.0f)), 2, 2);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(map.pixels[i], clean.pixels[i]) << i;
}

}  // namespace
}  // namespace lumivec
