// Runs the lumivec program as a shell would, and keeps what it prints.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

struct CommandResult {
  int status = -1;  // exit status; 128 + the signal that ended it
  std::string out;
  std::string err;
};

// Runs program in folder. on_error_text is called with the process and all of stderr so far,
// whenever it grows.
inline CommandResult run_command(
    const std::string& program, const std::vector<std::string>& arguments,
    const std::filesystem::path& folder,
    const std::function<void(pid_t, const std::string&)>& on_error_text = {}) {
  std::array<int, 2> out{}, err{};
  if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(err.data(), O_CLOEXEC) != 0) {
    throw std::runtime_error("no pipe");
  }
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);

  const pid_t process = fork();
  if (process == 0) {
    dup2(out[1], STDOUT_FILENO);
    dup2(err[1], STDERR_FILENO);
    unsetenv("OCIO");
    std::signal(SIGINT, SIG_DFL);  // a background shell hands on an ignored one
    if (chdir(folder.c_str()) == 0) execv(program.c_str(), pointers.data());
    _exit(127);
  }
  close(out[1]);
  close(err[1]);
  CommandResult result;
  std::array<pollfd, 2> files = {pollfd{out[0], POLLIN, 0}, pollfd{err[0], POLLIN, 0}};
  std::array<std::string*, 2> texts = {&result.out, &result.err};
  while (files[0].fd >= 0 || files[1].fd >= 0) {
    poll(files.data(), files.size(), -1);
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (files[i].fd < 0 || files[i].revents == 0) continue;
      std::array<char, 4096> bytes{};
      const ssize_t count = read(files[i].fd, bytes.data(), bytes.size());
      if (count <= 0) {
        close(files[i].fd);
        files[i].fd = -1;
        continue;
      }
      texts[i]->append(bytes.data(), std::size_t(count));
      if (i == 1 && on_error_text) on_error_text(process, result.err);
    }
  }
  int status = 0;
  waitpid(process, &status, 0);
  result.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  return result;
}
