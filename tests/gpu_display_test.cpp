// What the graphics card shows is what DisplayTransform writes. Runs under Xvfb, without it on the
// display there is, and is skipped without one.
#include "viewer/window/gpu_display.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <string>

#include "temporary_folder.h"
#include "viewer/errors.h"
#include "viewer/exposure.h"
#include "viewer/window/false_color.h"
#include "viewer/window/gl_window.h"
#include "viewer/window/picture_canvas.h"
#include "virtual_display.h"

namespace lumivec {
namespace {

constexpr float step = 1.0f / 255.0f;
const std::string xvfb = LUMIVEC_XVFB;

class GpuDisplayTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (xvfb.empty()) return;
    screen_ = std::make_unique<VirtualDisplay>(xvfb, "640x480");
    setenv("DISPLAY", screen_->name().c_str(), 1);
  }
  static void TearDownTestSuite() { screen_.reset(); }

  void SetUp() override {
    try {
      window_ = std::make_unique<GlWindow>(64, 64, "test", false);
    } catch (const CommandError& error) {
      GTEST_SKIP() << error.what();
    }
  }

  // Greys and colours from far below black to far above white, and what is not finite.
  static Picture values() {
    Picture picture(67, 45);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> stops(-14.0f, 8.0f), share(-0.05f, 1.0f);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      const float level = 0.18f * std::exp2(stops(random));
      picture.pixels[i] =
          i % 3 == 0 ? Color(level) : Color(share(random), share(random), share(random)) * level;
    }
    picture.pixels[0] = Color(0.0f);
    picture.pixels[1] = Color(std::numeric_limits<float>::quiet_NaN(), 0.3f, 0.2f);
    picture.pixels[2] = Color(0.3f, std::numeric_limits<float>::infinity(), 0.2f);
    picture.pixels[3] = Color(1e30f);
    return picture;
  }

  static Picture drawn(GpuDisplay& display, const Picture& picture, const DisplayLook& look,
                       GLenum format, int times = 1) {
    const Viewport viewport = {0, 0, picture.width * times, picture.height * times};
    const GlCanvas canvas(viewport.width, viewport.height, format);
    canvas.bind();
    display.upload(0, picture.pixels.data(), picture.width, picture.height);
    display.draw(viewport, look);
    return read_back(viewport);
  }

  static void expect_as_files(const DisplayOptions& options, double exposure) {
    SCOPED_TRACE(options.display + ", " + options.view + " " + options.look);
    const Picture picture = values();
    Picture expected = picture;
    DisplayTransform(options).apply(expected, exposure);
    GpuDisplay display(options);
    DisplayLook look;
    look.exposure = exposure;
    const Picture exact = drawn(display, picture, look, GL_RGBA32F);
    const Picture shown = drawn(display, picture, look, GL_RGBA8);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      for (int c = 0; c < 3; ++c) {
        const float e = expected.pixels[i][c];
        ASSERT_NEAR(exact.pixels[i][c], e, 1e-3f * std::max(1.0f, std::abs(e)))
            << "pixel " << i << ", channel " << c << " of " << picture.pixels[i];
        ASSERT_NEAR(shown.pixels[i][c], std::round(std::clamp(e, 0.0f, 1.0f) * 255.0f) * step,
                    1.001f * step)
            << "pixel " << i << ", channel " << c << " of " << picture.pixels[i];
      }
    }
    EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
  }

  static inline std::unique_ptr<VirtualDisplay> screen_;
  std::unique_ptr<GlWindow> window_;
};

TEST_F(GpuDisplayTest, ShowsWhatFilesHold) {
  for (const char* display : {"sRGB", "Display P3", "Rec.1886 Rec.709"}) {
    for (const char* view : {"ACES 1.0 SDR-video", "Un-tone-mapped", "Raw"}) {
      for (const double exposure : {0.0, -1.75, 3.0})
        expect_as_files({"builtin", display, view, ""}, exposure);
    }
  }
}

// A configuration with a look and with tables of one and three dimensions.
TEST_F(GpuDisplayTest, ShowsLooksAndTables) {
  const TemporaryFolder folder;
  {
    std::ofstream cube(folder / "turn.cube");
    cube << "LUT_3D_SIZE 3\n";
    for (int b = 0; b < 3; ++b) {
      for (int g = 0; g < 3; ++g) {
        for (int r = 0; r < 3; ++r)
          cube << 0.5 * g << ' ' << 0.4 * b + 0.1 * r << ' ' << 0.5 * r << '\n';
      }
    }
    std::ofstream curve(folder / "curve.spi1d");
    curve << "Version 1\nFrom 0 1\nLength 33\nComponents 1\n{\n";
    for (int i = 0; i < 33; ++i) curve << std::sqrt(i / 32.0) << '\n';
    curve << "}\n";
  }
  std::ofstream(folder / "looks.ocio") << R"(ocio_profile_version: 2
search_path: .
roles:
  default: lin_rec709
  scene_linear: lin_rec709
displays:
  Screen:
    - !<View> {name: Plain, colorspace: curve}
    - !<View> {name: Looked, colorspace: curve, looks: turn}
looks:
  - !<Look> {name: turn, process_space: lin_rec709, transform: !<FileTransform> {src: turn.cube, interpolation: linear}}
colorspaces:
  - !<ColorSpace>
    name: lin_rec709
  - !<ColorSpace>
    name: curve
    from_scene_reference: !<FileTransform> {src: curve.spi1d, interpolation: linear}
)";
  const std::string config = (folder / "looks.ocio").string();
  expect_as_files({config, "Screen", "Plain", ""}, 0.0);
  expect_as_files({config, "Screen", "Looked", ""}, 0.0);
  expect_as_files({config, "Screen", "Plain", "turn"}, 0.0);
  Picture a(1, 1, Color(0.4f, 0.2f, 0.1f)), b = a, c = a;
  DisplayTransform({config, "Screen", "Looked", ""}).apply(a, 0.0);
  DisplayTransform({config, "Screen", "Plain", "turn"}).apply(b, 0.0);
  DisplayTransform({config, "Screen", "Plain", ""}).apply(c, 0.0);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a.pixels[0][i], b.pixels[0][i], 1e-5f);
  EXPECT_GT((a.pixels[0] - c.pixels[0]).length(), 0.1f);
  EXPECT_THROW(GpuDisplay({config, "Screen", "Plain", "tern"}), UsageError);
}

// An upload has its first row at the top, and each pixel is a square of the screen's.
TEST_F(GpuDisplayTest, KeepsPixelsWhereTheyAre) {
  GpuDisplay display({"builtin", "sRGB", "Raw", ""});
  Picture picture(3, 2, Color(0.25f));
  picture.pixels[1] = Color(1.0f, 0.0f, 0.0f);
  const Picture shown = drawn(display, picture, {}, GL_RGBA32F, 4);
  for (int y = 0; y < shown.height; ++y) {
    for (int x = 0; x < shown.width; ++x) {
      const Color& from = picture.pixels[std::size_t(y / 4 * 3 + x / 4)];
      EXPECT_EQ(shown.pixels[std::size_t(y * shown.width + x)], from) << x << ", " << y;
    }
  }
}

// The canvas shows what the display would, and computes it again for changes alone.
TEST_F(GpuDisplayTest, KeepsWhatIsShown) {
  const Picture picture = values();
  GpuDisplay display({});
  DisplayLook look;
  const Picture direct = drawn(display, picture, look, GL_RGBA8);
  const Viewport where = {5, 3, picture.width, picture.height};
  const Viewport whole = {0, 0, picture.width, picture.height};
  const GlCanvas window(80, 60, GL_RGBA8);
  window.bind();
  PictureCanvas canvas;
  const auto shown = [&](const Viewport& place) {
    glViewport(0, 0, 80, 60);
    glClearColor(1.0f, 0.0f, 1.0f, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    canvas.draw(display, where, place, look, Color(0.0f));
    return read_back(where);
  };
  EXPECT_EQ(shown(whole).pixels, direct.pixels);
  EXPECT_EQ(shown(whole).pixels, direct.pixels);
  EXPECT_EQ(canvas.computed(), 1u);
  display.upload(0, picture.pixels.data(), picture.width, picture.height);
  shown(whole);
  EXPECT_EQ(canvas.computed(), 2u);
  look.exposure = 1.0;
  EXPECT_NE(shown(whole).pixels, direct.pixels);
  EXPECT_EQ(canvas.computed(), 3u);
  // Moved to the right: background, then the picture from its left edge on.
  look.exposure = 0.0;
  const Picture moved = shown({20, 0, picture.width, picture.height});
  for (int y = 0; y < picture.height; ++y) {
    const auto row = std::size_t(y * picture.width);
    EXPECT_EQ(moved.pixels[row + 19], Color(0.0f));
    EXPECT_EQ(moved.pixels[row + 20], direct.pixels[row]);
  }
  EXPECT_EQ(canvas.computed(), 4u);
  EXPECT_EQ(glGetError(), GLenum(GL_NO_ERROR));
}

// What a camera of the same vertical angle sees stays where it is while a window's shape changes.
TEST(PlaceInRoom, KeepsTheScaleOfAnotherShape) {
  EXPECT_EQ(place_in_room(640, 480, 640, 480, 1.0), (Viewport{0, 0, 640, 480}));
  EXPECT_EQ(place_in_room(213, 160, 640, 480, 4.0), (Viewport{0, 0, 640, 480}));
  EXPECT_EQ(place_in_room(640, 480, 800, 480, 4.0), (Viewport{80, 0, 640, 480}));
  EXPECT_EQ(place_in_room(640, 480, 400, 480, 4.0), (Viewport{-120, 0, 640, 480}));
  EXPECT_EQ(place_in_room(640, 480, 640, 960, 4.0), (Viewport{-320, 0, 1280, 960}));
}

TEST_F(GpuDisplayTest, WipesBetweenTwoPictures) {
  GpuDisplay display({"builtin", "sRGB", "Raw", ""});
  const Picture picture(8, 4, Color(0.25f)), second(8, 4, Color(0.75f));
  display.upload(1, second.pixels.data(), 8, 4);
  DisplayLook look;
  look.wipe = 0.5f;
  const Picture shown = drawn(display, picture, look, GL_RGBA32F);
  for (int x = 0; x < 8; ++x) EXPECT_EQ(shown.pixels[std::size_t(x)].x, x < 4 ? 0.75f : 0.25f) << x;
}

TEST_F(GpuDisplayTest, ShowsChannels) {
  GpuDisplay display({"builtin", "sRGB", "Raw", ""});
  const Color c(0.5f, 0.25f, 0.125f);
  const Picture picture(2, 2, c);
  DisplayLook look;
  for (const auto& [channel, expected] :
       {std::pair{Channel::red, c.x}, std::pair{Channel::green, c.y}, std::pair{Channel::blue, c.z},
        std::pair{Channel::luminance, luminance(c)}}) {
    look.channel = channel;
    EXPECT_NEAR(drawn(display, picture, look, GL_RGBA32F).pixels[0].x, expected, 1e-6f);
  }
}

TEST_F(GpuDisplayTest, ShowsFalseColors) {
  GpuDisplay display({"builtin", "sRGB", "Raw", ""});
  Picture picture(23, 1);
  for (int i = 0; i < 23; ++i)
    picture.pixels[std::size_t(i)] = Color(0.18f * std::exp2(0.7f * float(i - 11)));
  picture.pixels[0] = Color(0.0f);
  DisplayLook look;
  look.mode = DisplayMode::false_color;
  look.exposure = 1.0;
  const Picture shown = drawn(display, picture, look, GL_RGBA32F);
  for (std::size_t i = 0; i < 23; ++i) {
    const Color expected = false_color(picture.pixels[i] * 2.0f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown.pixels[i][c], expected[c], 1e-5f) << i;
  }
  EXPECT_EQ(false_color(Color(middle_gray)), false_color_bands()[5].color);
}

TEST_F(GpuDisplayTest, ShowsWhatIsNoNumber) {
  GpuDisplay display({"builtin", "sRGB", "ACES 1.0 SDR-video", ""});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  Picture picture(4, 1, Color(0.5f));
  picture.pixels[0] = Color(0.1f, nan, 0.1f);
  picture.pixels[1] = Color(0.1f, 0.1f, infinity);
  picture.pixels[2] = Color(-0.1f, 0.1f, 0.1f);
  DisplayLook look;
  look.mode = DisplayMode::nan_map;
  const Picture shown = drawn(display, picture, look, GL_RGBA32F);
  EXPECT_EQ(shown.pixels[0], Color(1.0f, 0.0f, 1.0f));
  EXPECT_EQ(shown.pixels[1], Color(1.0f, 1.0f, 0.0f));
  EXPECT_EQ(shown.pixels[2], Color(0.0f, 1.0f, 1.0f));
  EXPECT_LT(shown.pixels[3].x, 0.35f);
}

TEST_F(GpuDisplayTest, KeepsItsViewIfAnotherCannotBeHad) {
  GpuDisplay display({"builtin", "sRGB", "Raw", ""});
  EXPECT_THROW(display.set_transform({"builtin", "sRGB", "No such", ""}), UsageError);
  EXPECT_EQ(display.names().chosen.view, "Raw");
  EXPECT_EQ(drawn(display, Picture(2, 2, Color(0.5f)), {}, GL_RGBA32F).pixels[0].x, 0.5f);
}

}  // namespace
}  // namespace lumivec
