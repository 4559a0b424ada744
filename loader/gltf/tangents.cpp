#include "loader/gltf/tangents.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <tuple>

#include "loader/surface_directions.h"

namespace lumivec::gltf {
namespace {

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

// Gives mirrored triangles their own copy of every vertex that they share with others; returns
// which were copied.
std::vector<std::uint32_t> split_mirrored(Context& context, const std::string& where,
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
  if (shared.empty()) return shared;
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
  return shared;
}

// For every vertex, the first one that has the same position, normal, texture coordinate and
// handedness: files without indices repeat each vertex for every triangle, and their tangents are
// to be as smooth as their normals.
std::vector<std::uint32_t> weld(const Mesh& mesh, int uv_set,
                                const std::vector<std::int8_t>& handedness) {
  const auto& uvs = mesh.uvs[static_cast<std::size_t>(uv_set)];
  const auto key = [&](std::uint32_t i) {
    const V3f& p = mesh.positions[i];
    const V3f& n = mesh.normals[i];
    return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z, uvs[i].x, uvs[i].y, handedness[i]);
  };
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

// Adds the triangle's tangent, turned into the plane of each corner's normal and weighted by the
// angle there.
void add_frame(const Imath::Vec3<std::uint32_t>& t, const TangentSpace& space,
               const std::vector<std::uint32_t>& first, Mesh& mesh) {
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
    V4f& sum = mesh.tangents[first[t[c]]];
    sum += V4f(static_cast<float>(projected.x), static_cast<float>(projected.y),
               static_cast<float>(projected.z), 0.0f);
  }
}

}  // namespace

std::vector<std::uint32_t> compute_tangents(Context& context, const std::string& where,
                                            const TangentSpace& space, Mesh& mesh) {
  context.claim(mesh.triangles.size(), sizeof(std::int8_t), where);
  std::vector<std::int8_t> of_triangle(mesh.triangles.size());
  for (std::size_t i = 0; i < of_triangle.size(); ++i) {
    of_triangle[i] = static_cast<std::int8_t>(frame_of(mesh, mesh.triangles[i], space).handedness);
  }
  std::vector<std::uint32_t> doubled = split_mirrored(context, where, of_triangle, mesh);
  const std::size_t count = mesh.positions.size();
  context.claim(count, sizeof(V4f) + 2 * sizeof(std::uint32_t) + sizeof(std::int8_t), where);
  std::vector<std::int8_t> of_vertex(count, 0);
  for (std::size_t i = 0; i < of_triangle.size(); ++i) {
    if (of_triangle[i] == 0) continue;
    for (int c = 0; c < 3; ++c) of_vertex[mesh.triangles[i][c]] = of_triangle[i];
  }
  const std::vector<std::uint32_t> first = weld(mesh, space.uv_set, of_vertex);
  mesh.tangents.assign(count, V4f(0.0f));
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (of_triangle[i] != 0) add_frame(mesh.triangles[i], space, first, mesh);
  }
  for (std::size_t i = 0; i < count; ++i) mesh.tangents[i] = mesh.tangents[first[i]];
  for (std::size_t i = 0; i < count; ++i) {
    V4f& tangent = mesh.tangents[i];
    V3f direction(tangent.x, tangent.y, tangent.z);
    direction -= mesh.normals[i] * mesh.normals[i].dot(direction);
    if (!normalize(direction)) direction = perpendicular(mesh.normals[i]);
    tangent = V4f(direction.x, direction.y, direction.z, of_vertex[i] < 0 ? -1.0f : 1.0f);
  }
  return doubled;
}

}  // namespace lumivec::gltf
