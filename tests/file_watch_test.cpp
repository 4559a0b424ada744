#include "viewer/window/file_watch.h"

#include <gtest/gtest.h>

#include <fstream>

#include "temporary_folder.h"

namespace lumivec {
namespace {

namespace fs = std::filesystem;

class FileWatchTest : public testing::Test {
 protected:
  FileWatchTest() {
    write("first");
    watch_.watch(files_of_scene(file_));
  }
  void write(const std::string& text) { std::ofstream(file_) << text; }

  TemporaryFolder folder_;
  fs::path file_ = folder_ / "scene.gltf";
  FileWatch watch_;
  static constexpr double settled = FileWatch::settle_seconds + 0.01;
};

TEST_F(FileWatchTest, TellsAChangeOnceItHasSettled) {
  EXPECT_FALSE(watch_.changed(0.0));
  EXPECT_FALSE(watch_.changed(10.0));
  write("the second");
  EXPECT_FALSE(watch_.changed(20.0));
  write("the second, longer");
  EXPECT_FALSE(watch_.changed(20.2)) << "it is still being written";
  EXPECT_FALSE(watch_.changed(20.3));
  EXPECT_TRUE(watch_.changed(20.2 + settled));
  EXPECT_FALSE(watch_.changed(30.0)) << "it has been told";
}

TEST_F(FileWatchTest, WaitsForAFileThatIsGone) {
  fs::remove(file_);
  EXPECT_FALSE(watch_.changed(1.0));
  EXPECT_FALSE(watch_.changed(10.0));
  write("again");
  fs::last_write_time(file_, fs::file_time_type::clock::now() + std::chrono::seconds(2));
  EXPECT_FALSE(watch_.changed(20.0));
  EXPECT_TRUE(watch_.changed(20.0 + settled));
}

// Buffers and images count, also ones that are not there yet.
TEST_F(FileWatchTest, SeesWhatTheSceneNames) {
  write(R"({"buffers": [{"uri": "mesh.bin"}, {"uri": "data:text/plain,x"}, {"byteLength": 3}],
            "images": [{"uri": "two%20words.png"}, {"uri": 7}, {"bufferView": 0}]})");
  const std::vector<fs::path> files = files_of_scene(file_);
  EXPECT_EQ(files, (std::vector<fs::path>{file_, folder_ / "mesh.bin", folder_ / "two words.png"}));
  double now = 0.0;
  for (const char* name : {"mesh.bin", "two words.png"}) {
    watch_.watch(files);
    std::ofstream(folder_ / name) << "bytes";
    EXPECT_FALSE(watch_.changed(now += 1.0));
    EXPECT_TRUE(watch_.changed(now += settled)) << name;
  }
}

TEST_F(FileWatchTest, TakesAnythingForAScene) {
  for (const char* text : {"", "{", "[]", "{\"buffers\": 3}", "{\"images\": [1, null, []]}"}) {
    write(text);
    EXPECT_EQ(files_of_scene(file_), std::vector<fs::path>{file_}) << text;
  }
  EXPECT_EQ(files_of_scene(folder_ / "none.gltf").size(), 1u);
  EXPECT_EQ(files_of_scene("room.pov").size(), 1u);
}

}  // namespace
}  // namespace lumivec
