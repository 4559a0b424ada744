// Refuses settings that contradict themselves or ask for what cannot be.
#pragma once

#include <stdexcept>

#include "integrator/settings.h"

namespace lumivec {

// Settings that contradict themselves or a scene that does not fit the machine; what() is one line
// for the user.
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Throws RenderError, which names the first setting that is out of its range.
void check(const RenderSettings& settings);

}  // namespace lumivec
