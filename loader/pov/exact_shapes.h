// The curved shapes as primitives that a Scene holds exactly: all but their place and part.
#pragma once

#include <optional>

#include "loader/pov/shapes.h"
#include "loader/scene.h"

namespace lumivec::pov {

// None: the shape has no inside, or cannot be had this way.
std::optional<SolidLeaf> exact_prism(const PrismShape& prism);
std::optional<SolidLeaf> exact_lathe(const LatheShape& lathe);
std::optional<SolidLeaf> exact_sor(const SorShape& sor);
std::optional<SolidLeaf> exact_superellipsoid(const SuperellipsoidShape& shape);
std::optional<SolidLeaf> exact_blob(const BlobShape& blob);
std::optional<SolidLeaf> exact_sweep(const SphereSweepShape& sweep);

// From an upright unit to one along an axis: y becomes along, which is not 0; x and z are as wide
// as said and perpendicular to it.
M44d upright_to(const V3d& base, const V3d& along, double wide);

// In the shape's own space.
Imath::Box3d bounds_of(const PrismShape& prism);
Imath::Box3d bounds_of(const LatheShape& lathe);
Imath::Box3d bounds_of(const SorShape& sor);
Imath::Box3d bounds_of(const SphereSweepShape& sweep);

}  // namespace lumivec::pov
