// Vertices under morph targets and joints: glTF 2.0, sections 3.7.2.2 and 3.7.3.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "loader/scene.h"

namespace lumivec {

// What deforming a mesh came upon.
struct DeformationFaults {
  std::optional<std::size_t> not_finite;  // the first vertex without a finite place; it is set to 0
  std::size_t loose = 0;                  // vertices that hang on no joint; they stay as they are
  std::size_t normals = 0;   // that have no direction; the triangles' own are used there
  std::size_t tangents = 0;  // likewise; any is used
};

// Adds weighted targets, one weight for each, to the mesh's vertices.
DeformationFaults morph(const std::vector<MorphTarget>& targets, const std::vector<float>& weights,
                        Mesh& mesh);

// Moves vertices by the blend of their joints: joint_matrices of their skin, by index. turned: are
// the triangles turned against how they were before any joint moved them? Kept as the joints
// mirror the mesh or not, so that its front stays in front.
DeformationFaults skin(const std::vector<JointSet>& joint_sets,
                       const std::vector<M44d>& joint_matrices, bool& turned, Mesh& mesh);

// Object space at rest to world, for every joint as its node is placed now; may be not finite.
std::vector<M44d> joint_matrices(const Skin& skin, const std::vector<Node>& nodes);

// Sets the vertices of mesh, which is the deformation's own, by its current weights. joints: of its
// skin, unused without one. Costs two passes over the vertices. Also sets turned and bounds.
DeformationFaults deform(const std::vector<M44d>& joints, Deformation& deformation, Mesh& mesh);

// Of the positions.
Imath::Box3d bounds_of(const Mesh& mesh);

}  // namespace lumivec
