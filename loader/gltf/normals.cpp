#include "loader/gltf/normals.h"

#include "loader/surface_directions.h"

namespace lumivec::gltf {

void repair_normals(Context& context, const std::string& where, Mesh& mesh) {
  const std::size_t count = renew_normals(mesh);
  if (count == 0) return;
  if (count == mesh.normals.size()) {
    mesh.normals = {};
    context.warn(where, "no normal has a direction, the triangles' own are used");
    return;
  }
  warn_of_normals(context, where, count);
}

void repair_tangents(Context& context, const std::string& where, Mesh& mesh) {
  warn_of_tangents(context, where, renew_tangents(mesh));
}

void warn_of_normals(Context& context, const std::string& where, std::size_t count) {
  if (count == 0) return;
  context.warn(where, std::to_string(count) +
                          " normals have no direction, the triangles' own are used there");
}

void warn_of_tangents(Context& context, const std::string& where, std::size_t count) {
  if (count == 0) return;
  context.warn(where, std::to_string(count) + " tangents have no direction, any is used");
}

}  // namespace lumivec::gltf
