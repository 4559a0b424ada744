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
  Imath::Box3d bounds;  // where patterns are averaged, in the texture's space
};

struct SurfaceNotes {
  bool averaged = false;  // a pattern became one color
  bool ambient = false;   // ambient light was left out
  bool bumps = false;     // a normal was left out
  bool layers = false;    // only the topmost layer is kept
  bool metallic = false;  // highlights lost the surface's color
  bool brilliance = false;
};

// interior may be null.
Material surface_of(const Texture& texture, const Interior* interior, const SurfaceChoice& choice,
                    SurfaceNotes& notes);

// Linear light of a color as written.
Color linear_color(double red, double green, double blue, double gamma);

}  // namespace lumivec::pov
