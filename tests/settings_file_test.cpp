#include "viewer/window/settings_file.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "temporary_folder.h"

namespace lumivec {
namespace {

TEST(SettingsFile, ComesBackAsItWas) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "deep" / "window.json";
  WindowSettings settings;
  settings.width = 1200;
  settings.height = 700;
  settings.panels = false;
  settings.pixel_size = 2;
  settings.frame_time = 0.05;
  settings.view = "Raw";
  settings.recent = {"/a.gltf", "/b.glb"};
  write_settings(file, settings);
  const WindowSettings back = read_settings(file);
  EXPECT_EQ(back.width, 1200);
  EXPECT_EQ(back.height, 700);
  EXPECT_FALSE(back.panels);
  EXPECT_EQ(back.pixel_size, 2);
  EXPECT_EQ(back.frame_time, 0.05);
  EXPECT_EQ(back.view, "Raw");
  EXPECT_EQ(back.recent, settings.recent);
}

TEST(SettingsFile, IsNeverInTheWay) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "window.json";
  const WindowSettings usual;
  EXPECT_EQ(read_settings(file).pixel_size, usual.pixel_size) << "there is none";
  for (const char* text : {"", "{", "[1]", "\"text\"", "{\"width\": \"wide\", \"recent\": 3}",
                           "{\"width\": -5, \"frame_time\": 1e300, \"recent\": [1, null]}"}) {
    std::ofstream(file) << text;
    const WindowSettings read = read_settings(file);
    EXPECT_EQ(read.width, usual.width) << text;
    EXPECT_EQ(read.frame_time, usual.frame_time) << text;
    EXPECT_TRUE(read.recent.empty()) << text;
  }
}

TEST(SettingsFile, RemembersFilesOnce) {
  WindowSettings settings;
  for (int i = 0; i < 15; ++i) remember_file(settings, "/scene_" + std::to_string(i % 12));
  ASSERT_EQ(settings.recent.size(), most_recent_files);
  EXPECT_EQ(settings.recent[0], "/scene_2");
  EXPECT_EQ(settings.recent[1], "/scene_1");
  EXPECT_EQ(settings.recent[3], "/scene_11");
}

TEST(SettingsFile, LiesInTheConfigurationFolder) {
  setenv("XDG_CONFIG_HOME", "/config", 1);
  setenv("HOME", "/home/someone", 1);
  EXPECT_EQ(settings_place(), "/config/lumivec/window.json");
  setenv("XDG_CONFIG_HOME", "relative", 1);
  EXPECT_EQ(settings_place(), "/home/someone/.config/lumivec/window.json");
  unsetenv("HOME");
  unsetenv("XDG_CONFIG_HOME");
  EXPECT_TRUE(settings_place().empty());
}

}  // namespace
}  // namespace lumivec
