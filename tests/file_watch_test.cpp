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

TEST_F(FileWatchTest, SeesTheFileBesideIt) {
  std::ofstream(folder_ / "scene.bin") << "bytes";
  EXPECT_FALSE(watch_.changed(1.0));
  EXPECT_TRUE(watch_.changed(1.0 + settled));
}

}  // namespace
}  // namespace lumivec
