// Texture look-up: wrap, filter, decode.
#pragma once

#include "loader/scene.h"

namespace lumivec {

// Linear RGBA of map at uv (before the map's own transform); white where the map has no image.
// Colour channels are decoded before they are interpolated; alpha is taken as it is.
V4f sample_texture(const Scene& scene, const TextureMap& map, const V2f& uv);

}  // namespace lumivec
