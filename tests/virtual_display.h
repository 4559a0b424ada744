// An X server without a screen, for tests of what takes a display: Xvfb, on a number of its own
// choice, until this goes out of scope.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>
#include <string>

class VirtualDisplay {
 public:
  // program: Xvfb's file; screen: "WIDTHxHEIGHT".
  VirtualDisplay(const std::string& program, const std::string& screen) {
    std::array<int, 2> number{};
    if (pipe(number.data()) != 0) throw std::runtime_error("no pipe");
    process_ = fork();
    if (process_ == 0) {
      const int nowhere = open("/dev/null", O_RDWR);
      dup2(nowhere, STDOUT_FILENO);
      dup2(nowhere, STDERR_FILENO);
      close(number[0]);
      const std::string to = std::to_string(number[1]), mode = screen + "x24";
      execl(program.c_str(), program.c_str(), "-displayfd", to.c_str(), "-screen", "0",
            mode.c_str(), "-nolisten", "tcp", static_cast<char*>(nullptr));
      _exit(127);
    }
    close(number[1]);
    char letter = 0;
    while (read(number[0], &letter, 1) == 1 && letter != '\n') name_ += letter;
    close(number[0]);
    if (name_ == ":") throw std::runtime_error("Xvfb does not start");
  }
  ~VirtualDisplay() {
    kill(process_, SIGTERM);
    waitpid(process_, nullptr, 0);
  }
  VirtualDisplay(const VirtualDisplay&) = delete;
  VirtualDisplay& operator=(const VirtualDisplay&) = delete;

  // For the environment variable DISPLAY.
  const std::string& name() const { return name_; }

 private:
  pid_t process_ = -1;
  std::string name_ = ":";
};
