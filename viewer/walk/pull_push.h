// Fills the gaps of a picture that is known at some pixels only, from coarser and coarser versions
// of it (Gortler, Grzeszczuk, Szeliski and Cohen 1996, "The Lumigraph", section 3.4), each surface
// from what is known of itself as far as there is any nearby.
#pragma once

#include <cstdint>
#include <vector>

#include "integrator/visible_surfaces.h"
#include "loader/scene.h"

namespace lumivec {

// pixels: width × height, row by row; known: not 0 where a pixel is. The others are set. seen: what
// the pixels show. Without any known pixel all become black.
void pull_push(int width, int height, const std::vector<std::uint8_t>& known,
               const VisibleSurfaces& seen, std::vector<Color>& pixels);

}  // namespace lumivec
