// Text made of numbers, as people read them, and taken apart.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace lumivec {

// "42 ms", "0.42 s", "12.3 s", "4:05", "2:03:04"; "?" if negative or not finite.
std::string format_duration(double seconds);
std::string format_bytes(std::uint64_t bytes);                 // "512 B", "1.5 KiB", "2.3 GiB"
std::string format_count(std::uint64_t count);                 // "1,234,567"
std::string format_number(double value, int significant = 4);  // as printf's %g
std::string format_fixed(double value, int decimals);          // as printf's %f

// What lies between separators: always one part more than there are of them.
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace lumivec
