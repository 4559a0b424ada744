#include "loader/gltf/meshes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "loader/deform.h"
#include "loader/gltf/materials.h"
#include "loader/gltf/triangles.h"

namespace lumivec::gltf {
namespace {

// The tangent frame that a material's normal maps are painted in; the coat's only if the base has
// none.
std::optional<TangentSpace> tangent_space(const Material& material) {
  const TextureMap& map =
      material.normal_map.image >= 0 ? material.normal_map : material.clearcoat_normal_map;
  if (map.image < 0) return std::nullopt;
  return TangentSpace{map.uv_set, map.uv_transform};
}

std::optional<double> declared_radius(const tinygltf::Primitive& primitive) {
  if (!primitive.extras.Has("sphere")) return std::nullopt;
  return primitive.extras.Get("sphere").Get("radius").GetNumberAsDouble();
}

}  // namespace

Meshes::Meshes(Context& context, const Document& document, Accessors& accessors, Scene& scene)
    : context_(context), document_(document), accessors_(accessors), scene_(scene) {}

Shape Meshes::shape(std::size_t mesh, std::size_t primitive, int material, const Pose& pose) {
  const tinygltf::Mesh& owner = document_.model.meshes[mesh];
  const tinygltf::Primitive& source = owner.primitives[primitive];
  const std::string where = pointer({"meshes", mesh, "primitives", primitive});
  const auto space = tangent_space(scene_.materials[static_cast<std::size_t>(material)]);
  std::optional<TangentKey> tangents;
  if (space) {
    const M33f& m = space->uv_transform;
    tangents = {space->uv_set, m[0][0], m[0][1], m[1][0], m[1][1]};
  }
  const bool moves = !pose.weights.empty();
  const Key key(source.mode, source.indices, source.attributes, tangents,
                moves ? source.targets : std::vector<Attributes>(), pose.weights, pose.weights_node,
                pose.skin, declared_radius(source));
  auto it = shapes_.find(key);
  if (it == shapes_.end()) {
    it = shapes_.emplace(key, read(source, owner.name, where, space, pose)).first;
  }
  provide_uvs(it->second.mesh, material, where);
  return it->second;
}

Shape Meshes::read(const tinygltf::Primitive& primitive, const std::string& name,
                   const std::string& where, const std::optional<TangentSpace>& space,
                   const Pose& pose) {
  Shape shape;
  Mesh mesh;
  mesh.name = name;
  Deformation deformation;
  if (!read_mesh(primitive, where, space, pose, mesh, deformation)) return shape;
  shape.bounds = bounds_of(mesh);
  shape.sphere = pose.is_animated() ? -1 : find_sphere(primitive, mesh, where);
  if (shape.sphere >= 0) {
    const V3d reach(scene_.spheres[static_cast<std::size_t>(shape.sphere)].radius);
    shape.bounds = {-reach, reach};
  } else {
    shape.mesh = static_cast<int>(scene_.meshes.size());
    scene_.meshes.push_back(std::move(mesh));
  }
  if (pose.is_animated()) {
    deformation.mesh = shape.mesh;
    shape.deformation = static_cast<int>(scene_.motion.deformations.size());
    scene_.motion.deformations.push_back(std::move(deformation));
  }
  return shape;
}

// False, with a warning, if the primitive has no triangles.
bool Meshes::read_mesh(const tinygltf::Primitive& primitive, const std::string& where,
                       const std::optional<TangentSpace>& space, const Pose& pose, Mesh& mesh,
                       Deformation& deformation) {
  const auto positions = primitive.attributes.find("POSITION");
  if (!has_area(context_, primitive.mode, where)) {
    context_.warn(where, "points and lines have no area and are left out");
    return false;
  }
  if (positions == primitive.attributes.end() || !accessors_.has_data(positions->second) ||
      (primitive.indices >= 0 && !accessors_.has_data(primitive.indices))) {
    context_.warn(where, "has no positions or no indices and is left out");
    return false;
  }
  accessors_.check(positions->second);
  const std::uint64_t vertices = accessors_[positions->second].count;
  if (vertices > std::numeric_limits<std::uint32_t>::max()) {
    context_.fail(where, "has more vertices than 32-bit indices can name");
  }
  mesh.triangles =
      read_triangles(context_, accessors_, primitive.mode, primitive.indices, vertices, where);
  if (mesh.triangles.empty()) {
    context_.warn(where, "has no triangle and is left out");
    return false;
  }
  const VertexSelection selection = select_vertices(context_, where, mesh);
  read_vertices(context_, accessors_, primitive.attributes, selection, where, mesh);
  apply_pose(context_, accessors_, primitive, pose, selection, where, space, mesh, deformation);
  return true;
}

// Index of the exact sphere that the primitive declares itself to be; -1 if it does not, or is not
// one.
int Meshes::find_sphere(const tinygltf::Primitive& primitive, const Mesh& mesh,
                        const std::string& where) {
  const auto declared = declared_radius(primitive);
  if (!declared) return -1;
  const auto radius = static_cast<float>(*declared);
  constexpr double tolerance = 1e-3;  // of the radius: a thousandth of it is what a pixel can show
  const bool agrees = std::isfinite(radius) && radius > 0.0f &&
                      std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](const V3f& p) {
                        return std::abs(V3d(p).length() - *declared) <= tolerance * *declared;
                      });
  if (!agrees) {
    context_.warn(where, "mesh " + printable(mesh.name) + " is declared a sphere of radius " +
                             std::to_string(*declared) +
                             " but does not lie on it, and stays a mesh");
    return -1;
  }
  const auto [it, is_new] = spheres_.emplace(radius, static_cast<int>(scene_.spheres.size()));
  if (is_new) scene_.spheres.push_back({radius});
  return it->second;
}

// Makes sure that the mesh has every UV set that the material's maps name.
void Meshes::provide_uvs(int index, int material, const std::string& where) {
  if (index < 0) return;
  Mesh& mesh = scene_.meshes[static_cast<std::size_t>(index)];
  std::size_t needed = 0;
  for_each_map(scene_.materials[static_cast<std::size_t>(material)], [&](const TextureMap& map) {
    if (map.image >= 0) needed = std::max(needed, static_cast<std::size_t>(map.uv_set) + 1);
  });
  if (needed <= mesh.uvs.size()) return;
  context_.warn(where, "its material needs " + std::to_string(needed) + " UV sets, but there are " +
                           std::to_string(mesh.uvs.size()) + "; the rest is set to 0");
  context_.claim((needed - mesh.uvs.size()) * mesh.positions.size(), sizeof(V2f), where);
  mesh.uvs.resize(needed, std::vector<V2f>(mesh.positions.size(), V2f(0.0f)));
}

}  // namespace lumivec::gltf
