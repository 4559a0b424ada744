// Records of cached light as ellipses on the surfaces of the picture.
#pragma once

#include "viewer/window/panels.h"

namespace lumivec {

// Over the picture, in colours that tell what limits their reach, and a table of how many there
// are; none of those behind what the eye sees.
void draw_records(const PanelInput& input);

}  // namespace lumivec
