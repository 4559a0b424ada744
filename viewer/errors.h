// The two ways in which a command ends badly. what() is one line for the user, without the
// program's name: "what it is about: what is wrong; what to do".
#pragma once

#include <stdexcept>

namespace lumivec {

enum ExitStatus : int {
  exit_success = 0,
  exit_failure = 1,       // the work could not be done
  exit_usage = 2,         // the command line asks for something that does not exist
  exit_interrupted = 130  // stopped by a signal; what there was has been written
};

// The command line is wrong: exit status 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A file, a folder or the machine is in the way: exit status 1.
class CommandError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace lumivec
