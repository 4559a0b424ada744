#include "loader/pov/tessellation.h"

namespace lumivec::pov {
namespace {

struct Tessellator {
  double reach;

  std::optional<Mesh> operator()(const BoxShape& s) const { return box_mesh(s); }
  std::optional<Mesh> operator()(const PlaneShape& s) const { return plane_mesh(s, reach); }
  std::optional<Mesh> operator()(const ConeShape& s) const { return cone_mesh(s); }
  std::optional<Mesh> operator()(const DiscShape& s) const { return disc_mesh(s); }
  std::optional<Mesh> operator()(const TorusShape& s) const { return torus_mesh(s); }
  std::optional<Mesh> operator()(const std::shared_ptr<const TriangleShape>& s) const {
    return triangle_mesh(*s);
  }
  std::optional<Mesh> operator()(const std::shared_ptr<const PolygonShape>& s) const {
    return polygon_mesh(*s);
  }
  std::optional<Mesh> operator()(const std::shared_ptr<const MeshShape>& s) const {
    return mesh_mesh(*s);
  }
  std::optional<Mesh> operator()(const std::shared_ptr<const BicubicPatchShape>& s) const {
    return patch_mesh(*s);
  }
  std::optional<Mesh> operator()(const std::shared_ptr<const PrismShape>& s) const {
    return prism_mesh(*s);
  }
  std::optional<Mesh> operator()(const std::shared_ptr<const LatheShape>& s) const {
    return lathe_mesh(*s);
  }
  std::optional<Mesh> operator()(const std::shared_ptr<const SorShape>& s) const {
    return sor_mesh(*s);
  }
  template <class Other>
  std::optional<Mesh> operator()(const Other&) const {
    return std::nullopt;
  }
};

// Triangles without area have no normal, and would be of no use.
void drop_degenerate(Mesh& mesh) {
  std::erase_if(mesh.triangles, [&](const auto& t) {
    const V3d a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    return (b - a).cross(c - a).length2() == 0.0;
  });
}

}  // namespace

void turn_to_normals(Mesh& mesh) {
  if (mesh.normals.empty()) return;
  for (auto& t : mesh.triangles) {
    const V3f flat = (mesh.positions[t.y] - mesh.positions[t.x])
                         .cross(mesh.positions[t.z] - mesh.positions[t.x]);
    const V3f sum = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    if (flat.dot(sum) < 0.0f) std::swap(t.y, t.z);
  }
}

std::optional<Mesh> tessellate(const Shape& shape, double reach) {
  std::optional<Mesh> mesh = std::visit(Tessellator{reach}, shape);
  if (mesh) drop_degenerate(*mesh);
  return mesh;
}

}  // namespace lumivec::pov
