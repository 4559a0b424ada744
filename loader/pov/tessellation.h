// Shapes as triangles, fine enough that their outlines look round: one door for all shapes that
// have no exact form in a Scene.
#pragma once

#include <optional>

#include "loader/pov/pov_scene.h"

namespace lumivec::pov {

// In the object space of the shape. Fronts and normals look outward where the shape has an outside.
// None: the shape is no surface of this kind, or cannot be had this way; an empty mesh: it has no
// area. Planes and polynomials are cut off at the given reach from the origin.
std::optional<Mesh> tessellate(const Shape& shape, double reach);

// How finely.
constexpr int around_steps = 128;  // of a full turn
constexpr int curve_steps = 24;    // of each stretch of a spline

// Triangles are turned so that they look where the normals do.
void turn_to_normals(Mesh& mesh);

// The parts, by shape.
Mesh box_mesh(const BoxShape& box);
Mesh plane_mesh(const PlaneShape& plane, double reach);
Mesh cone_mesh(const ConeShape& cone);
Mesh disc_mesh(const DiscShape& disc);
Mesh torus_mesh(const TorusShape& torus);
Mesh sphere_mesh(const SphereShape& sphere);  // for cuts: whole spheres have an exact form
Mesh polygon_mesh(const PolygonShape& polygon);
Mesh patch_mesh(const BicubicPatchShape& patch);
Mesh prism_mesh(const PrismShape& prism);
Mesh lathe_mesh(const LatheShape& lathe);
Mesh sor_mesh(const SorShape& sor);
Mesh triangle_mesh(const TriangleShape& triangle);
Mesh mesh_mesh(const MeshShape& mesh);

}  // namespace lumivec::pov
