// The command line: which command, its options, its exit status, and every error as one line.
#pragma once

#include <string>
#include <vector>

namespace lumivec {

// arguments: without the program's name. Prints to std::cout and std::cerr. Returns the exit status
// (errors.h).
int run_command_line(const std::vector<std::string>& arguments);

}  // namespace lumivec
