// The shapes of primitives. Each is called after the primitive's opening brace, and stops before
// its modifiers.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

Shape parse_sphere(Parser& parser);
Shape parse_box(Parser& parser);
Shape parse_plane(Parser& parser);
Shape parse_cylinder(Parser& parser);
Shape parse_cone(Parser& parser);
Shape parse_torus(Parser& parser);
Shape parse_disc(Parser& parser);
Shape parse_triangle(Parser& parser, bool smooth);
Shape parse_polygon(Parser& parser);
Shape parse_quadric(Parser& parser);
Shape parse_poly(Parser& parser, int order);  // order 0: it is given
Shape parse_superellipsoid(Parser& parser);
Shape parse_bicubic_patch(Parser& parser);
Shape parse_prism(Parser& parser);
Shape parse_lathe(Parser& parser);
Shape parse_sor(Parser& parser);
Shape parse_sphere_sweep(Parser& parser);
Shape parse_mesh(Parser& parser);
Shape parse_mesh2(Parser& parser);
Shape parse_blob(Parser& parser);
Shape parse_height_field(Parser& parser);
Shape parse_text(Parser& parser);
Shape parse_isosurface(Parser& parser);
Shape parse_parametric(Parser& parser);
Shape parse_julia(Parser& parser);

}  // namespace lumivec::pov
