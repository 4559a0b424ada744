#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "temporary_folder.h"
#include "viewer/errors.h"
#include "viewer/image_error.h"
#include "viewer/layered_image.h"

using namespace lumivec;

namespace {

void write_channels(const std::filesystem::path& file, int width, int height,
                    const std::vector<std::string>& names, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(width, height, int(names.size()), type);
  spec.channelnames = names;
  std::vector<float> values;
  for (int i = 0; i < width * height; ++i) {
    for (std::size_t c = 0; c < names.size(); ++c) values.push_back(float(i) + float(c) / 8.0f);
  }
  const auto output = OIIO::ImageOutput::create(file.string());
  output->open(file.string(), spec);
  output->write_image(OIIO::TypeDesc::FLOAT, values.data());
  output->close();
}

std::string refusal(const std::filesystem::path& file) {
  try {
    read_layered_image(file);
  } catch (const CommandError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST(ImageError, IsZeroForEqualPictures) {
  const Picture picture(3, 2, Color(0.7f));
  const ImageError error = image_error(picture, picture);
  EXPECT_EQ(error.rmse, 0.0);
  EXPECT_EQ(error.relmse, 0.0);
  EXPECT_EQ(error.mean_absolute, 0.0);
  EXPECT_EQ(error.pixels, 6u);
}
TEST(ImageError, FollowsTheDefinitions) {
  Picture a(2, 1), b(2, 1);
  a.pixels = {Color(1.0f, 2.0f, 0.0f), Color(0.0f)};
  b.pixels = {Color(0.5f, 2.0f, 0.1f), Color(0.0f)};
  const ImageError error = image_error(a, b);
  EXPECT_NEAR(error.rmse, std::sqrt((0.25 + 0.01) / 6.0), 1e-7);
  EXPECT_NEAR(error.relmse, (0.25 / (0.25 + 0.01) + 0.01 / (0.01 + 0.01)) / 6.0, 1e-7);
  EXPECT_NEAR(error.mean_absolute, 0.6 / 6.0, 1e-7);
}
TEST(ImageError, DividesByTheReference) {
  const Picture bright(1, 1, Color(10.0f)), dark(1, 1, Color(0.0f));
  EXPECT_NEAR(image_error(bright, dark).relmse, 100.0 / 0.01, 1e-6);
  EXPECT_NEAR(image_error(dark, bright).relmse, 100.0 / 100.01, 1e-9);
}
TEST(ImageError, LeavesOutPixelsThatAreNotFinite) {
  Picture a(2, 2, Color(1.0f)), b(2, 2, Color(0.0f));
  a.pixels[1].y = std::numeric_limits<float>::quiet_NaN();
  b.pixels[2].x = std::numeric_limits<float>::infinity();
  const ImageError error = image_error(a, b);
  EXPECT_EQ(error.pixels, 2u);
  EXPECT_EQ(error.rmse, 1.0);
  EXPECT_EQ(find_non_finite(a).count, 1u);
  EXPECT_EQ(find_non_finite(a).first_x, 1);
  EXPECT_EQ(find_non_finite(b).first_x, 0);
  EXPECT_EQ(find_non_finite(b).first_y, 1);
}
TEST(ImageError, IsUndefinedIfNoPixelIsLeft) {
  const Picture a(1, 1, Color(std::numeric_limits<float>::infinity()));
  EXPECT_EQ(image_error(a, a).pixels, 0u);
  EXPECT_TRUE(std::isnan(image_error(a, a).rmse));
}

TEST(LayeredImage, FindsLayersByName) {
  const TemporaryFolder folder;
  write_channels(folder / "a.exr", 3, 2,
                 {"R", "G", "B", "direct.R", "direct.G", "direct.B", "view.deep.R", "view.deep.G",
                  "view.deep.B", "Z", "odd.R", "N.X"},
                 OIIO::TypeDesc::FLOAT);
  const LayeredImage image = read_layered_image(folder / "a.exr");
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_EQ(image.layers.size(), 3u);
  EXPECT_EQ(image.layers.at("beauty").pixels[4], Color(4.0f, 4.125f, 4.25f));
  EXPECT_EQ(image.layers.at("direct").pixels[0], Color(0.375f, 0.5f, 0.625f));
  EXPECT_EQ(image.layers.at("view.deep").pixels[5].x, 5.75f);
}
TEST(LayeredImage, RefusesWhatHoldsNoRadiance) {
  const TemporaryFolder folder;
  const auto place = [&](const char* name) { return (folder / name).string(); };
  write_channels(folder / "a.png", 2, 2, {"R", "G", "B"}, OIIO::TypeDesc::UINT8);
  EXPECT_EQ(refusal(folder / "a.png"),
            place("a.png") + ": holds displayed values, not radiance; give an OpenEXR picture");
  write_channels(folder / "z.exr", 2, 2, {"Z"}, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(
      refusal(folder / "z.exr"),
      place("z.exr") + ": holds no layer with channels R, G and B; give a picture of a render");
  EXPECT_EQ(refusal(folder / "none.exr"), place("none.exr") + ": no such file");
  EXPECT_EQ(refusal(folder.path()), folder.path().string() + ": is not a file");
}
