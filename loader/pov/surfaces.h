// Finishes and pigments as physical surfaces.
//
// POV-Ray's finishes are not bound to conserve energy; what they stand for does: diffuse and
// reflection become a mirroring layer over a diffuse surface, highlights the roughness of a
// dielectric's gloss, filter and transmit a transmitting one with the interior's index.
#pragma once

#include <ImathBox.h>

#include "loader/pov/pov_scene.h"

namespace lumivec::pov {

struct SurfaceChoice {
  double gamma = 1.0;   // assumed_gamma
  bool lamp = false;    // looks_like: ambient shines
  Imath::Box3d bounds;  // where patterns are averaged, in the world
  M44d world_to_texture;
};

struct SurfaceNotes {
  bool averaged = false;  // a pattern could not be followed
  bool ambient = false;   // ambient light was left out
  bool bumps = false;     // a normal was left out
  bool metallic = false;  // highlights lost the surface's color
  bool brilliance = false;
};

// interior may be null. Of textures that vary, the mean.
Material surface_of(const Texture& texture, const Interior* interior, const SurfaceChoice& choice,
                    SurfaceNotes& notes);

// Whether the texture looks different in different places.
bool varies(const Texture& texture);

// The texture at each point of the world; it keeps what it is given.
std::shared_ptr<const SurfacePattern> pattern_of(std::shared_ptr<const Texture> texture,
                                                 std::shared_ptr<const Interior> interior,
                                                 const SurfaceChoice& choice, const Material& mean);

// Linear light of a color as written.
Color linear_color(double red, double green, double blue, double gamma);

}  // namespace lumivec::pov
