// The colors of patterns whose pigment says none. Measured from pictures that POV-Ray 3.7 makes of
// such pigments, beside the same patterns' values in grey.
#pragma once

#include "loader/pov/appearance.h"

namespace lumivec::pov {

// Empty: the pattern shows its value in grey.
const ColorMap& usual_color_map(K pattern);

}  // namespace lumivec::pov
