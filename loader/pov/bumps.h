// Normals of textures at points: bumps that are only seen in the shading.
#pragma once

#include "loader/pov/pov_scene.h"

namespace lumivec::pov {

// How the texture bends the surface's normal; both in the texture's own space, as planes' normals
// are transformed. Any length but 0; the result is of unit length. Of layers the uppermost that has
// bumps says. approximate becomes true where a part of the bumps could not be followed, which then
// leaves the normal alone.
V3d bent_normal(const Texture& texture, const V3d& point, const V3d& normal, bool& approximate);

// Whether the texture bends normals at all.
bool has_bumps(const Texture& texture);

}  // namespace lumivec::pov
