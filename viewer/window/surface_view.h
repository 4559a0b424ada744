// What the eye sees, without its light: objects, normals, depth as pictures.
#pragma once

#include <array>

#include "integrator/visible_surfaces.h"
#include "viewer/picture.h"

namespace lumivec {

enum class Layer : std::uint8_t { light, objects, normals, depth };
constexpr std::array<const char*, 4> layer_names = {"Light", "Objects", "Normals", "Depth"};

// Display-encoded; layer: not light. Depth is white where it is nearest and falls with its
// logarithm; where nothing is, all are black.
Picture surface_picture(const VisibleSurfaces& seen, int width, int height, Layer layer);

// Relative error |a − b| / (b + a thousandth of b's mean), by luminance; 1 is 50% and more, as
// heat_picture takes it. A pixel that is not finite in the picture alone is that, too; where the
// reference is not, the map is black.
Picture error_picture(const std::vector<Color>& picture, const std::vector<Color>& reference,
                      int width, int height);
constexpr float most_shown_error = 0.5f;

}  // namespace lumivec
