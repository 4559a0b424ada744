// What the operating system says of the process and the machine.
#pragma once

#include <cstdint>

namespace lumivec {

std::uint64_t peak_memory_bytes();      // largest resident size of this process so far
std::uint64_t physical_memory_bytes();  // of the machine; 0: unknown

bool error_output_is_terminal();  // can stderr redraw a line?
int error_output_columns();       // width of that terminal; 80 if unknown

}  // namespace lumivec
