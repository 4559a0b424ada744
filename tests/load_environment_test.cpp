// Environment pictures through OpenImageIO.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "loader/error.h"
#include "loader/load_scene.h"
#include "tests/png_bytes.h"
#include "tests/temporary_folder.h"

namespace {

using lumivec::load_environment;
using lumivec::Scene;

std::filesystem::path write_exr(const TemporaryFolder& folder, const std::vector<float>& pixels,
                                const std::vector<std::string>& channels) {
  const auto width = static_cast<int>(pixels.size() / channels.size());
  OIIO::ImageSpec spec(width, 1, static_cast<int>(channels.size()), OIIO::TypeFloat);
  spec.channelnames = channels;
  const std::filesystem::path file = folder / "sky.exr";
  auto output = OIIO::ImageOutput::create(file.string());
  EXPECT_TRUE(output && output->open(file.string(), spec));
  EXPECT_TRUE(output->write_image(OIIO::TypeFloat, pixels.data()));
  output->close();
  return file;
}

TEST(LoadEnvironment, FloatsAreRadiance) {
  TemporaryFolder folder;
  Scene scene;
  load_environment(write_exr(folder, {1, 2, 1000, 0, 0.5f, 0}, {"R", "G", "B"}), 2.0f, 0.25f,
                   scene);
  ASSERT_EQ(scene.environment.image, 0);
  EXPECT_EQ(scene.images[0].rgba32f, (std::vector<float>{1, 2, 1000, 1, 0, 0.5f, 0, 1}));
  EXPECT_EQ(scene.environment.radiance, lumivec::Color(2));
  EXPECT_EQ(scene.environment.rotation, 0.25f);
}

TEST(LoadEnvironment, ChannelsAreFoundByName) {
  TemporaryFolder folder;
  Scene scene;
  load_environment(write_exr(folder, {9, 3, 2, 1}, {"Z", "B", "G", "R"}), 1.0f, 0.0f, scene);
  EXPECT_EQ(scene.images[0].rgba32f, (std::vector<float>{1, 2, 3, 1}));
}

TEST(LoadEnvironment, UselessRadianceIsCleaned) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  TemporaryFolder folder;
  Scene scene;
  load_environment(write_exr(folder, {std::nanf(""), -1, inf}, {"R", "G", "B"}), 1.0f, 0.0f, scene);
  const auto& pixels = scene.images[0].rgba32f;
  EXPECT_EQ(pixels[0], 0.0f);
  EXPECT_EQ(pixels[1], 0.0f);
  EXPECT_TRUE(std::isfinite(pixels[2]));
  EXPECT_GT(pixels[2], 1e4f);
}

TEST(LoadEnvironment, BytesAreDecodedFromSrgb) {
  TemporaryFolder folder;
  std::ofstream(folder / "sky.png", std::ios::binary) << PngBytes(2, 1, 8, 0, {{128, 255}}).file;
  Scene scene;
  load_environment(folder / "sky.png", 1.0f, 0.0f, scene);
  EXPECT_NEAR(scene.images[0].rgba32f[0], 0.2158605f, 1e-5f);
  EXPECT_EQ(scene.images[0].rgba32f[5], 1.0f);
}

TEST(LoadEnvironment, ReplacesThePreviousOne) {
  TemporaryFolder folder;
  Scene scene;
  const auto file = write_exr(folder, {1, 2, 3}, {"R", "G", "B"});
  load_environment(file, 1.0f, 0.0f, scene);
  load_environment(file, 1.0f, 0.0f, scene);
  EXPECT_EQ(scene.images.size(), 1u);
}

TEST(LoadEnvironment, TheBuiltInSkyIsGreyAndBrightestFromTheKey) {
  Scene scene;
  scene.images.resize(1);
  lumivec::set_built_in_sky(2.0f, 0.25f, scene);
  ASSERT_EQ(scene.environment.image, 1);
  const lumivec::Image& sky = scene.images[1];
  ASSERT_EQ(sky.rgba32f.size(), std::size_t{4} * sky.width * sky.height);
  const auto at = [&](int x, int y) { return sky.rgba32f[std::size_t(4 * (y * sky.width + x))]; };
  double sum = 0.0, area = 0.0;
  std::pair<int, int> brightest;
  for (int y = 0; y < sky.height; ++y) {
    const double sine = std::sin(3.14159265 * (y + 0.5) / sky.height);
    for (int x = 0; x < sky.width; ++x) {
      const float* p = &sky.rgba32f[std::size_t(4 * (y * sky.width + x))];
      EXPECT_TRUE(p[0] > 0.0f && p[0] == p[1] && p[1] == p[2]);
      if (p[0] > at(brightest.first, brightest.second)) brightest = {x, y};
      sum += sine * p[0];
      area += sine;
    }
  }
  EXPECT_NEAR(sum / area, 0.8, 0.3);
  // Upper left front: u < 1/2 is left of -Z, and the front is at the map's outer quarters.
  EXPECT_LT(brightest.first, sky.width / 4);
  EXPECT_LT(brightest.second, sky.height / 2);
  EXPECT_EQ(scene.environment.radiance, lumivec::Color(2));
  EXPECT_EQ(scene.environment.rotation, 0.25f);
}

TEST(LoadEnvironment, ErrorsNameTheFile) {
  TemporaryFolder folder;
  std::ofstream(folder / "bad.exr") << "no picture";
  Scene scene;
  for (const char* name : {"none.hdr", "bad.exr"}) {
    try {
      load_environment(folder / name, 1.0f, 0.0f, scene);
      ADD_FAILURE() << name;
    } catch (const lumivec::SceneError& e) {
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos);
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_THROW(load_environment(folder / "bad.exr", -1.0f, 0.0f, scene), lumivec::SceneError);
}

}  // namespace
