// How the irradiance from a polygon changes as the receiving point moves: Lambert's formula edge by
// edge, with its first and second derivatives.
//
// A mesh of polygons of radiance L has the irradiance Σ over edges of (L on the left − L on the
// right) times the edge's term, so that the derivatives of what a point sees follow from the edges
// between neighbouring directions, occlusion included. Source: Lambert 1760 (the formula);
// Schwarzhaupt, Jensen and Jarosz 2012 (the use); the derivatives are written out in the source
// file. About 60 ns an edge.
#pragma once

#include "loader/scene.h"

namespace lumivec {

// Of a function of a point in a plane: value, gradient (per scene unit), second derivatives.
struct PlaneDerivatives {
  double value = 0.0;
  double gx = 0.0, gy = 0.0;
  double hxx = 0.0, hxy = 0.0, hyy = 0.0;
};

// The term of the edge from a to b, both relative to the receiving point in a frame whose z axis is
// its normal; the point moves in x and y. Edges run counter-clockwise, seen from the point, around
// what is on their left. Degenerate edges give 0.
PlaneDerivatives edge_form_factor(const V3d& a, const V3d& b);

// Absolute eigenvalues of the second derivatives, the larger first, and the unit axis of the
// larger.
struct Curvature {
  double large = 0.0, small = 0.0;
  double axis_x = 1.0, axis_y = 0.0;
};
Curvature principal_curvature(const PlaneDerivatives& d);

}  // namespace lumivec
