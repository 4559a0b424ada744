#include "loader/surface_directions.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lumivec {
namespace {

V3d area_vector(const Mesh& mesh, const Imath::Vec3<std::uint32_t>& t) {
  const V3d a(mesh.positions[t.x]);
  return (V3d(mesh.positions[t.y]) - a).cross(V3d(mesh.positions[t.z]) - a);
}

// Area-weighted normals of the vertices that are marked.
void replace_marked(const std::vector<std::uint8_t>& marked, Mesh& mesh) {
  std::vector<V3d> sums(mesh.positions.size(), V3d(0.0));
  for (const auto& t : mesh.triangles) {
    if (!marked[t.x] && !marked[t.y] && !marked[t.z]) continue;
    const V3d area = area_vector(mesh, t);
    for (int i = 0; i < 3; ++i) sums[t[i]] += area;
  }
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (!marked[i]) continue;
    const double length = std::sqrt(sums[i].dot(sums[i]));
    mesh.normals[i] = std::isfinite(length) && length > 0.0 ? V3f(sums[i] / length) : V3f(0, 1, 0);
  }
}

}  // namespace

bool normalize(V3f& v) {
  const float length2 = v.length2();
  if (std::isfinite(length2) && length2 > 1e-20f) {  // well inside the normal range of a float
    constexpr float rounding = 1e-6f;                // of a unit vector in float
    if (std::abs(length2 - 1.0f) > rounding) v /= std::sqrt(length2);
    return true;
  }
  const V3d wide(v);
  const double length = std::sqrt(wide.dot(wide));
  if (!std::isfinite(length) || length == 0.0) return false;
  v = V3f(wide / length);
  return true;
}

V3f perpendicular(const V3f& n) {
  const V3f axis = std::abs(n.x) < 0.5f ? V3f(1, 0, 0) : V3f(0, 1, 0);
  V3f t = axis - n * n.dot(axis);
  return normalize(t) ? t : V3f(1, 0, 0);
}

std::size_t renew_normals(Mesh& mesh) {
  std::vector<std::uint8_t> marked;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (normalize(mesh.normals[i])) continue;
    if (marked.empty()) marked.resize(mesh.normals.size());
    marked[i] = 1;
    ++count;
  }
  if (count > 0) replace_marked(marked, mesh);
  return count;
}

std::size_t renew_tangents(Mesh& mesh) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    V4f& tangent = mesh.tangents[i];
    V3f direction(tangent.x, tangent.y, tangent.z);
    if (!normalize(direction)) {
      direction = perpendicular(mesh.normals[i]);
      ++count;
    }
    tangent = V4f(direction.x, direction.y, direction.z, tangent.w < 0.0f ? -1.0f : 1.0f);
  }
  return count;
}

}  // namespace lumivec
