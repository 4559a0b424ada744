#include "loader/gltf/normals.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lumivec::gltf {
namespace {

// Brings v to unit length; false if it has no direction.
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

double angle_between(V3d a, V3d b) {
  return std::atan2(a.cross(b).length(), a.dot(b));
}

// -1, 0, +1: does the texture lie on the triangle mirrored, without area, or as painted? v grows
// downwards.
struct TriangleFrame {
  int handedness = 0;
  V3d tangent{0.0};
};

TriangleFrame frame_of(const Mesh& mesh, const Imath::Vec3<std::uint32_t>& t,
                       const TangentSpace& space) {
  const auto& uvs = mesh.uvs[static_cast<std::size_t>(space.uv_set)];
  const M33f& m = space.uv_transform;
  const auto linear = [&](const V2f& d) {
    return Imath::V2d(double{d.x} * m[0][0] + double{d.y} * m[1][0],
                      double{d.x} * m[0][1] + double{d.y} * m[1][1]);
  };
  const Imath::V2d d1 = linear(uvs[t.y] - uvs[t.x]);
  const Imath::V2d d2 = linear(uvs[t.z] - uvs[t.x]);
  const double area = d1.x * d2.y - d1.y * d2.x;
  if (area == 0.0 || !std::isfinite(area)) return {};
  const V3d a(mesh.positions[t.x]);
  const V3d e1 = V3d(mesh.positions[t.y]) - a;
  const V3d e2 = V3d(mesh.positions[t.z]) - a;
  return {area < 0.0 ? 1 : -1, (e1 * d2.y - e2 * d1.y) * (area < 0.0 ? -1.0 : 1.0)};
}

template <class Array>
void repeat(Array& array, const std::vector<std::uint32_t>& sources) {
  if (array.empty()) return;
  array.reserve(array.size() + sources.size());
  for (const std::uint32_t i : sources) array.push_back(array[i]);
}

// Gives mirrored triangles their own copy of every vertex that they share with others.
void split_mirrored(Context& context, const std::string& where,
                    const std::vector<std::int8_t>& handedness, Mesh& mesh) {
  constexpr std::uint8_t plain = 1;
  constexpr std::uint8_t mirrored = 2;
  std::vector<std::uint8_t> kinds(mesh.positions.size(), 0);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint8_t kind = handedness[i] < 0 ? mirrored : handedness[i] > 0 ? plain : 0;
    for (int c = 0; c < 3; ++c) kinds[mesh.triangles[i][c]] |= kind;
  }
  std::vector<std::uint32_t> shared;
  for (std::uint32_t i = 0; i < kinds.size(); ++i) {
    if (kinds[i] == (plain | mirrored)) shared.push_back(i);
  }
  if (shared.empty()) return;
  const std::size_t before = mesh.positions.size();
  context.claim(shared.size(),
                2 * sizeof(V3f) + sizeof(V4f) + mesh.uvs.size() * sizeof(V2f) + sizeof(V4f), where);
  repeat(mesh.positions, shared);
  repeat(mesh.normals, shared);
  for (auto& uvs : mesh.uvs) repeat(uvs, shared);
  repeat(mesh.colors, shared);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (handedness[i] >= 0) continue;
    for (int c = 0; c < 3; ++c) {
      std::uint32_t& corner = mesh.triangles[i][c];
      const auto it = std::lower_bound(shared.begin(), shared.end(), corner);
      if (it == shared.end() || *it != corner) continue;
      corner = static_cast<std::uint32_t>(before + static_cast<std::size_t>(it - shared.begin()));
    }
  }
}

}  // namespace

void repair_normals(Context& context, const std::string& where, Mesh& mesh) {
  std::vector<std::uint8_t> marked;
  std::size_t count = 0;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (normalize(mesh.normals[i])) continue;
    if (marked.empty()) marked.resize(mesh.normals.size());
    marked[i] = 1;
    ++count;
  }
  if (count == 0) return;
  if (count == mesh.normals.size()) {
    mesh.normals = {};
    context.warn(where, "no normal has a direction, the triangles' own are used");
    return;
  }
  replace_marked(marked, mesh);
  context.warn(where, std::to_string(count) +
                          " normals have no direction, the triangles' own are used there");
}

void repair_tangents(Context& context, const std::string& where, Mesh& mesh) {
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
  if (count > 0) {
    context.warn(where, std::to_string(count) + " tangents have no direction, any is used");
  }
}

void compute_tangents(Context& context, const std::string& where, const TangentSpace& space,
                      Mesh& mesh) {
  std::vector<std::int8_t> handedness(mesh.triangles.size());
  for (std::size_t i = 0; i < handedness.size(); ++i) {
    handedness[i] = static_cast<std::int8_t>(frame_of(mesh, mesh.triangles[i], space).handedness);
  }
  split_mirrored(context, where, handedness, mesh);
  context.claim(mesh.positions.size(), sizeof(V4f), where);
  mesh.tangents.assign(mesh.positions.size(), V4f(0.0f));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (handedness[i] == 0) continue;
    const auto& t = mesh.triangles[i];
    const V3d tangent = frame_of(mesh, t, space).tangent;
    for (int c = 0; c < 3; ++c) {
      const V3d p(mesh.positions[t[c]]);
      const double angle = angle_between(V3d(mesh.positions[t[(c + 1) % 3]]) - p,
                                         V3d(mesh.positions[t[(c + 2) % 3]]) - p);
      const V3d n(mesh.normals[t[c]]);
      V3d projected = tangent - n * n.dot(tangent);
      const double length = projected.length();
      if (!(length > 0.0) || !std::isfinite(length)) continue;
      projected *= angle / length;
      V4f& sum = mesh.tangents[t[c]];
      sum += V4f(static_cast<float>(projected.x), static_cast<float>(projected.y),
                 static_cast<float>(projected.z), 0.0f);
      sum.w = handedness[i];
    }
  }
  for (std::size_t i = 0; i < mesh.tangents.size(); ++i) {
    V4f& tangent = mesh.tangents[i];
    V3f direction(tangent.x, tangent.y, tangent.z);
    direction -= mesh.normals[i] * mesh.normals[i].dot(direction);
    if (!normalize(direction)) direction = perpendicular(mesh.normals[i]);
    tangent = V4f(direction.x, direction.y, direction.z, tangent.w < 0.0f ? -1.0f : 1.0f);
  }
}

}  // namespace lumivec::gltf
