#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "temporary_folder.h"
#include "viewer/display_error.h"
#include "viewer/display_transform.h"
#include "viewer/errors.h"
#include "viewer/exposure.h"

using namespace lumivec;

namespace {

const DisplayOptions aces = {"builtin", "sRGB", "ACES 1.0 SDR-video"};
const DisplayOptions plain = {"builtin", "sRGB", "Un-tone-mapped"};

float displayed_gray(const DisplayOptions& options, float value, double exposure = 0.0) {
  Picture picture(1, 1, Color(value));
  DisplayTransform(options).apply(picture, exposure);
  return picture.pixels[0].y;
}

template <typename Error>
std::string refusal(const DisplayOptions& options) {
  try {
    const DisplayTransform transform(options);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

// Of ACES 1.0's SDR video output transform, computed with OpenColorIO's own tools.
TEST(Display, ShowsGrayAsAcesDoes) {
  EXPECT_NEAR(displayed_gray(aces, 0.18f), 0.35595f, 1e-4f);
  EXPECT_NEAR(displayed_gray(aces, 1.0f), 0.81197f, 1e-4f);
  EXPECT_NEAR(displayed_gray(aces, 8.0f), 0.98443f, 1e-4f);
}
TEST(Display, ShowsGrayBySrgbWithoutToneMapping) {
  EXPECT_NEAR(displayed_gray(plain, 0.18f), 0.46136f, 1e-4f);
  EXPECT_NEAR(displayed_gray(plain, 1.0f), 1.0f, 1e-4f);
}
TEST(Display, KeepsPrimariesWithoutToneMapping) {
  Picture red(1, 1, Color(1.0f, 0.0f, 0.0f));
  DisplayTransform(plain).apply(red, 0.0);
  EXPECT_NEAR(red.pixels[0].x, 1.0f, 1e-3f);
  EXPECT_NEAR(red.pixels[0].y, 0.0f, 2e-3f);
  EXPECT_NEAR(red.pixels[0].z, 0.0f, 2e-3f);
}
TEST(Display, AppliesExposureToLight) {
  EXPECT_NEAR(displayed_gray(aces, 0.36f, -1.0), displayed_gray(aces, 0.18f), 1e-5f);
  EXPECT_NEAR(displayed_gray(aces, 1.0f, 3.0), displayed_gray(aces, 8.0f), 1e-5f);
}
TEST(Display, TakesWhatIsNotFiniteForBlack) {
  const float black = displayed_gray(aces, 0.0f);
  EXPECT_EQ(displayed_gray(aces, std::numeric_limits<float>::quiet_NaN()), black);
  EXPECT_EQ(displayed_gray(aces, std::numeric_limits<float>::infinity()), black);
  EXPECT_EQ(displayed_gray(aces, 1e38f, 10.0), black);
}
TEST(Display, ShowsTheBrightestAsWhite) {
  EXPECT_GT(displayed_gray(aces, 1e30f), 0.99f);
  EXPECT_GT(displayed_gray(plain, 1e30f), 0.99f);
}
TEST(Display, TreatsAllPixelsAlike) {
  Picture picture(37, 29, Color(0.18f));
  DisplayTransform(aces).apply(picture, 0.0);
  for (const Color& c : picture.pixels) EXPECT_EQ(c, picture.pixels[0]);
}
TEST(Display, RawPassesEverythingThrough) {
  EXPECT_FLOAT_EQ(displayed_gray({"builtin", "sRGB", "Raw"}, 3.5f), 3.5f);
}

TEST(Display, DefaultsToAcesOnSrgb) {
  const DisplayTransform transform({"builtin", "", ""});
  EXPECT_EQ(transform.display(), "sRGB");
  EXPECT_EQ(transform.view(), "ACES 1.0 SDR-video");
  EXPECT_TRUE(transform.is_srgb());
}
TEST(Display, HasThreeDisplays) {
  EXPECT_FALSE(DisplayTransform({"builtin", "display p3", ""}).is_srgb());
  EXPECT_FALSE(DisplayTransform({"builtin", "Rec.1886 Rec.709", ""}).is_srgb());
}
TEST(Display, SuggestsNames) {
  EXPECT_EQ(refusal<UsageError>({"builtin", "srbg", ""}),
            "--display: 'srbg' is no display; did you mean 'sRGB'?");
  EXPECT_EQ(refusal<UsageError>({"builtin", "", "untonemapped"}),
            "--view: 'untonemapped' is no view of display 'sRGB'; did you mean 'Un-tone-mapped'?");
}
TEST(Display, RefusesMissingAndBrokenConfigurations) {
  EXPECT_EQ(refusal<DisplayError>({"/no/such.ocio", "", ""}),
            "/no/such.ocio: no such file; give an OpenColorIO configuration, or --ocio builtin");
  const TemporaryFolder folder;
  std::ofstream(folder / "broken.ocio") << "not a configuration\n";
  const std::string text = refusal<DisplayError>({(folder / "broken.ocio").string(), "", ""});
  EXPECT_NE(text.find("is not a usable OpenColorIO configuration"), std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

// A configuration whose scene_linear role is ACEScg and that has no name for linear Rec. 709.
TEST(Display, EntersOtherConfigurationsByTheirInterchangeRole) {
  const TemporaryFolder folder;
  std::ofstream(folder / "other.ocio") << R"(ocio_profile_version: 2
roles:
  default: ap1
  scene_linear: ap1
  aces_interchange: ap0
  cie_xyz_d65_interchange: xyz
displays:
  Screen:
    - !<View> {name: Plain, view_transform: Plain, display_colorspace: Screen}
view_transforms:
  - !<ViewTransform>
    name: Plain
    from_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}
display_colorspaces:
  - !<ColorSpace>
    name: Screen
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}
  - !<ColorSpace>
    name: xyz
colorspaces:
  - !<ColorSpace>
    name: ap0
  - !<ColorSpace>
    name: ap1
    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}
)";
  Picture red(1, 1, Color(0.5f, 0.0f, 0.0f));
  Picture same = red;
  DisplayTransform({(folder / "other.ocio").string(), "", ""}).apply(red, 0.0);
  DisplayTransform(plain).apply(same, 0.0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(red.pixels[0][c], same.pixels[0][c], 1e-3f);
}

TEST(AutomaticExposure, BringsTheLogarithmicMeanToMiddleGray) {
  EXPECT_NEAR(automatic_exposure({Color(0.18f)}), 0.0, 1e-6);
  EXPECT_NEAR(automatic_exposure({Color(0.36f)}), -1.0, 1e-6);
  EXPECT_NEAR(automatic_exposure({Color(0.09f), Color(0.36f)}), 0.0, 1e-6);
}
TEST(AutomaticExposure, PassesOverBlackAndNonFinitePixels) {
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_NEAR(automatic_exposure({Color(0.0f), Color(0.36f), Color(infinity)}), -1.0, 1e-6);
  EXPECT_EQ(automatic_exposure({Color(0.0f)}), 0.0);
  EXPECT_EQ(automatic_exposure({}), 0.0);
}
