// The default pose: morph targets by their default weights, then skinning by the joints as the node
// tree leaves them.
#pragma once

#include <memory>
#include <vector>

#include "loader/gltf/vertices.h"

namespace lumivec::gltf {

// What is done to the vertices of a primitive before the picture is taken.
struct Pose {
  std::vector<float> weights;  // of the morph targets; empty: none moves anything
  int skin = -1;               // names joint_matrices in comparisons
  std::shared_ptr<const std::vector<M44d>> joint_matrices;  // joint space at rest to world
};

// Adds the weighted targets to positions, normals and tangents. vertices: of the accessors; mesh
// holds the selected.
void apply_morph_targets(Context& context, Accessors& accessors,
                         const std::vector<Attributes>& targets, const std::vector<float>& weights,
                         std::uint64_t vertices, const VertexSelection& selection,
                         const std::string& where, Mesh& mesh);

// Moves the vertices by JOINTS_n and WEIGHTS_n into world space.
void apply_skin(Context& context, Accessors& accessors, const Attributes& attributes,
                const std::vector<M44d>& joint_matrices, const VertexSelection& selection,
                const std::string& where, Mesh& mesh);

// Inverse bind matrix × world transform of every joint of a skin. worlds: of all nodes. Fails on
// malformed matrices.
std::vector<M44d> joint_matrices(Context& context, Accessors& accessors, const tinygltf::Skin& skin,
                                 const std::string& where, const std::vector<M44d>& worlds);

}  // namespace lumivec::gltf
