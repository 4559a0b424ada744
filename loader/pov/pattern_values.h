// Patterns and pigments at points.
#pragma once

#include <optional>

#include "loader/pov/pov_scene.h"

namespace lumivec::pov {

// None: the pattern is not one that can be evaluated. [0, 1] before waves; whole numbers for
// checker and its kind.
std::optional<double> pattern_value(const Pattern& pattern, const V3d& point);

// As written, without gamma. approximate becomes true where the pigment could not be followed.
ColorFT pigment_color(const Pigment& pigment, const V3d& point, bool& approximate);

}  // namespace lumivec::pov
