#include "viewer/atomic_file.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "temporary_folder.h"
#include "viewer/errors.h"

using namespace lumivec;
namespace fs = std::filesystem;

namespace {

std::string content(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

template <typename Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const CommandError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST(AtomicFile, WritesANewFile) {
  const TemporaryFolder folder;
  write_text_atomically(folder / "new", "text");
  EXPECT_EQ(content(folder / "new"), "text");
  EXPECT_EQ(folder.files(), 1u);
}
TEST(AtomicFile, ReplacesAFile) {
  const TemporaryFolder folder;
  write_text_atomically(folder / "file", "old and long");
  write_text_atomically(folder / "file", "new");
  EXPECT_EQ(content(folder / "file"), "new");
}
TEST(AtomicFile, KeepsTheOldFileIfWritingFails) {
  const TemporaryFolder folder;
  write_text_atomically(folder / "file", "good");
  EXPECT_THROW(write_atomically(folder / "file",
                                [](const fs::path& temporary) {
                                  std::ofstream(temporary) << "half a file";
                                  throw CommandError("the disk is full");
                                }),
               CommandError);
  EXPECT_EQ(content(folder / "file"), "good");
  EXPECT_EQ(folder.files(), 1u);
}
TEST(AtomicFile, LeavesNothingIfTheFirstWriteFails) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_atomically(folder / "file",
                                [](const fs::path& temporary) {
                                  std::ofstream(temporary) << "half a file";
                                  throw CommandError("the disk is full");
                                }),
               CommandError);
  EXPECT_EQ(folder.files(), 0u);
}
TEST(AtomicFile, FollowsALink) {
  const TemporaryFolder folder;
  write_text_atomically(folder / "target", "old");
  fs::create_symlink("target", folder / "link");
  write_text_atomically(folder / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(content(folder / "target"), "new");
}

TEST(CheckWritable, PassesAndLeavesNothing) {
  const TemporaryFolder folder;
  EXPECT_NO_THROW(check_writable(folder / "file"));
  EXPECT_EQ(folder.files(), 0u);
}
TEST(CheckWritable, RefusesAMissingFolder) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "none" / "a.exr";
  EXPECT_EQ(refusal([&] { check_writable(file); }),
            file.string() + ": the folder " + file.parent_path().string() +
                " does not exist; make it first, or choose another place");
}
TEST(CheckWritable, RefusesAFolderInTheFilesPlace) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a.exr");
  EXPECT_EQ(refusal([&] { check_writable(folder / "a.exr"); }),
            (folder / "a.exr").string() +
                ": is not a file and cannot be replaced by one; choose another name");
}
TEST(CheckWritable, RefusesAFolderThatTakesNoFiles) {
  EXPECT_NE(refusal([] { check_writable("/proc/lumivec.exr"); }).find("takes no new files"),
            std::string::npos);
}
