// What this program is called in pictures, reports and --version.
#pragma once

#include <string>

namespace lumivec {

std::string version_number();  // "0.1.0"
std::string software_name();   // "lumivec 0.1.0", for file headers
std::string version_text();    // the name and the libraries that pictures depend on, for --version

}  // namespace lumivec
