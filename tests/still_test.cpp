#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <half.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "temporary_folder.h"
#include "viewer/errors.h"
#include "viewer/exr_layers.h"
#include "viewer/still_writer.h"

using namespace lumivec;
namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t all_terms = (1u << term_count) - 1;

// Values over many orders of magnitude, so that rounding shows.
Framebuffer random_framebuffer(int width, int height) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> exponent(-6.0f, 8.0f);
  Framebuffer f;
  f.width = width;
  f.height = height;
  const std::size_t count = f.pixel_count();
  const auto color = [&] {
    return Color(std::exp2(exponent(random)), std::exp2(exponent(random)),
                 std::exp2(exponent(random)));
  };
  for (std::vector<Color>& term : f.terms) {
    for (std::size_t i = 0; i < count; ++i) term.push_back(color());
  }
  for (std::size_t i = 0; i < count; ++i) {
    f.albedo.push_back(color() / 512.0f);
    f.normal.emplace_back(0.6f, 0.0f, -0.8f);
    f.position.emplace_back(float(i) + 0.1f, -1e5f, 1e-5f);
    f.depth.push_back(i == 0 ? std::numeric_limits<float>::infinity() : float(i) * 1.1f);
    f.object.push_back(std::int32_t(i) - 1);
    f.samples.push_back(4);
  }
  return f;
}

// All channels of a file as floats, by name.
std::map<std::string, std::vector<float>> read_channels(const fs::path& file,
                                                        OIIO::ImageSpec* spec_out = nullptr) {
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) throw std::runtime_error(OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  std::vector<float> values(std::size_t(spec.width) * std::size_t(spec.height) *
                            std::size_t(spec.nchannels));
  input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data());
  std::map<std::string, std::vector<float>> channels;
  for (std::size_t i = 0; i < values.size(); ++i) {
    channels[spec.channelnames[i % std::size_t(spec.nchannels)]].push_back(values[i]);
  }
  if (spec_out) *spec_out = spec;
  return channels;
}

OIIO::TypeDesc channel_type(const OIIO::ImageSpec& spec, const std::string& name) {
  return spec.channelformat(spec.channelindex(name));
}

StillHeader header() {
  return {"room.gltf", "render room.gltf -o a.exr", 64.0, 1.5};
}

constexpr const char* suffixes[3] = {".R", ".G", ".B"};

void expect_layers_sum_to_beauty(const fs::path& file, bool is_half) {
  const auto channels = read_channels(file);
  for (int c = 0; c < 3; ++c) {
    const std::vector<float>& beauty = channels.at(suffixes[c] + 1);
    for (std::size_t i = 0; i < beauty.size(); ++i) {
      double sum = 0.0;
      for (const std::string_view term : term_names) {
        sum += double(channels.at(std::string(term) + suffixes[c])[i]);
      }
      EXPECT_EQ(beauty[i], is_half ? float(half(float(sum))) : float(sum)) << i;
    }
  }
}

}  // namespace

TEST(Exr, HoldsEveryLayerInFloat) {
  const TemporaryFolder folder;
  const Framebuffer f = random_framebuffer(33, 70);
  EXPECT_EQ(write_exr(folder / "a.exr", f, {all_terms, ExrPrecision::single}, header()), 0u);
  const auto channels = read_channels(folder / "a.exr");
  EXPECT_EQ(channels.size(), 3u + 15u + 3u + 3u + 3u + 2u);
  for (std::size_t i = 0; i < f.pixel_count(); ++i) {
    for (int c = 0; c < 3; ++c) {
      for (std::size_t t = 0; t < term_names.size(); ++t) {
        EXPECT_EQ(channels.at(std::string(term_names[t]) + suffixes[c])[i], f.terms[t][i][c]);
      }
      EXPECT_EQ(channels.at(std::string("albedo") + suffixes[c])[i], f.albedo[i][c]);
    }
    EXPECT_EQ(channels.at("N.Z")[i], f.normal[i].z);
    EXPECT_EQ(channels.at("P.X")[i], f.position[i].x);
    EXPECT_EQ(channels.at("Z")[i], f.depth[i]);
    EXPECT_EQ(channels.at("id")[i], float(i));
  }
  expect_layers_sum_to_beauty(folder / "a.exr", false);
}

TEST(Exr, HoldsColorsInHalfAndGeometryInFloat) {
  const TemporaryFolder folder;
  const Framebuffer f = random_framebuffer(17, 19);
  write_exr(folder / "a.exr", f, {all_terms, ExrPrecision::half}, header());
  OIIO::ImageSpec spec;
  const auto channels = read_channels(folder / "a.exr", &spec);
  for (const char* name : {"R", "caustic.B", "albedo.G", "N.X"}) {
    EXPECT_EQ(channel_type(spec, name), OIIO::TypeDesc::HALF) << name;
  }
  for (const char* name : {"P.X", "Z", "id"}) {
    EXPECT_EQ(channel_type(spec, name), OIIO::TypeDesc::FLOAT) << name;
  }
  for (std::size_t i = 0; i < f.pixel_count(); ++i) {
    EXPECT_EQ(channels.at("direct.G")[i], float(half(f.terms[2][i].y)));
    EXPECT_EQ(channels.at("P.Y")[i], f.position[i].y);
  }
  expect_layers_sum_to_beauty(folder / "a.exr", true);
}

TEST(Exr, LeavesOutTermsThatWereNotComputed) {
  const TemporaryFolder folder;
  const Framebuffer f = random_framebuffer(4, 4);
  write_exr(folder / "a.exr", f, {0b00100u, ExrPrecision::single}, header());
  const auto channels = read_channels(folder / "a.exr");
  EXPECT_TRUE(channels.contains("direct.R"));
  EXPECT_FALSE(channels.contains("indirect.R"));
  EXPECT_EQ(channels.at("R"), channels.at("direct.R"));
}

TEST(Exr, ClampsToHalfAndCountsPixels) {
  const TemporaryFolder folder;
  Framebuffer f = random_framebuffer(4, 4);
  f.terms[0][3] = Color(1e6f, 1.0f, 1e6f);
  f.terms[0][5] = f.terms[2][5] = Color(40000.0f, 0.0f, 0.0f);  // each fits, the sum does not
  EXPECT_EQ(write_exr(folder / "a.exr", f, {all_terms, ExrPrecision::half}, header()), 2u);
  const auto channels = read_channels(folder / "a.exr");
  EXPECT_EQ(channels.at("emitted.R")[3], 65504.0f);
  EXPECT_EQ(channels.at("R")[3], 65504.0f);
  EXPECT_EQ(channels.at("R")[5], 65504.0f);
  EXPECT_EQ(write_exr(folder / "a.exr", f, {all_terms, ExrPrecision::single}, header()), 0u);
  EXPECT_EQ(read_channels(folder / "a.exr").at("emitted.R")[3], 1e6f);
}

TEST(Exr, SaysHowItWasMade) {
  const TemporaryFolder folder;
  write_exr(folder / "a.exr", random_framebuffer(4, 4), {all_terms, ExrPrecision::half}, header());
  OIIO::ImageSpec spec;
  read_channels(folder / "a.exr", &spec);
  EXPECT_EQ(spec.get_string_attribute("Software").substr(0, 8), "lumivec ");
  EXPECT_EQ(spec.get_string_attribute("lumivec:scene"), "room.gltf");
  EXPECT_EQ(spec.get_string_attribute("lumivec:settings"), "render room.gltf -o a.exr");
  EXPECT_EQ(spec.get_float_attribute("lumivec:samples"), 64.0f);
  EXPECT_EQ(spec.get_float_attribute("lumivec:seconds"), 1.5f);
  float primaries[8] = {};
  EXPECT_TRUE(spec.getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                                static_cast<void*>(primaries)));
  EXPECT_EQ(primaries[0], 0.64f);
  EXPECT_EQ(primaries[7], 0.3290f);
}

TEST(Exr, AFailedWriteKeepsTheOldFile) {
  const TemporaryFolder folder;
  const Framebuffer f = random_framebuffer(4, 4);
  write_exr(folder / "a.exr", f, {all_terms, ExrPrecision::half}, header());
  const auto size = fs::file_size(folder / "a.exr");
  Framebuffer empty;  // a picture of no pixels cannot be written
  EXPECT_THROW(write_exr(folder / "a.exr", empty, {all_terms, ExrPrecision::half}, header()),
               CommandError);
  EXPECT_EQ(fs::file_size(folder / "a.exr"), size);
  EXPECT_EQ(folder.files(), 1u);
}

TEST(Png, RoundsToNearestAndClamps) {
  const TemporaryFolder folder;
  Picture picture(4, 1);
  picture.pixels = {Color(-0.2f, 0.0f, 1.0f), Color(1.7f, 0.499f / 255.0f, 0.501f / 255.0f),
                    Color(0.5f), Color(std::numeric_limits<float>::quiet_NaN())};
  write_displayed(folder / "a.png", picture, {}, header());
  OIIO::ImageSpec spec;
  const auto channels = read_channels(folder / "a.png", &spec);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::UINT8);
  EXPECT_EQ(spec.nchannels, 3);
  EXPECT_EQ(spec.get_string_attribute("oiio:ColorSpace"), "sRGB");
  const auto byte = [&](const char* name, std::size_t i) {
    return int(std::lround(channels.at(name)[i] * 255.0f));
  };
  EXPECT_EQ(byte("R", 0), 0);
  EXPECT_EQ(byte("B", 0), 255);
  EXPECT_EQ(byte("R", 1), 255);
  EXPECT_EQ(byte("G", 1), 0);
  EXPECT_EQ(byte("B", 1), 1);
  EXPECT_EQ(byte("R", 2), 128);
  EXPECT_EQ(byte("R", 3), 0);
}
TEST(Png, HasSixteenBitsIfAsked) {
  const TemporaryFolder folder;
  write_displayed(folder / "a.png", Picture(2, 2, Color(1.0f / 65535.0f)), {16, true}, header());
  OIIO::ImageSpec spec;
  const auto channels = read_channels(folder / "a.png", &spec);
  EXPECT_EQ(spec.format, OIIO::TypeDesc::UINT16);
  EXPECT_NEAR(channels.at("R")[0] * 65535.0f, 1.0f, 1e-3f);
}
TEST(Jpeg, KeepsTheRowsInOrder) {
  const TemporaryFolder folder;
  Picture picture(16, 100);
  for (int y = 0; y < 50; ++y) {
    for (int x = 0; x < 16; ++x) picture.pixels[std::size_t(y * 16 + x)] = Color(1.0f);
  }
  write_displayed(folder / "a.jpg", picture, {}, header());
  const auto channels = read_channels(folder / "a.jpg");
  EXPECT_GT(channels.at("R").front(), 0.95f);
  EXPECT_LT(channels.at("R").back(), 0.05f);
}

TEST(StillFormat, FollowsTheExtension) {
  EXPECT_EQ(still_format("a.exr"), StillFormat::exr);
  EXPECT_EQ(still_format("a.PNG"), StillFormat::png);
  EXPECT_EQ(still_format("b/a.jpeg"), StillFormat::jpeg);
  EXPECT_THROW(still_format("a.tif"), UsageError);
  EXPECT_THROW(still_format("exr"), UsageError);
}
