#include "viewer/movie_writer.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>

#include "viewer/atomic_file.h"
#include "viewer/errors.h"

extern char** environ;

namespace lumivec {
namespace fs = std::filesystem;

MovieWriter::MovieWriter(const fs::path& file, int width, int height, double frames_per_second)
    : file_(file), width_(width), height_(height), messages_(std::tmpfile()) {
  check_writable(file);
  unfinished_ = file;
  unfinished_.replace_filename("." + file.stem().string() + "." + std::to_string(getpid()) +
                               ".mp4");
  // A socket, as writing to a pipe whose reader has ended would end this program.
  std::array<int, 2> ends;
  if (!messages_ || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    throw CommandError(file.string() + ": cannot be written: too many files are open");
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  const std::string rate = std::to_string(frames_per_second);
  const std::string output = "file:" + unfinished_.string();
  // H.264 players want even sizes and colours at half the resolution.
  const std::vector<std::string> words = {"ffmpeg",
                                          "-loglevel",
                                          "error",
                                          "-nostdin",
                                          "-y",
                                          "-f",
                                          "rawvideo",
                                          "-pix_fmt",
                                          "rgb24",
                                          "-s",
                                          size,
                                          "-r",
                                          rate,
                                          "-i",
                                          "pipe:0",
                                          "-vf",
                                          "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                          "-c:v",
                                          "libx264",
                                          "-crf",
                                          "16",
                                          "-pix_fmt",
                                          "yuv420p",
                                          "-movflags",
                                          "+faststart",
                                          output};
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, fileno(messages_.get()), STDERR_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = -1;
  const int error = posix_spawnp(&process, "ffmpeg", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  if (error != 0) {
    close(ends[1]);
    throw CommandError(file.string() +
                       ": movies are encoded by the program ffmpeg, which is not there; install "
                       "it, or name a folder for single frames");
  }
  process_ = process;
  input_ = ends[1];
}

MovieWriter::~MovieWriter() {
  if (process_ < 0) return;
  wait();
  std::error_code ignored;
  fs::remove(unfinished_, ignored);
}

void MovieWriter::add(const Picture& displayed) {
  bytes_.clear();
  for (const Color& c : displayed.pixels) {
    for (int i = 0; i < 3; ++i) {
      // Not a number becomes black.
      const float x = c[i] > 0.0f ? std::min(c[i], 1.0f) : 0.0f;
      bytes_.push_back(static_cast<unsigned char>(std::lround(255.0f * x)));
    }
  }
  for (std::size_t sent = 0; sent < bytes_.size();) {
    const ssize_t n = send(input_, bytes_.data() + sent, bytes_.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail();
    sent += static_cast<std::size_t>(n);
  }
}

void MovieWriter::finish() {
  if (wait() != 0) fail();
  std::error_code error;
  fs::rename(unfinished_, file_, error);
  if (error) throw CommandError(file_.string() + ": cannot be written: " + error.message());
}

// The exit status of ffmpeg, once it has had its last frame.
int MovieWriter::wait() {
  if (input_ >= 0) close(input_);
  input_ = -1;
  int status = 0;
  while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

void MovieWriter::fail() {
  if (process_ >= 0) wait();
  std::error_code ignored;
  fs::remove(unfinished_, ignored);
  std::string message = "ffmpeg ended early";
  std::rewind(messages_.get());
  std::array<char, 512> line;
  while (std::fgets(line.data(), int(line.size()), messages_.get())) message = line.data();
  while (!message.empty() && message.back() == '\n') message.pop_back();
  throw CommandError(file_.string() + ": ffmpeg cannot write the movie: " + message);
}

}  // namespace lumivec
