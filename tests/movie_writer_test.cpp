#include "viewer/movie_writer.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>

#include "viewer/errors.h"

namespace lumivec::test {
namespace {

namespace fs = std::filesystem;

class MovieWriterTest : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_);
    path_ = std::getenv("PATH") ? std::getenv("PATH") : "";
  }
  void TearDown() override {
    setenv("PATH", path_.c_str(), 1);
    fs::remove_all(folder_);
  }

  // A program of that name is found before all others.
  void pretend_ffmpeg(const std::string& script) {
    const fs::path program = folder_ / "ffmpeg";
    std::ofstream(program) << "#!/bin/sh\n" << script;
    fs::permissions(program, fs::perms::owner_all);
    setenv("PATH", (folder_.string() + ":" + path_).c_str(), 1);
  }
  std::string error_of(const std::function<void()>& run) {
    try {
      run();
    } catch (const CommandError& error) {
      return error.what();
    }
    return "";
  }
  int entries() const {
    return static_cast<int>(std::distance(fs::directory_iterator(folder_), {}));
  }

  const fs::path folder_ =
      fs::temp_directory_path() / ("movie_writer_test." + std::to_string(getpid()));
  std::string path_;
  Picture frame_{5, 3};
};

TEST_F(MovieWriterTest, without_ffmpeg_says_so) {
  setenv("PATH", folder_.c_str(), 1);
  const std::string error = error_of([&] { MovieWriter movie(folder_ / "a.mp4", 5, 3, 30.0); });
  EXPECT_NE(error.find("a.mp4: movies are encoded by the program ffmpeg"), std::string::npos);
  EXPECT_EQ(entries(), 0);
}

TEST_F(MovieWriterTest, frames_reach_the_encoder) {
  // The last argument is "file:" and the movie's name.
  pretend_ffmpeg("for last; do :; done\ncat > \"${last#file:}\"\n");
  frame_.pixels[1] = Color(0.5f, 2.0f, -1.0f);
  MovieWriter movie(folder_ / "a.mp4", 5, 3, 30.0);
  movie.add(frame_);
  movie.add(frame_);
  EXPECT_FALSE(fs::exists(folder_ / "a.mp4")) << "not before it is complete";
  movie.finish();
  std::ifstream in(folder_ / "a.mp4", std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  ASSERT_EQ(bytes.size(), 2u * 5 * 3 * 3);
  EXPECT_EQ(static_cast<unsigned char>(bytes[3]), 128);
  EXPECT_EQ(static_cast<unsigned char>(bytes[4]), 255);
  EXPECT_EQ(static_cast<unsigned char>(bytes[5]), 0);
  EXPECT_EQ(entries(), 2);
}

TEST_F(MovieWriterTest, what_ffmpeg_says_is_told) {
  pretend_ffmpeg("echo 'Unknown encoder libx264' >&2\nexit 1\n");
  std::ofstream(folder_ / "a.mp4") << "before";
  const std::string error = error_of([&] {
    MovieWriter movie(folder_ / "a.mp4", 5, 3, 30.0);
    for (int i = 0; i < 100000; ++i) movie.add(frame_);
    movie.finish();
  });
  EXPECT_NE(error.find("Unknown encoder libx264"), std::string::npos) << error;
  EXPECT_EQ(fs::file_size(folder_ / "a.mp4"), 6u) << "what was there stays";
  EXPECT_EQ(entries(), 2);
}

TEST_F(MovieWriterTest, an_ended_walk_leaves_nothing) {
  pretend_ffmpeg("for last; do :; done\ncat > \"${last#file:}\"\n");
  {
    MovieWriter movie(folder_ / "a.mp4", 5, 3, 30.0);
    movie.add(frame_);
  }
  EXPECT_EQ(entries(), 1);
}

}  // namespace
}  // namespace lumivec::test
