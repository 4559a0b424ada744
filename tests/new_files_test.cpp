#include "viewer/window/new_files.h"

#include <gtest/gtest.h>

#include <fstream>

#include "temporary_folder.h"
#include "viewer/errors.h"

namespace lumivec {
namespace {

namespace fs = std::filesystem;

std::string name(const NewFiles& files, std::size_t i = 0) {
  return files.file(i).filename().string();
}

TEST(NewFiles, AreNeverGivenTwice) {
  const TemporaryFolder folder;
  NewFiles first(folder.path(), "room", {".png"});
  const NewFiles second(folder.path(), "room", {".png"});
  EXPECT_EQ(name(first), "room_0001.png");
  EXPECT_EQ(name(second), "room_0002.png") << "before the first has been written";
}

TEST(NewFiles, ShareOneNumber) {
  const TemporaryFolder folder;
  std::ofstream(folder / "room_0001.png") << "a screenshot";
  std::ofstream(folder / "room_0002.exr") << "a still";
  NewFiles files(folder.path(), "room", {".exr", ".png"});
  EXPECT_EQ(name(files, 0), "room_0003.exr");
  EXPECT_EQ(name(files, 1), "room_0003.png");
  EXPECT_FALSE(fs::exists(folder / "room_0001.exr")) << "nothing is left of what did not fit";
  EXPECT_EQ(fs::file_size(folder / "room_0001.png"), 12u);
}

TEST(NewFiles, GoUnlessTheyAreKept) {
  const TemporaryFolder folder;
  { const NewFiles files(folder.path(), "room", {".png"}); }
  EXPECT_FALSE(fs::exists(folder / "room_0001.png"));
  {
    NewFiles files(folder.path(), "room", {".png"});
    files.keep();
  }
  EXPECT_TRUE(fs::exists(folder / "room_0001.png"));
}

TEST(NewFiles, SayWhereNoneCanBe) {
  const TemporaryFolder folder;
  try {
    const NewFiles files(folder / "missing", "room", {".png"});
    FAIL();
  } catch (const CommandError& error) {
    EXPECT_NE(std::string(error.what()).find("cannot be written"), std::string::npos);
  }
}

}  // namespace
}  // namespace lumivec
