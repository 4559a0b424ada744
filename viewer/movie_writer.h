// An MP4 movie (H.264) of displayed frames, encoded by the ffmpeg program while they are made.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "viewer/picture.h"

namespace lumivec {

class MovieWriter {
 public:
  // width, height: of all frames, pixels. Throws CommandError if there is no ffmpeg, or the folder
  // takes no files.
  MovieWriter(const std::filesystem::path& file, int width, int height, double frames_per_second);
  // Without finish() no file is left, and one of that name stays as it was.
  ~MovieWriter();
  MovieWriter(const MovieWriter&) = delete;
  MovieWriter& operator=(const MovieWriter&) = delete;

  // displayed: encoded for a display, [0, 1]. Throws CommandError with what ffmpeg says.
  void add(const Picture& displayed);

  // The movie takes its place. Throws CommandError likewise.
  void finish();

 private:
  struct CloseFile {
    void operator()(std::FILE* f) const { std::fclose(f); }
  };

  [[noreturn]] void fail();
  int wait();

  std::filesystem::path file_, unfinished_;
  int width_, height_;
  int process_ = -1, input_ = -1;
  std::unique_ptr<std::FILE, CloseFile> messages_;
  std::vector<unsigned char> bytes_;
};

}  // namespace lumivec
