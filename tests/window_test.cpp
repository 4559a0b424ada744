// The window as a user meets it: events are replayed against the real one, under Xvfb, and what it
// shows and says is looked at. Skipped where there is neither Xvfb nor a display.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "command_runner.h"
#include "temporary_folder.h"
#include "viewer/window/key_table.h"
#include "virtual_display.h"
#ifdef LUMIVEC_X11
#include "window_manager.h"
#endif

namespace lumivec {
namespace {

namespace fs = std::filesystem;

const fs::path scenes = fs::path(LUMIVEC_SOURCE_DIR) / "scenes";
const std::string xvfb = LUMIVEC_XVFB;

bool has_display() {
  return !xvfb.empty() || std::getenv("DISPLAY") != nullptr;
}

class WindowTest : public testing::Test {
 protected:
  WindowTest() {
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
  }
  void SetUp() override {
    if (!has_display()) GTEST_SKIP() << "there is neither Xvfb nor a display";
  }

  // A display of its own for each run, unless one is there already (show_display).
  CommandResult view(const std::vector<std::string>& arguments,
                     const std::string& screen = "1280x1024") const {
    std::optional<VirtualDisplay> display;
    if (!xvfb.empty() && !display_) {
      display.emplace(xvfb, screen);
      setenv("DISPLAY", display->name().c_str(), 1);
    }
    std::vector<std::string> words = {"view"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_command(LUMIVEC_PROGRAM, words, folder_.path());
  }

  // Replays script in a window with these options; it has to end well.
  void replay_bare(const std::string& script, std::vector<std::string> options,
                   const std::string& screen = "1280x1024") {
    std::ofstream(folder_ / "script.txt") << script << "\nquit\n";
    for (const char* word : {"--script", "script.txt"}) options.emplace_back(word);
    const CommandResult result = view(options, screen);
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.status, 0);
  }

  // In a small window on the Cornell box, if nothing else is said.
  void replay(const std::string& script, std::vector<std::string> options = {},
              const std::string& screen = "1280x1024") {
    if (options.empty() || options[0].starts_with("--"))
      options.insert(options.begin(), (scenes / "cornell_box_1.gltf").string());
    if (std::find(options.begin(), options.end(), "--size") == options.end())
      options.insert(options.end(), {"--size", "480x360"});
    replay_bare(script, options, screen);
  }

  // One for all runs of this test. False: there is none of our own.
  bool show_display() {
    if (xvfb.empty()) return false;
    display_.emplace(xvfb, "1280x1024");
    setenv("DISPLAY", display_->name().c_str(), 1);
    return true;
  }
  std::string display_name() const { return display_->name(); }

  nlohmann::json state(const std::string& file) const {
    std::ifstream in(folder_ / file);
    const nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
    if (json.is_discarded()) throw std::runtime_error("there is no " + file);
    return json;
  }

  struct Shot {
    int width = 0, height = 0;
    std::vector<unsigned char> rgb;
    std::string settings, software;
    std::array<int, 3> pixel(int x, int y) const {
      const std::size_t i = std::size_t((y * width + x) * 3);
      return {rgb[i], rgb[i + 1], rgb[i + 2]};
    }
    // Mean of the pixels around a place.
    std::array<double, 3> around(int x, int y) const {
      constexpr int reach = 4;
      std::array<double, 3> mean{};
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          for (std::size_t c = 0; c < 3; ++c)
            mean[c] += pixel(x + dx, y + dy)[c] / double((2 * reach + 1) * (2 * reach + 1));
        }
      }
      return mean;
    }
    // Share of the pixels of a part, from its upper left corner, that differ visibly.
    double differs(const Shot& other, int left, int top, int right, int bottom) const {
      int count = 0;
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
          int most = 0;
          for (std::size_t c = 0; c < 3; ++c)
            most = std::max(most, std::abs(pixel(x, y)[c] - other.pixel(x, y)[c]));
          constexpr int visible = 24;  // steps of 255; the noise of the first samples is below
          count += most > visible ? 1 : 0;
        }
      }
      return double(count) / double((right - left) * (bottom - top));
    }
    // Mean over the left part that shows the picture.
    double brightness(double share) const {
      double sum = 0.0, count = 0.0;
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < int(share * width); ++x, count += 3.0) {
          for (int c = 0; c < 3; ++c) sum += rgb[std::size_t((y * width + x) * 3 + c)];
        }
      }
      return sum / count;
    }
  };
  Shot shot(const std::string& file) const {
    Shot result;
    const auto in = OIIO::ImageInput::open((folder_ / file).string());
    if (!in) throw std::runtime_error("there is no " + file);
    result.width = in->spec().width;
    result.height = in->spec().height;
    result.settings = in->spec().get_string_attribute("lumivec:settings");
    result.software = in->spec().get_string_attribute("Software");
    result.rgb.resize(std::size_t(result.width * result.height * 3));
    in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, result.rgb.data());
    return result;
  }

  TemporaryFolder folder_;
  std::optional<VirtualDisplay> display_;
};

// Places in a picture of the Cornell box, in a window of 480 by 360 with the panel.
constexpr int lamp_x = 131, lamp_y = 87, wall_y = 160, red_x = 10, green_x = 252;

TEST_F(WindowTest, ShowsAScene) {
  replay("until samples 1\nshot all.png\nstate state.json");
  const nlohmann::json s = state("state.json");
  EXPECT_EQ(s["error"], false);
  EXPECT_EQ(s["window"], nlohmann::json({480, 360}));
  EXPECT_EQ(s["terms"], "emitted,specular,direct,indirect,caustic");
  const Shot all = shot("all.png");
  EXPECT_EQ(all.width, 480);
  const auto red = all.around(red_x, wall_y), green = all.around(green_x, wall_y);
  EXPECT_GT(red[0], 3.0 * red[1]);
  EXPECT_GT(green[1], 2.0 * green[0]);
  for (const double level : all.around(lamp_x, lamp_y)) EXPECT_NEAR(level, 255.0, 1e-6);
}

TEST_F(WindowTest, DisplaysWhatFilesWouldHold) {
  for (const char* view : {"ACES 1.0 SDR-video", "Un-tone-mapped", "Raw"}) {
    replay("until samples 1\ncheck-display\nkey +\nkey +\nkey +\nframes 2\ncheck-display",
           {"--view", view});
  }
}

// Every row of the key table is pressed once, and then once more.
TEST_F(WindowTest, TakesEveryKey) {
  std::string script = "until loaded\n";
  const auto name = [](int code) -> std::string {
    switch (code) {
      case GLFW_KEY_SPACE:
        return "Space";
      case GLFW_KEY_TAB:
        return "Tab";
      case GLFW_KEY_ESCAPE:
        return "Esc";
      case GLFW_KEY_HOME:
        return "Home";
      case GLFW_KEY_EQUAL:
        return "+";
      default:
        if (code >= GLFW_KEY_F1 && code <= GLFW_KEY_F25)
          return "F" + std::to_string(code - GLFW_KEY_F1 + 1);
        return code < 128 ? std::string(1, char(code)) : "";
    }
  };
  int pressed = 0;
  for (int round = 0; round < 2; ++round) {
    for (const KeyRow& row : key_table()) {
      if (row.action == Action::quit || row.action == Action::export_still) continue;
      for (const int code : row.codes) {
        if (name(code).empty()) continue;
        std::string keys = name(code);
        if (row.modifiers & GLFW_MOD_SHIFT) keys = "Shift+" + keys;
        if (row.modifiers & GLFW_MOD_CONTROL) keys = "Ctrl+" + keys;
        if (row.modifiers & GLFW_MOD_ALT) keys = "Alt+" + keys;
        script += "key " + keys + "\n";
        ++pressed;
      }
    }
    script += "shot keys_" + std::to_string(round) + ".png\n";
  }
  EXPECT_GT(pressed, 100);
  script += "until idle\nstate state.json";
  replay(script);
  const nlohmann::json s = state("state.json");
  // Pressed twice, what toggles is as it was.
  EXPECT_EQ(s["help"], false);
  EXPECT_EQ(s["wipe"], false);
  EXPECT_EQ(s["panels"], true);
  EXPECT_EQ(s["keys"], 2);
  EXPECT_TRUE(fs::exists(folder_ / "cornell_box_1_0001.png")) << "F12 writes a picture";
  EXPECT_TRUE(fs::exists(folder_ / "cornell_box_1_path_0001.json"));
}

TEST_F(WindowTest, ChoosesTerms) {
  replay(
      "until samples 1\nshot all.png\nkey 3\nframes 3\nstate without.json\nkey Shift+1\n"
      "until samples 1\nstate solo.json\nshot solo.png\nkey Shift+1\nframes 2\nstate back.json\n"
      "key 0\nframes 2\nstate all.json");
  EXPECT_EQ(state("without.json")["terms"], "emitted,specular,indirect,caustic");
  EXPECT_EQ(state("solo.json")["terms"], "emitted");
  EXPECT_EQ(state("back.json")["terms"], "emitted,specular,indirect,caustic");
  EXPECT_EQ(state("all.json")["terms"], "emitted,specular,direct,indirect,caustic");
  const Shot solo = shot("solo.png");
  for (const double level : solo.around(lamp_x, lamp_y)) EXPECT_NEAR(level, 255.0, 1e-6);
  for (const double level : solo.around(red_x, wall_y)) EXPECT_EQ(level, 0.0);
  EXPECT_GT(shot("all.png").around(red_x, wall_y)[0], 20.0);
}

// A stop doubles what is displayed: of the same picture, which pausing holds.
TEST_F(WindowTest, ChangesExposure) {
  replay(
      "until samples 1\nkey P\nuntil rest\nstate a.json\nshot a.png\nkey +\nkey +\nkey -\nkey +\n"
      "key +\nkey +\nframes 2\nstate b.json\nshot b.png\nkey Shift+B\nframes 2\nstate c.json\n"
      "key B\nframes 2\nstate d.json",
      {"--view", "Un-tone-mapped"});
  EXPECT_EQ(state("a.json")["exposure"], 0.0);
  EXPECT_EQ(state("b.json")["exposure"], 1.0);
  EXPECT_EQ(state("c.json")["exposure"], 0.0);
  EXPECT_NE(state("d.json")["exposure"], 0.0);
  const Shot a = shot("a.png"), b = shot("b.png");
  const auto linear = [](int level) {
    const double v = level / 255.0;
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  int compared = 0;
  for (int y = 40; y < 320; ++y) {
    for (int x = 0; x < 260; ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double before = linear(a.pixel(x, y)[c]), after = linear(b.pixel(x, y)[c]);
        if (before < 0.05 || before > 0.45) continue;
        ++compared;
        EXPECT_NEAR(after, 2.0 * before, 0.05 * before + 0.01) << x << ", " << y;
      }
    }
  }
  EXPECT_GT(compared, 10000);
}

TEST_F(WindowTest, MovesByMouse) {
  replay(
      "until loaded\nstate start.json\ndrag left 80 100 120 120\nframes 2\nstate orbit.json\n"
      "drag middle 80 100 120 120\nframes 2\nstate pan.json\ndrag right 80 100 120 120\nframes 2\n"
      "state look.json\nwheel 2\nframes 2\nstate dolly.json\nkey Home\nframes 2\nstate home.json\n"
      "hold W\nframes 12\nlet W\nframes 2\nstate fly.json\nframes 12\nstate still.json");
  const auto eye = [&](const char* file) {
    const nlohmann::json e = state(file)["eye"];
    return std::array<double, 3>{e[0], e[1], e[2]};
  };
  EXPECT_NE(eye("orbit.json"), eye("start.json"));
  EXPECT_NE(eye("pan.json"), eye("orbit.json"));
  EXPECT_EQ(eye("look.json"), eye("pan.json"));
  EXPECT_NE(state("look.json")["camera"], state("pan.json")["camera"]);
  EXPECT_NE(eye("dolly.json"), eye("look.json"));
  EXPECT_EQ(eye("home.json"), eye("start.json"));
  EXPECT_GT(eye("fly.json")[2], eye("home.json")[2]) << "forward is +Z here";
  EXPECT_EQ(eye("fly.json"), eye("still.json")) << "nothing goes on by itself";
}

// Drivers may pass over the wish to wait for the display: frames are kept to its rate all the same.
TEST_F(WindowTest, FliesNoFasterThanTheDisplay) {
  replay("until loaded\nkey Tab\nhold W\nframes 5\nstate a.json\nframes 90\nstate b.json\nlet W",
         {"--size", "320x240", "--pixel-size", "8"});
  const nlohmann::json a = state("a.json"), b = state("b.json");
  const double rate =
      (double(b["frames"]) - double(a["frames"])) / (double(b["seconds"]) - double(a["seconds"]));
  EXPECT_LT(rate, 1.05 * double(b["display_rate"]));
}

// What is under the mouse becomes the pivot, and can be changed and changed back.
TEST_F(WindowTest, PicksByDoubleClick) {
  replay("until samples 1\ndouble 70 150\nuntil picked\nframes 2\nstate state.json");
  const nlohmann::json s = state("state.json");
  EXPECT_GE(s["picked"], 0);
  EXPECT_EQ(s["message"].get<std::string>().substr(0, 8), "Pivot on");
}

// The panel's section of lights and materials, alone, with the tall block picked.
const std::string edit_tall =
    "until samples 4\nclick 500 10\nclick 500 33\ndouble 150 300\nuntil picked\nclick 500 102\n"
    "frames 3\nuntil samples 4\nkey P\nuntil rest\nshot before.png\nstate before.json\nkey P\n";
const std::vector<std::string> edit_options = {"--size", "720x640", "--pixel-size", "4"};

TEST_F(WindowTest, ChangesTheMaterialBySliders) {
  replay(edit_tall +
             "drag left 455 150 300 150\nuntil samples 4\nshot after.png\nstate after.json\n"
             "key Ctrl+Z\nframes 2\nuntil samples 48\nshot undone.png\nstate undone.json",
         edit_options);
  const nlohmann::json after = state("after.json");
  EXPECT_EQ(state("before.json")["changed"], "");
  EXPECT_EQ(after["edits"], 1) << "a drag is one thing to undo";
  EXPECT_EQ(after["changed"].get<std::string>().substr(0, 24), "material white: base 0.1");
  // Less red in all that is white, by the panel and in the picture.
  const auto ratio = [&](const char* file) {
    const auto back = shot(file).around(260, 250);
    return back[0] / back[1];
  };
  EXPECT_LT(ratio("after.png"), 0.75 * ratio("before.png"));
  EXPECT_EQ(state("undone.json")["edits"], 0);
  EXPECT_NEAR(ratio("undone.png"), ratio("before.png"), 0.05);
}

TEST_F(WindowTest, MovesTurnsAndScalesWhatIsPicked) {
  replay(edit_tall +
             "drag left 460 311 380 311\nuntil samples 4\nshot moved.png\nstate moved.json\n"
             "drag left 527 334 617 334\nuntil samples 4\nshot turned.png\nstate turned.json\n"
             "drag left 527 357 477 357\nuntil samples 4\nshot scaled.png\nstate scaled.json\n"
             "key Ctrl+Z\nframes 2\nkey Ctrl+Z\nframes 2\nkey Ctrl+Z\nframes 2\nuntil samples 48\n"
             "shot undone.png\nstate undone.json",
         edit_options);
  const auto numbers = [&](const char* file) {
    const std::string text = state(file)["changed"];
    const std::string begin = "object tall: matrix ";
    EXPECT_EQ(text.substr(0, begin.size()), begin) << text;
    std::array<double, 12> values{};
    std::istringstream in(text.substr(std::min(begin.size(), text.size())));
    char comma = 0;
    for (double& value : values) in >> value >> comma;
    return values;
  };
  const auto moved = numbers("moved.json"), turned = numbers("turned.json"),
             scaled = numbers("scaled.json");
  EXPECT_LT(moved[9], -0.3) << "back along X";
  EXPECT_EQ(moved[0], 1.0);
  const double angle = std::atan2(-turned[2], turned[0]) * 180.0 / 3.14159265358979;
  EXPECT_GT(angle, 30.0);
  EXPECT_NEAR(turned[0] * turned[0] + turned[2] * turned[2], 1.0, 1e-9);
  EXPECT_NEAR(turned[4], 1.0, 1e-9);
  EXPECT_LT(scaled[4], 0.7);
  EXPECT_GT(scaled[4], 0.2);
  EXPECT_GT(scaled[10], 0.0) << "about the block's middle, not its foot";
  EXPECT_EQ(state("undone.json")["edits"], 0);
  // The picture follows each, and what is undone is as it was.
  const auto differs = [&](const char* a, const char* b) {
    return shot(a).differs(shot(b), 0, 60, 410, 600);
  };
  EXPECT_GT(differs("before.png", "moved.png"), 0.04);
  EXPECT_GT(differs("moved.png", "turned.png"), 0.02);
  EXPECT_GT(differs("turned.png", "scaled.png"), 0.04);
  EXPECT_LT(differs("before.png", "undone.png"), 0.02);
}

TEST_F(WindowTest, KeepsCopiesAndPastesViews) {
  replay(
      "until loaded\nkey Ctrl+3\nkey Ctrl+C\nstate a.json\nkey X\nframes 2\nstate b.json\n"
      "key Alt+3\nframes 2\nstate c.json\nkey Y\nframes 2\nkey Ctrl+V\nframes 2\nstate d.json\n"
      "key Alt+7\nframes 2\nstate e.json\nkey O\nwheel 3\nkey Ctrl+C\nframes 2\nstate f.json\nkey "
      "O\n"
      "key X\nframes 2\nkey Ctrl+V\nframes 2\nstate g.json");
  EXPECT_NE(state("b.json")["camera"], state("a.json")["camera"]);
  EXPECT_EQ(state("c.json")["eye"], state("a.json")["eye"]);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(state("d.json")["eye"][std::size_t(i)], state("a.json")["eye"][std::size_t(i)],
                1e-9);
  EXPECT_NE(state("e.json")["message"].get<std::string>().find("no view 7"), std::string::npos);
  // A parallel view too.
  const std::string flat = state("f.json")["camera"];
  EXPECT_NE(flat.find("/ymag="), std::string::npos) << flat;
  const std::string pasted = state("g.json")["camera"];
  const auto numbers = [](const std::string& text) {
    std::vector<double> all;
    for (std::size_t i = 0; i < text.size();) {
      const bool begins = std::isdigit(static_cast<unsigned char>(text[i])) != 0 || text[i] == '-';
      std::size_t length = 0;
      if (begins) all.push_back(std::stod(text.substr(i), &length));
      i += std::max(length, std::size_t{1});
    }
    return all;
  };
  const std::vector<double> wanted = numbers(flat), found = numbers(pasted);
  ASSERT_EQ(found.size(), wanted.size()) << pasted;
  // What it looks at is measured anew in the picture, in single precision.
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_NEAR(found[i], wanted[i], 1e-5 * (1.0 + std::abs(wanted[i]))) << pasted;
  // render understands both.
  for (const char* file : {"a.json", "f.json"}) {
    const std::string text = state(file)["camera"];
    const CommandResult result =
        run_command(LUMIVEC_PROGRAM,
                    {"render", (scenes / "cornell_box_1.gltf").string(), "-o", "still.png",
                     "--camera", text, "--size", "16", "--spp", "1", "-q"},
                    folder_.path());
    EXPECT_EQ(result.status, 0) << text << result.err;
  }
}

TEST_F(WindowTest, FollowsTheWindowsSize) {
  replay(
      "until loaded\nresize 700x300\nuntil size 700x300\nframes 2\nstate wide.json\n"
      "shot wide.png\nresize 640x480\nuntil size 640x480\nframes 2\nshot vga.png\n"
      "key Tab\nframes 2\nuntil loaded\nframes 2\nstate bare.json");
  EXPECT_EQ(state("wide.json")["window"], nlohmann::json({700, 300}));
  EXPECT_EQ(shot("wide.png").width, 700);
  EXPECT_EQ(shot("vga.png").height, 480);
  EXPECT_EQ(state("bare.json")["panels"], false);
  EXPECT_EQ(state("bare.json")["picture"][0], 640);
}

#ifdef LUMIVEC_X11
// Nothing is computed for a window that nobody sees, and all of it is there again afterwards.
TEST_F(WindowTest, RestsWhileMinimised) {
  if (!show_display()) GTEST_SKIP() << "there is no Xvfb";
  const WindowManager manager(display_name());
  replay(
      "until samples 1\nminimise\nuntil minimised\nframes 5\nstate a.json\nframes 20\n"
      "state b.json\nrestore\nuntil restored\nuntil samples 2\nframes 2\nstate c.json\nshot c.png");
  EXPECT_EQ(state("b.json")["frames"], state("a.json")["frames"]);
  EXPECT_GT(state("c.json")["frames"], state("b.json")["frames"]);
  EXPECT_EQ(state("c.json")["window"], nlohmann::json({480, 360}));
  EXPECT_GT(shot("c.png").around(red_x, wall_y)[0], 20.0);
}

// Text grows and shrinks while the window is open, panels with it, and is remembered.
TEST_F(WindowTest, MakesTextLarger) {
  replay(
      "resize 1200x500\nuntil loaded\nframes 2\nstate a.json\nshot a.png\nkey Ctrl++\n"
      "key Ctrl++\nkey Ctrl++\nframes 2\nuntil loaded\nstate b.json\nshot b.png\nkey Ctrl+-\n"
      "frames 3\nstate c.json");
  const double before = state("a.json")["text_size"], after = state("b.json")["text_size"];
  const double step = 1.125;
  EXPECT_NEAR(after, before * step * step * step, 0.5) << "whole dots";
  EXPECT_NEAR(state("c.json")["text_size"].get<double>(), before * step * step, 0.5);
  // The panel takes its share of the picture.
  EXPECT_LT(state("b.json")["picture"][0].get<int>(), state("a.json")["picture"][0].get<int>());
}

// On a display of twice the usual density all is twice as large, and stays so.
TEST_F(WindowTest, KeepsItsSizeOnDenseDisplays) {
  if (!show_display()) GTEST_SKIP() << "there is no Xvfb";
  const DisplayDensity density(display_name(), 192);
  replay("until loaded\nframes 2\nstate a.json\nshot a.png");
  EXPECT_EQ(state("a.json")["interface_scale"], 2.0);
  EXPECT_EQ(state("a.json")["window"], nlohmann::json({960, 720}));
  const std::string scene = (scenes / "cornell_box_1.gltf").string();
  for (const char* file : {"b.json", "c.json"}) {
    replay_bare(std::string("until loaded\nframes 2\nstate ") + file, {scene});
    EXPECT_EQ(state(file)["window"], state("a.json")["window"]) << "as it was remembered";
    EXPECT_EQ(state(file)["picture"], state("a.json")["picture"]);
  }
}
#endif

TEST_F(WindowTest, WorksAt4K) {
  replay("until loaded\nframes 2\nshot large.png\nstate state.json", {"--size", "3840x2160"},
         "3840x2160");
  EXPECT_EQ(shot("large.png").width, 3840);
  const nlohmann::json s = state("state.json");
  EXPECT_GT(s["pixel_size"], 1) << "an engine cannot follow with all of them";
  EXPECT_LT(double(s["picture"][0]) * double(s["picture"][1]), 1e6);
}

TEST_F(WindowTest, OpensWhatIsDropped) {
  std::ofstream(folder_ / "broken.gltf") << "{";
  replay("until loaded\ndrop " + (folder_ / "broken.gltf").string() +
         "\nuntil error\nframes 3\nstate broken.json\nshot broken.png\nkey Esc\ndrop " +
         (scenes / "cornell_box_2.gltf").string() + "\nuntil opened 2\nstate second.json");
  const nlohmann::json broken = state("broken.json");
  EXPECT_NE(broken["message"].get<std::string>().find("broken.gltf"), std::string::npos);
  EXPECT_EQ(fs::path(broken["scene"].get<std::string>()).filename(), "cornell_box_1.gltf");
  EXPECT_GT(shot("broken.png").around(red_x, wall_y)[0], 20.0) << "the old picture stays";
  const nlohmann::json second = state("second.json");
  EXPECT_EQ(second["error"], false);
  EXPECT_EQ(fs::path(second["scene"].get<std::string>()).filename(), "cornell_box_2.gltf");
}

// What was said without naming a scene is for those that are dropped, and each is measured.
TEST_F(WindowTest, TakesOptionsWithoutAScene) {
  const auto drop = [](const char* name, const std::string& opened) {
    return "drop " + (scenes / name).string() + "\nuntil opened " + opened + "\nframes 2\n";
  };
  replay_bare(drop("cornell_box_1.gltf", "1") + "state a.json\nkey Shift+B\nkey Home\nframes 3\n" +
                  "until loaded\nframes 2\nstate b.json\n" + drop("cornell_box_2.gltf", "2") +
                  "state c.json\nkey F12\nkey Shift+B\nkey F5\nuntil opened 3\nframes 2\n" +
                  "state d.json",
              {"--environment", "sky", "--exposure", "auto", "--size", "480x360"});
  EXPECT_NE(state("a.json")["exposure"], 0.0);
  EXPECT_EQ(state("b.json")["exposure"], 0.0) << "the camera is no reason to measure again";
  EXPECT_NE(state("c.json")["exposure"], 0.0);
  EXPECT_EQ(state("d.json")["exposure"], 0.0) << "nor is a file that is read again";
  EXPECT_NE(shot("cornell_box_2_0001.png").settings.find("--environment 'sky'"), std::string::npos);
}

TEST_F(WindowTest, ReadsAChangedFileAgain) {
  for (const char* name : {"cornell_box_1", "cornell_box_2"}) {
    for (const char* extension : {".gltf", ".bin"}) {
      fs::copy_file(scenes / (std::string(name) + extension),
                    folder_ / (std::string(name) + extension));
    }
  }
  fs::copy_file(folder_ / "cornell_box_1.gltf", folder_ / "scene.gltf");
  std::ofstream(folder_ / "broken.gltf") << "{ broken";
  replay(
      "until loaded\nkey X\nframes 2\nuntil loaded\nstate a.json\n"
      "copy cornell_box_2.gltf scene.gltf\nuntil opened 2\nstate b.json\n"
      "copy broken.gltf scene.gltf\nuntil error\nframes 3\nstate c.json\nshot c.png\n"
      "copy cornell_box_1.gltf scene.gltf\nuntil opened 3\nstate d.json\n"
      "copy cornell_box_1.bin other.bin\ncopy other.bin cornell_box_1.bin\nuntil opened 4\n"
      "state e.json",
      {(folder_ / "scene.gltf").string()});
  EXPECT_EQ(state("a.json")["opened"], 1);
  EXPECT_EQ(state("b.json")["opened"], 2);
  EXPECT_EQ(state("b.json")["camera"], state("a.json")["camera"]) << "the camera stays";
  EXPECT_EQ(state("c.json")["opened"], 2);
  EXPECT_EQ(state("c.json")["error"], true);
  EXPECT_GT(shot("c.png").brightness(0.5), 10.0) << "the old picture stays";
  EXPECT_EQ(state("e.json")["error"], false) << "its buffer, by whatever name, counts";
  EXPECT_EQ(state("d.json")["opened"], 3);
  EXPECT_EQ(state("d.json")["error"], false);
}

TEST_F(WindowTest, WritesStillsInTheBackground) {
  replay(
      "until loaded\nkey 5\nkey 2\nkey +\nkey G\nkey Ctrl+S\nkey Ctrl+S\nframes 2\nstate "
      "busy.json\n"
      "key G\nkey F12\nframes 2\nuntil idle\nframes 3\nstate s.json",
      {"--seed", "3", "--size", "320x240"});
  // A second one waits for the user, and neither takes a name that is taken meanwhile.
  EXPECT_NE(state("busy.json")["message"].get<std::string>().find("is being rendered"),
            std::string::npos);
  EXPECT_NE(state("s.json")["message"].get<std::string>().find("written"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "cornell_box_1_0001.exr"));
  EXPECT_FALSE(fs::exists(folder_ / "cornell_box_1_0003.png"));
  const Shot screen = shot("cornell_box_1_0001.png"), still = shot("cornell_box_1_0002.png");
  EXPECT_EQ(still.width, screen.width);
  for (const Shot* picture : {&still, &screen}) {
    EXPECT_EQ(picture->software.substr(0, 7), "lumivec");
    for (const char* part :
         {"--exposure 0.25", "--terms emitted,direct,indirect ", "--view 'ACES 1.0 SDR-video'",
          "--camera eye=", "--seed 3", "--size 176x", "--cache-error 1"})
      EXPECT_NE(picture->settings.find(part), std::string::npos) << picture->settings;
    EXPECT_EQ(picture->settings.find('#'), std::string::npos) << picture->settings;
  }
  EXPECT_NEAR(still.brightness(1.0), screen.brightness(1.0), 0.15 * screen.brightness(1.0));

  // The header suffices to make it again.
  const std::string command = std::string("'") + LUMIVEC_PROGRAM + "' render '" +
                              (scenes / "cornell_box_1.gltf").string() + "' " + still.settings +
                              " -q -o again.png";
  const CommandResult made = run_command("/bin/sh", {"-c", command}, folder_.path());
  ASSERT_EQ(made.status, 0) << command << made.err;
  const Shot again = shot("again.png");
  ASSERT_EQ(again.width, still.width);
  ASSERT_EQ(again.height, still.height);
  EXPECT_LT(again.differs(still, 0, 0, still.width, still.height), 0.001);

  // All layers are stored; the beauty is of those that were shown.
  const auto exr = OIIO::ImageInput::open((folder_ / "cornell_box_1_0002.exr").string());
  ASSERT_TRUE(exr);
  const OIIO::ImageSpec spec = exr->spec();
  std::vector<float> values(std::size_t(spec.width * spec.height * spec.nchannels));
  exr->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data());
  const auto sum = [&](const char* name) {
    const int channel = spec.channelindex(name);
    EXPECT_GE(channel, 0) << name;
    double total = 0.0;
    for (std::size_t i = std::size_t(std::max(channel, 0)); i < values.size();
         i += std::size_t(spec.nchannels))
      total += double(values[i]);
    return total;
  };
  for (const char* layer : {"specular.R", "caustic.R"}) EXPECT_GE(sum(layer), 0.0);
  const double shown = sum("emitted.R") + sum("direct.R") + sum("indirect.R");
  EXPECT_NEAR(sum("R"), shown, 1e-3 * shown);
}

// What no option of render says is told after them.
TEST_F(WindowTest, SaysHowAScreenshotWasShown) {
  replay("until loaded\nkey G\nkey U\nkey T\nkey F12\nframes 2\nuntil loaded");
  const std::string settings = shot("cornell_box_1_0001.png").settings;
  EXPECT_NE(settings.find(" # layer Objects; false colour; channel Red"), std::string::npos)
      << settings;
}

TEST_F(WindowTest, ComparesAndMapsErrors) {
  // The line begins in the middle of a picture that is 176 wide.
  replay(
      "until samples 1\nkey V\nuntil wipe\nframes 2\nshot wipe.png\nstate wipe.json\n"
      "drag left 88 100 40 100\nframes 2\nstate moved.json\nkey V\nkey M\nuntil errors\nframes 2\n"
      "shot map.png\nstate map.json\nkey M\nframes 2\nstate off.json",
      {"--size", "320x240", "--pixel-size", "4"});
  EXPECT_EQ(state("wipe.json")["wipe"], true);
  EXPECT_NEAR(double(state("moved.json")["wipe_place"]), 40.0 / 176.0, 0.5 / 176.0);
  EXPECT_EQ(state("moved.json")["eye"], state("wipe.json")["eye"]) << "the line is dragged alone";
  EXPECT_EQ(state("map.json")["shows_errors"], true);
  EXPECT_EQ(state("off.json")["shows_errors"], false);
  // Of what emits nothing is wrong: black in the map, white in the picture.
  for (const double level : shot("map.png").around(88, 57)) EXPECT_LT(level, 10.0);
  for (const double level : shot("wipe.png").around(94, 57)) EXPECT_GT(level, 200.0);
}

TEST_F(WindowTest, DrawsRecordsOverThePicture) {
  replay(
      "until samples 2\nkey Tab\nframes 2\nuntil samples 2\nshot before.png\nkey J\nuntil records\n"
      "frames 3\nstate on.json\n"
      "shot records.png\nkey J\nframes 2\nstate off.json");
  EXPECT_EQ(state("on.json")["records"], true);
  EXPECT_EQ(state("off.json")["records"], false);
  // Outlines in a green, a blue or a violet that the room does not have.
  const auto outlined = [](const Shot& s) {
    int count = 0;
    for (std::size_t i = 0; i + 2 < s.rgb.size(); i += 3) {
      const int r = s.rgb[i], g = s.rgb[i + 1], b = s.rgb[i + 2];
      count += (g > 160 && r < 130 && b < 130) || (b > 160 && r < 130) ||
               (r > 160 && b > 160 && g < 120);
    }
    return count;
  };
  EXPECT_GT(outlined(shot("records.png")), outlined(shot("before.png")) + 200);
}

// The slice of the icosahedron at the picked point lies over the picture while records are shown.
TEST_F(WindowTest, ShowsWhatArrivesAtThePickedPoint) {
  replay(
      "until samples 2\ndouble 70 150\nuntil picked\nkey Tab\nkey J\nuntil records\n"
      "frames 3\nstate on.json\nshot slice.png\n");
  EXPECT_GT(state("on.json")["incident_faces"], 150);
  EXPECT_GT(state("on.json")["incident_records"], 0);
  // The brightest face is of the heat map's last color.
  const Shot& slice = shot("slice.png");
  int bright = 0;
  for (std::size_t i = 0; i + 2 < slice.rgb.size(); i += 3)
    bright += slice.rgb[i] > 250 && slice.rgb[i + 1] > 240 && slice.rgb[i + 2] < 215 ? 1 : 0;
  EXPECT_GT(bright, 10);
}

// Clicks all over the panels: nothing ends the program, and files stay as they are.
TEST_F(WindowTest, EndsForNoClick) {
  std::string script = "until loaded\ndouble 60 150\nframes 3\n";
  for (int round = 0; round < 2; ++round) {
    for (int y = 8; y < 340; y += 13) {
      for (const int x : {290, 330, 400, 460}) {
        script += "click " + std::to_string(x) + " " + std::to_string(y) + "\n";
      }
      if (y % 7 == 0) script += "key Esc\n";
    }
    script += "move 350 200\nwheel -8\nframes 2\nshot panel_" + std::to_string(round) + ".png\n";
  }
  replay(script + "until idle\nstate state.json");
  EXPECT_TRUE(state("state.json").contains("scene"));
}

TEST_F(WindowTest, RemembersSettings) {
  replay("until loaded\nkey Tab\nkey ]\nframes 3\nstate a.json");
  ASSERT_TRUE(fs::exists(folder_ / "config" / "lumivec" / "window.json"));
  replay("until loaded\nstate b.json\nkey Ctrl+O\nframes 2\nshot files.png\nstate c.json");
  EXPECT_EQ(state("b.json")["panels"], false);
  EXPECT_EQ(state("b.json")["pixel_size"], state("a.json")["pixel_size"]);
  EXPECT_EQ(state("c.json")["files"], true);
  fs::remove_all(folder_ / "config");
  replay("until loaded\nkey Tab\nframes 2", {"--fresh"});
  EXPECT_FALSE(fs::exists(folder_ / "config"));
}

// Two hours of use in short: views, terms, sizes and scenes change all the time, and memory stays.
TEST_F(WindowTest, KeepsItsMemory) {
  std::string script = "until loaded\n";
  const auto round = [&](int i) {
    script += "drag left 80 100 " + std::to_string(60 + i % 90) + " 130\nkey X\nframes 2\nkey Z\n" +
              "resize " + std::to_string(400 + 40 * (i % 3)) + "x330\nframes 2\nkey R\nframes 2\n" +
              "key 1\nkey G\nkey G\nkey F5\nframes 2\nuntil idle\nkey Home\nuntil loaded\n";
  };
  for (int i = 0; i < 12; ++i) round(i);
  script += "state begin.json\n";
  for (int i = 0; i < 36; ++i) round(i);
  script += "state end.json";
  replay(script);
  const double begin = state("begin.json")["resident_bytes"];
  const double end = state("end.json")["resident_bytes"];
  constexpr double slack = 48.0 * 1024 * 1024;  // of allocators
  EXPECT_LT(end, 1.1 * begin + slack);
}

TEST_F(WindowTest, TellsWhatIsWrongInOneLine) {
  CommandResult result = view({"no_such.gltf"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("lumivec: no_such.gltf"), std::string::npos) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
  result = view({(scenes / "cornell_box_1.gltf").string(), "--camera", "none"});
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  std::ofstream(folder_ / "wrong.txt") << "until loaded\nkee A\n";
  result = view({(scenes / "cornell_box_1.gltf").string(), "--script", "wrong.txt"});
  EXPECT_EQ(result.err, "lumivec: wrong.txt:2: there is no 'kee'; did you mean 'key'?\n");
}

TEST(NoWindow, NamesRenderAsTheWayOn) {
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
  const TemporaryFolder folder;
  const std::string scene = (scenes / "cornell_box_1.gltf").string();
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{scene}, std::vector<std::string>{"view", scene}}) {
    const CommandResult result = run_command(LUMIVEC_PROGRAM, arguments, folder.path());
    EXPECT_EQ(result.status, 1);
    EXPECT_EQ(result.err.find("lumivec: view: there is no display"), 0u) << result.err;
    EXPECT_NE(result.err.find("lumivec render"), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace lumivec
