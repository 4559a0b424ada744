// A colour configuration, display or view that cannot be used.
#pragma once

#include <stdexcept>

namespace lumivec {

// what() is one line for the user.
class DisplayError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace lumivec
