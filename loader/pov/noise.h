// Smooth noise in space, and turbulence made of it.
//
// Gradient noise of the usual kind. POV-Ray's own differs in its table of gradients, so patterns
// have the same look and not the same spots.
#pragma once

#include "loader/scene.h"

namespace lumivec::pov {

double noise(const V3d& p);      // [0, 1], 1/2 on average
V3d vector_noise(const V3d& p);  // three of them, each in [-1, 1]

struct Turbulence {
  double lambda = 2.0;  // how much finer each octave is
  double omega = 0.5;   // how much weaker
  int octaves = 6;

  V3d at(const V3d& p) const;
};

}  // namespace lumivec::pov
