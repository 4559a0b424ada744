// The window as a user meets it: events are replayed against the real one, under Xvfb, and what it
// shows and says is looked at. Skipped where there is neither Xvfb nor a display.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "command_runner.h"
#include "temporary_folder.h"
#include "viewer/window/key_table.h"
#include "virtual_display.h"

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

  CommandResult view(const std::vector<std::string>& arguments,
                     const std::string& screen = "1280x1024") const {
    std::optional<VirtualDisplay> display;
    if (!xvfb.empty()) {
      display.emplace(xvfb, screen);
      setenv("DISPLAY", display->name().c_str(), 1);
    }
    std::vector<std::string> words = {"view"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    return run_command(LUMIVEC_PROGRAM, words, folder_.path());
  }

  // Replays script against a small window on the Cornell box; it has to end well.
  void replay(const std::string& script, std::vector<std::string> options = {},
              const std::string& screen = "1280x1024") {
    std::ofstream(folder_ / "script.txt") << script << "\nquit\n";
    if (options.empty() || options[0].starts_with("--"))
      options.insert(options.begin(), (scenes / "cornell_box_1.gltf").string());
    for (const char* word : {"--script", "script.txt"}) options.emplace_back(word);
    if (std::find(options.begin(), options.end(), "--size") == options.end())
      options.insert(options.end(), {"--size", "480x360"});
    const CommandResult result = view(options, screen);
    EXPECT_EQ(result.err, "");
    EXPECT_EQ(result.status, 0);
  }

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
};

TEST_F(WindowTest, ShowsAScene) {
  replay("until samples 1\nshot all.png\nstate state.json");
  const nlohmann::json s = state("state.json");
  EXPECT_EQ(s["error"], false);
  EXPECT_EQ(s["window"], nlohmann::json({480, 360}));
  EXPECT_EQ(s["terms"], "emitted,specular,direct,indirect,caustic");
  const Shot all = shot("all.png");
  EXPECT_EQ(all.width, 480);
  EXPECT_GT(all.brightness(0.5), 20.0);
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
  EXPECT_LT(shot("solo.png").brightness(0.5), 0.7 * shot("all.png").brightness(0.5));
}

TEST_F(WindowTest, ChangesExposure) {
  replay(
      "until samples 1\nstate a.json\nshot a.png\nkey +\nkey +\nkey -\nkey +\nkey +\nkey +\n"
      "frames 2\nstate b.json\nshot b.png\nkey Shift+B\nframes 2\nstate c.json\nkey B\nframes 2\n"
      "state d.json");
  EXPECT_EQ(state("a.json")["exposure"], 0.0);
  EXPECT_EQ(state("b.json")["exposure"], 1.0);
  EXPECT_EQ(state("c.json")["exposure"], 0.0);
  EXPECT_NE(state("d.json")["exposure"], 0.0);
  EXPECT_GT(shot("b.png").brightness(0.5), 1.15 * shot("a.png").brightness(0.5));
}

TEST_F(WindowTest, MovesByMouse) {
  replay(
      "until loaded\nstate start.json\ndrag left 80 100 120 120\nframes 2\nstate orbit.json\n"
      "drag middle 80 100 120 120\nframes 2\nstate pan.json\ndrag right 80 100 120 120\nframes 2\n"
      "state look.json\nwheel 2\nframes 2\nstate dolly.json\nkey Home\nframes 2\nstate home.json\n"
      "hold W\nwait 0.3\nlet W\nframes 2\nstate fly.json\nwait 0.3\nstate still.json");
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

// What is under the mouse becomes the pivot, and can be changed and changed back.
TEST_F(WindowTest, PicksByDoubleClick) {
  replay("until samples 1\ndouble 70 150\nwait 0.5\nuntil loaded\nframes 5\nstate state.json");
  const nlohmann::json s = state("state.json");
  EXPECT_GE(s["picked"], 0);
  EXPECT_EQ(s["message"].get<std::string>().substr(0, 8), "Pivot on");
}

TEST_F(WindowTest, KeepsCopiesAndPastesViews) {
  replay(
      "until loaded\nkey Ctrl+3\nkey Ctrl+C\nstate a.json\nkey X\nframes 2\nstate b.json\n"
      "key Alt+3\nframes 2\nstate c.json\nkey Y\nframes 2\nkey Ctrl+V\nframes 2\nstate d.json\n"
      "key Alt+7\nframes 2\nstate e.json");
  EXPECT_NE(state("b.json")["camera"], state("a.json")["camera"]);
  EXPECT_EQ(state("c.json")["eye"], state("a.json")["eye"]);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(state("d.json")["eye"][std::size_t(i)], state("a.json")["eye"][std::size_t(i)],
                1e-9);
  EXPECT_NE(state("e.json")["message"].get<std::string>().find("no view 7"), std::string::npos);
  // render understands it.
  const std::string text = state("a.json")["camera"];
  const CommandResult result =
      run_command(LUMIVEC_PROGRAM,
                  {"render", (scenes / "cornell_box_1.gltf").string(), "-o", "still.png",
                   "--camera", text, "--size", "16", "--spp", "1", "-q"},
                  folder_.path());
  EXPECT_EQ(result.status, 0) << result.err;
}

TEST_F(WindowTest, FollowsTheWindowsSize) {
  replay(
      "until loaded\nresize 700x300\nwait 0.5\nuntil loaded\nframes 3\nstate wide.json\n"
      "shot wide.png\nresize 640x480\nwait 0.5\nuntil loaded\nframes 3\nshot vga.png\n"
      "key Tab\nframes 2\nwait 0.3\nuntil loaded\nframes 3\nstate bare.json\n"
      "minimise\nwait 0.3\nrestore\nwait 0.5\nuntil loaded\nstate after.json");
  EXPECT_EQ(state("wide.json")["window"], nlohmann::json({700, 300}));
  EXPECT_EQ(shot("wide.png").width, 700);
  EXPECT_EQ(shot("vga.png").height, 480);
  EXPECT_EQ(state("bare.json")["panels"], false);
  EXPECT_EQ(state("bare.json")["picture"][0], 640);
  EXPECT_EQ(state("after.json")["error"], false);
}

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
         (scenes / "cornell_box_2.gltf").string() +
         "\nwait 0.3\nuntil idle\nuntil loaded\nstate second.json");
  const nlohmann::json broken = state("broken.json");
  EXPECT_NE(broken["message"].get<std::string>().find("broken.gltf"), std::string::npos);
  EXPECT_EQ(fs::path(broken["scene"].get<std::string>()).filename(), "cornell_box_1.gltf");
  EXPECT_GT(shot("broken.png").brightness(0.5), 15.0) << "the old picture stays";
  const nlohmann::json second = state("second.json");
  EXPECT_EQ(second["error"], false);
  EXPECT_EQ(fs::path(second["scene"].get<std::string>()).filename(), "cornell_box_2.gltf");
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
      "copy cornell_box_2.gltf scene.gltf\nwait 2\nuntil idle\nuntil loaded\nstate b.json\n"
      "copy broken.gltf scene.gltf\nuntil error\nframes 3\nstate c.json\nshot c.png\n"
      "copy cornell_box_1.gltf scene.gltf\nwait 2\nuntil idle\nuntil loaded\nstate d.json",
      {(folder_ / "scene.gltf").string()});
  EXPECT_EQ(state("a.json")["opened"], 1);
  EXPECT_EQ(state("b.json")["opened"], 2);
  EXPECT_EQ(state("b.json")["camera"], state("a.json")["camera"]) << "the camera stays";
  EXPECT_EQ(state("c.json")["opened"], 2);
  EXPECT_EQ(state("c.json")["error"], true);
  EXPECT_GT(shot("c.png").brightness(0.5), 10.0) << "the old picture stays";
  EXPECT_EQ(state("d.json")["opened"], 3);
  EXPECT_EQ(state("d.json")["error"], false);
}

TEST_F(WindowTest, WritesStillsInTheBackground) {
  replay(
      "until loaded\nkey 5\nkey +\nkey Ctrl+S\nwait 0.2\nuntil idle\nframes 3\nstate s.json\n"
      "until samples 0.5\nkey F12\nframes 3\nstate t.json",
      {"--size", "320x240"});
  EXPECT_NE(state("s.json")["message"].get<std::string>().find("written"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder_ / "cornell_box_1_0001.exr"));
  const Shot still = shot("cornell_box_1_0001.png"), screen = shot("cornell_box_1_0002.png");
  EXPECT_EQ(still.width, screen.width);
  for (const Shot* picture : {&still, &screen}) {
    EXPECT_EQ(picture->software.substr(0, 7), "lumivec");
    for (const char* part : {"--exposure 0.25", "--terms emitted,specular,direct,indirect",
                             "--view 'ACES 1.0 SDR-video'", "--camera eye="})
      EXPECT_NE(picture->settings.find(part), std::string::npos) << picture->settings;
  }
  EXPECT_NEAR(still.brightness(1.0), screen.brightness(1.0), 0.15 * screen.brightness(1.0));
}

TEST_F(WindowTest, ComparesAndMapsErrors) {
  replay(
      "until samples 1\nkey V\nuntil samples 1\nframes 4\nshot wipe.png\nstate wipe.json\n"
      "drag left 120 100 60 100\nframes 2\nstate moved.json\nkey V\nkey M\nuntil errors\nframes 2\n"
      "shot map.png\nstate map.json",
      {"--size", "320x240", "--pixel-size", "4"});
  EXPECT_EQ(state("wipe.json")["wipe"], true);
  EXPECT_EQ(state("map.json")["shows_errors"], true);
}

TEST_F(WindowTest, DrawsRecordsOverThePicture) {
  replay(
      "until samples 2\nkey Tab\nframes 2\nshot before.png\nkey J\nframes 30\nstate on.json\n"
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
              "key 1\nkey G\nkey G\nkey F5\nwait 0.1\nuntil idle\nkey Home\nuntil loaded\n";
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
