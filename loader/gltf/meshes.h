// Primitives as meshes or exact spheres, each read once and shared by all nodes that show it in the
// same pose.
#pragma once

#include <ImathBox.h>

#include <map>
#include <tuple>
#include <vector>

#include "loader/gltf/deformations.h"

namespace lumivec::gltf {

// What an instance shows. Neither mesh nor sphere: nothing that has area.
struct Shape {
  int mesh = -1;
  int sphere = -1;
  Imath::Box3d bounds;   // in object space
  int deformation = -1;  // index into Motion::deformations, where animations deform the mesh
};

class Meshes {
 public:
  Meshes(Context& context, const Document& document, Accessors& accessors, Scene& scene);

  // The shape of a primitive under a material of the scene: the material says which UV sets and
  // tangents are needed.
  Shape shape(std::size_t mesh, std::size_t primitive, int material, const Pose& pose);

 private:
  // All that the vertices depend on. Primitives of different meshes may well be the same but for
  // their material.
  using TangentKey = std::tuple<int, float, float, float, float>;
  using Key = std::tuple<int, int, Attributes, std::optional<TangentKey>, std::vector<Attributes>,
                         std::vector<float>, int, int, std::optional<double>>;

  Shape read(const tinygltf::Primitive& primitive, const std::string& name,
             const std::string& where, const std::optional<TangentSpace>& space, const Pose& pose);
  bool read_mesh(const tinygltf::Primitive& primitive, const std::string& where,
                 const std::optional<TangentSpace>& space, const Pose& pose, Mesh& mesh,
                 Deformation& deformation);
  int find_sphere(const tinygltf::Primitive& primitive, const Mesh& mesh, const std::string& where);
  void provide_uvs(int mesh, int material, const std::string& where);

  Context& context_;
  const Document& document_;
  Accessors& accessors_;
  Scene& scene_;
  std::map<Key, Shape> shapes_;
  std::map<float, int> spheres_;  // by radius
};

}  // namespace lumivec::gltf
