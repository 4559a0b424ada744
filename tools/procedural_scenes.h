// Scenes of any size for benchmarks, made in code: all surfaces diffuse, so that rays scatter as a
// benchmark can repeat.
#pragma once

#include <cstdint>

#include "loader/scene.h"

namespace lumivec {

// Haines' Sphere Flake: 1 + 9 + … + 9^depth exact spheres over a floor, lit by a sphere.
Scene sphere_flake_scene(int depth);

// A bumpy ball of about that many triangles, with smooth normals and texture coordinates, over a
// floor, lit by a sphere.
Scene bumpy_ball_scene(std::uint32_t triangles);

}  // namespace lumivec
