#include "viewer/command_line.h"

int main(int argc, char** argv) {
  return lumivec::run_command_line(std::vector<std::string>(argv + 1, argv + argc));
}
