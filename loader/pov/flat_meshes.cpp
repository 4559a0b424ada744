#include <cmath>
#include <numbers>

#include "loader/pov/areas.h"
#include "loader/pov/tessellation.h"

namespace lumivec::pov {
namespace {

// Two directions that make a right-handed frame with the normal.
void frame_of(const V3d& normal, V3d& u, V3d& v) {
  const V3d helper = std::abs(normal.x) < 0.9 ? V3d(1, 0, 0) : V3d(0, 1, 0);
  u = helper.cross(normal).normalized();
  v = normal.cross(u);
}

}  // namespace

Mesh box_mesh(const BoxShape& box) {
  Mesh mesh;
  V3d low, high;
  for (int i = 0; i < 3; ++i) {
    low[i] = std::min(box.low[i], box.high[i]);
    high[i] = std::max(box.low[i], box.high[i]);
  }
  for (unsigned i = 0; i < 8; ++i) {
    mesh.positions.emplace_back(
        V3d((i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z));
  }
  constexpr unsigned faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : faces) {
    mesh.triangles.push_back({f[0], f[1], f[2]});
    mesh.triangles.push_back({f[0], f[2], f[3]});
  }
  return mesh;
}

Mesh plane_mesh(const PlaneShape& plane, double reach) {
  V3d u, v;
  frame_of(plane.normal, u, v);
  const V3d center = plane.normal * plane.distance;
  Mesh mesh;
  // Rings that grow outward keep triangles near the middle small, where rays need the precision.
  constexpr int rings = 8;
  constexpr double growth = 4.0;
  double size = reach / std::pow(growth, rings - 1);
  for (int ring = 0; ring < rings; ++ring, size *= growth) {
    for (int corner = 0; corner < 4; ++corner) {
      const double s = (corner == 1 || corner == 2) ? size : -size;
      const double t = corner >= 2 ? size : -size;
      mesh.positions.emplace_back(center + u * s + v * t);
    }
    const auto first = static_cast<std::uint32_t>(4 * ring);
    if (ring == 0) {
      mesh.triangles.push_back({0, 1, 2});
      mesh.triangles.push_back({0, 2, 3});
      continue;
    }
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t j = (i + 1) % 4, inner = first - 4;
      mesh.triangles.push_back({inner + i, first + i, first + j});
      mesh.triangles.push_back({inner + i, first + j, inner + j});
    }
  }
  return mesh;
}

Mesh disc_mesh(const DiscShape& disc) {
  V3d u, v;
  frame_of(disc.normal, u, v);
  Mesh mesh;
  for (int i = 0; i < around_steps; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / around_steps;
    const V3d outward = u * std::cos(angle) + v * std::sin(angle);
    mesh.positions.emplace_back(disc.center + outward * disc.hole);
    mesh.positions.emplace_back(disc.center + outward * disc.radius);
  }
  constexpr std::uint32_t n = 2 * around_steps;
  for (std::uint32_t i = 0; i < n; i += 2) {
    mesh.triangles.push_back({i, i + 1, (i + 3) % n});
    mesh.triangles.push_back({i, (i + 3) % n, (i + 2) % n});
  }
  return mesh;
}

Mesh triangle_mesh(const TriangleShape& triangle) {
  Mesh mesh;
  for (std::size_t i = 0; i < 3; ++i) {
    mesh.positions.emplace_back(triangle.corners[i]);
    if (triangle.smooth) mesh.normals.emplace_back(V3f(triangle.normals[i].normalized()));
  }
  mesh.triangles.push_back({0, 1, 2});
  for (const V3f& normal : mesh.normals) {
    if (normal.length() == 0.0f) {
      mesh.normals.clear();
      break;
    }
  }
  turn_to_normals(mesh);
  return mesh;
}

// The plane is that of most area; the language asks for points in one plane.
Mesh polygon_mesh(const PolygonShape& polygon) {
  V3d normal(0.0);
  const auto& points = polygon.points;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) normal += points[i].cross(points[i + 1]);
  Mesh mesh;
  if (normal.length() == 0.0) {
    // Sub-polygons may cancel each other: any three points that span the plane do.
    for (std::size_t i = 2; i < points.size() && normal.length() == 0.0; ++i)
      normal = (points[1] - points[0]).cross(points[i] - points[0]);
    if (normal.length() == 0.0) return mesh;
  }
  normal.normalize();
  V3d u, v;
  frame_of(normal, u, v);
  const V3d origin = normal * points.front().dot(normal);
  std::vector<Outline> outlines;
  Outline outline;
  for (const V3d& point : points) {
    outline.push_back({point.dot(u), point.dot(v)});
    if (outline.size() > 1 && outline.front() == outline.back()) {
      outline.pop_back();
      outlines.push_back(std::move(outline));
      outline.clear();
    }
  }
  if (outline.size() >= 3) outlines.push_back(std::move(outline));
  for (const AreaTriangle& t : fill_area(outlines)) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const auto& [x, y] : t) mesh.positions.emplace_back(origin + u * x + v * y);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Mesh mesh_mesh(const MeshShape& shape) {
  Mesh mesh;
  const bool own_normals = !shape.face_normals.empty();
  const bool own_uvs = !shape.face_uvs.empty();
  const bool flat = shape.normals.empty();
  const bool shared = !own_normals && !own_uvs;
  const auto add = [&](std::size_t face, std::size_t corner) {
    mesh.positions.emplace_back(shape.points[shape.faces[face][corner]]);
    if (!flat) {
      const auto index = own_normals ? shape.face_normals[face][corner] : shape.faces[face][corner];
      mesh.normals.emplace_back(V3f(shape.normals[index].normalized()));
    }
    if (!shape.uvs.empty()) {
      const auto index = own_uvs ? shape.face_uvs[face][corner] : shape.faces[face][corner];
      const auto& uv = shape.uvs[index];
      mesh.uvs[0].emplace_back(static_cast<float>(uv[0]), static_cast<float>(1.0 - uv[1]));
    }
  };
  if (!shape.uvs.empty()) mesh.uvs.resize(1);
  if (shared) {
    for (std::size_t i = 0; i < shape.points.size(); ++i) {
      mesh.positions.emplace_back(shape.points[i]);
      if (!flat) mesh.normals.emplace_back(V3f(shape.normals[i].normalized()));
      if (!shape.uvs.empty()) {
        mesh.uvs[0].emplace_back(static_cast<float>(shape.uvs[i][0]),
                                 static_cast<float>(1.0 - shape.uvs[i][1]));
      }
    }
    for (const auto& face : shape.faces) mesh.triangles.push_back({face[0], face[1], face[2]});
  } else {
    for (std::size_t face = 0; face < shape.faces.size(); ++face) {
      const auto first = static_cast<std::uint32_t>(mesh.positions.size());
      for (std::size_t corner = 0; corner < 3; ++corner) add(face, corner);
      mesh.triangles.push_back({first, first + 1, first + 2});
    }
  }
  // A normal without a direction is that of the triangles around it.
  std::vector<V3d> sums;
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    if (mesh.normals[i].length() > 0.5f) continue;
    if (sums.empty()) {
      sums.assign(mesh.positions.size(), V3d(0.0));
      for (const auto& t : mesh.triangles) {
        const V3d n = V3d(mesh.positions[t.y] - mesh.positions[t.x])
                          .cross(V3d(mesh.positions[t.z] - mesh.positions[t.x]));
        for (const auto corner : {t.x, t.y, t.z}) sums[corner] += n;
      }
    }
    mesh.normals[i] = V3f(sums[i].length() > 0.0 ? sums[i].normalized() : V3d(0, 1, 0));
  }
  turn_to_normals(mesh);
  return mesh;
}

}  // namespace lumivec::pov
