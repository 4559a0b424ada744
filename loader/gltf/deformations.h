// Morph targets and skins of primitives, read and checked, and applied at rest: targets by their
// default weights, then skinning by the joints as the node tree leaves them.
#pragma once

#include <optional>
#include <vector>

#include "loader/gltf/tangents.h"
#include "loader/gltf/vertices.h"

namespace lumivec::gltf {

// A skin of the file, and where its joints are.
struct PosedSkin {
  Skin skin;
  std::vector<M44d> joints;  // object space at rest to world, for each joint
  bool moves = false;        // does an animation move a joint?
  int kept = -1;             // index into Motion::skins; -1: no animation changes its meshes
};

// What is done to the vertices of a primitive before the picture is taken.
struct Pose {
  std::vector<float> weights;  // of the morph targets; empty: none moves anything
  int weights_node = -1;       // whose weights an animation sets; -1: none does
  int skin = -1;               // names posed_skin in comparisons
  const PosedSkin* posed_skin = nullptr;

  bool is_animated() const { return weights_node >= 0 || (posed_skin && posed_skin->moves); }
};

// The targets that the pose gives weight to, or that an animation may give weight to; the others
// are empty. vertices: of the accessors. Fails where a target does not fit the primitive or moves a
// vertex to no finite place.
std::vector<MorphTarget> read_morph_targets(Context& context, Accessors& accessors,
                                            const std::vector<Attributes>& targets,
                                            const Pose& pose, std::uint64_t vertices,
                                            const VertexSelection& selection,
                                            const std::string& where);

// JOINTS_n and WEIGHTS_n. Fails where they do not fit the positions, name a joint that the skin has
// not got, or weights are negative or not finite.
std::vector<JointSet> read_joint_sets(Context& context, Accessors& accessors,
                                      const Attributes& attributes,
                                      const VertexSelection& selection, std::size_t joints,
                                      const std::string& where);

// Its joints and inverse bind matrices. Fails on malformed matrices.
Skin read_skin(Context& context, Accessors& accessors, const tinygltf::Skin& source,
               const std::string& where);

// Applies the pose to mesh, which holds the selected vertices. For an animated pose, keeps in
// deformation what takes to pose the mesh again, but for its mesh. Gives the mesh tangents in the
// given space, unless it has them.
void apply_pose(Context& context, Accessors& accessors, const tinygltf::Primitive& primitive,
                const Pose& pose, const VertexSelection& selection, const std::string& where,
                const std::optional<TangentSpace>& space, Mesh& mesh, Deformation& deformation);

}  // namespace lumivec::gltf
