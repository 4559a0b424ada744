#include <cmath>
#include <functional>
#include <numbers>

#include "loader/pov/curves.h"
#include "loader/pov/tessellation.h"

namespace lumivec::pov {
namespace {

constexpr double pi = std::numbers::pi;

// Points (i, j) of a grid, i up to width, j up to height, with their normals.
Mesh grid_mesh(std::uint32_t width, std::uint32_t height,
               const std::function<V3d(std::uint32_t, std::uint32_t)>& point,
               const std::function<V3d(std::uint32_t, std::uint32_t)>& normal) {
  Mesh mesh;
  for (std::uint32_t j = 0; j <= height; ++j) {
    for (std::uint32_t i = 0; i <= width; ++i) {
      mesh.positions.emplace_back(point(i, j));
      if (normal) mesh.normals.emplace_back(V3f(normal(i, j).normalized()));
    }
  }
  for (std::uint32_t j = 0; j < height; ++j) {
    for (std::uint32_t i = 0; i < width; ++i) {
      const std::uint32_t a = j * (width + 1) + i, b = a + width + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  }
  return mesh;
}

void append(Mesh& mesh, const Mesh& part) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
  mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
  for (const auto& t : part.triangles)
    mesh.triangles.push_back({t.x + first, t.y + first, t.z + first});
}

V3d on_circle(double radius, double height, std::uint32_t step) {
  const double angle = 2.0 * pi * (step % around_steps) / around_steps;
  return {radius * std::cos(angle), height, radius * std::sin(angle)};
}

// A profile turned around y. tangents: of its points; flat between them if there are none.
Mesh turned(const std::vector<Point2>& profile, const std::vector<Point2>& tangents) {
  Mesh mesh;
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    const Point2 ends[2] = {profile[k], profile[k + 1]};
    const Point2 along = {ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]};
    if (along[0] == 0.0 && along[1] == 0.0) continue;
    append(mesh, grid_mesh(
                     around_steps, 1,
                     [&](auto i, auto j) { return on_circle(ends[j][0], ends[j][1], i); },
                     [&](auto i, auto j) {
                       Point2 t = tangents.empty() ? along : tangents[k + j];
                       if (t[0] == 0.0 && t[1] == 0.0) t = along;
                       return on_circle(t[1], -t[0], i);
                     }));
  }
  turn_to_normals(mesh);
  return mesh;
}

}  // namespace

Mesh torus_mesh(const TorusShape& torus) {
  constexpr int across_steps = around_steps / 2;
  const auto direction = [](std::uint32_t i, std::uint32_t j) {
    const double across = 2.0 * pi * (j % across_steps) / across_steps;
    return on_circle(std::cos(across), std::sin(across), i);
  };
  Mesh mesh = grid_mesh(
      around_steps, across_steps,
      [&](auto i, auto j) {
        return on_circle(torus.major, 0.0, i) + direction(i, j) * torus.minor;
      },
      direction);
  turn_to_normals(mesh);
  return mesh;
}

Mesh sphere_mesh(const SphereShape& sphere) {
  constexpr int height_steps = around_steps / 2;
  const auto direction = [](std::uint32_t i, std::uint32_t j) {
    const double height = pi * (static_cast<double>(j) / height_steps - 0.5);
    return on_circle(std::cos(height), std::sin(height), i);
  };
  const double radius = std::abs(sphere.radius);
  Mesh mesh = grid_mesh(
      around_steps, height_steps,
      [&](auto i, auto j) { return sphere.center + direction(i, j) * radius; }, direction);
  turn_to_normals(mesh);
  return mesh;
}

Mesh cone_mesh(const ConeShape& cone) {
  const V3d axis = cone.cap - cone.base;
  Mesh mesh;
  if (axis.length() == 0.0) return mesh;
  const double height = axis.length();
  std::vector<Point2> side = {{cone.base_radius, 0.0}, {cone.cap_radius, height}};
  mesh = turned(side, {});
  if (!cone.open) {
    append(mesh, turned({{0.0, 0.0}, {cone.base_radius, 0.0}}, {}));
    append(mesh, turned({{cone.cap_radius, height}, {0.0, height}}, {}));
  }
  // From the y axis to the cone's own.
  const V3d y = axis / height;
  const V3d helper = std::abs(y.x) < 0.9 ? V3d(1, 0, 0) : V3d(0, 0, 1);
  const V3d x = y.cross(helper).normalized(), z = x.cross(y);
  for (V3f& p : mesh.positions) p = V3f(cone.base + x * p.x + y * p.y + z * p.z);
  for (V3f& n : mesh.normals) n = V3f((x * n.x + y * n.y + z * n.z).normalized());
  turn_to_normals(mesh);
  return mesh;
}

Mesh lathe_mesh(const LatheShape& lathe) {
  Mesh mesh;
  for (const Curve& curve : sample_curves(lathe.curve, lathe.points, false, curve_steps))
    append(mesh, turned(curve.points, curve.tangents));
  return mesh;
}

// Between two heights the square of the radius is a cubic in the height; at the points its slope is
// 2 r r', with r' from the neighbours.
Mesh sor_mesh(const SorShape& sor) {
  const auto& p = sor.points;
  const auto slope = [&](std::size_t i) {
    const double rise = p[i + 1][1] - p[i - 1][1];
    return rise == 0.0 ? 0.0 : 2.0 * p[i][0] * (p[i + 1][0] - p[i - 1][0]) / rise;
  };
  std::vector<Point2> profile, tangents;
  for (std::size_t i = 1; i + 2 < p.size(); ++i) {
    const double h = p[i + 1][1] - p[i][1];
    const double a = p[i][0] * p[i][0], b = p[i + 1][0] * p[i + 1][0];
    const double sa = slope(i) * h, sb = slope(i + 1) * h;
    for (int step = i == 1 ? 0 : 1; step <= curve_steps; ++step) {
      const double t = static_cast<double>(step) / curve_steps;
      const double square = a * (1 + 2 * t) * (1 - t) * (1 - t) + b * t * t * (3 - 2 * t) +
                            sa * t * (1 - t) * (1 - t) - sb * t * t * (1 - t);
      const double rate =
          (b - a) * 6 * t * (1 - t) + sa * (1 - t) * (1 - 3 * t) - sb * t * (2 - 3 * t);
      const double radius = std::sqrt(std::max(square, 0.0));
      profile.push_back({radius, p[i][1] + t * h});
      tangents.push_back(radius > 0.0 ? Point2{rate / (2.0 * radius), h} : Point2{rate, 0.0});
    }
  }
  Mesh mesh = turned(profile, tangents);
  if (!sor.open && !profile.empty()) {
    append(mesh, turned({{0.0, profile.front()[1]}, profile.front()}, {}));
    append(mesh, turned({profile.back(), {0.0, profile.back()[1]}}, {}));
  }
  return mesh;
}

Mesh prism_mesh(const PrismShape& prism) {
  const auto curves = sample_curves(prism.curve, prism.points, true, curve_steps);
  const double heights[2] = {prism.low, prism.high};
  // A conic sweep grows with the height from the apex at 0.
  const auto scale = [&](std::uint32_t end) { return prism.conic ? heights[end] : 1.0; };
  Mesh mesh;
  std::vector<Outline> outlines;
  for (const Curve& curve : curves) {
    for (std::size_t k = 0; k + 1 < curve.points.size(); ++k) {
      const Point2 along = {curve.points[k + 1][0] - curve.points[k][0],
                            curve.points[k + 1][1] - curve.points[k][1]};
      if (along[0] == 0.0 && along[1] == 0.0) continue;
      append(mesh, grid_mesh(
                       1, 1,
                       [&](auto i, auto j) {
                         const Point2& q = curve.points[k + i];
                         return V3d(q[0] * scale(j), heights[j], q[1] * scale(j));
                       },
                       [&](auto i, auto) {
                         const Point2& q = curve.points[k + i];
                         Point2 t = curve.tangents.empty() ? along : curve.tangents[k + i];
                         if (t[0] == 0.0 && t[1] == 0.0) t = along;
                         const V3d rise = prism.conic ? V3d(q[0], 1.0, q[1]) : V3d(0, 1, 0);
                         const V3d normal = rise.cross(V3d(t[0], 0.0, t[1]));
                         return normal.length() > 0.0 ? normal : V3d(0, 1, 0);
                       }));
    }
    outlines.emplace_back(curve.points.begin(), curve.points.end() - (curve.closed ? 1 : 0));
  }
  if (!prism.open) {
    for (const AreaTriangle& t : fill_area(outlines)) {
      for (std::uint32_t end = 0; end < 2; ++end) {
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Point2& q : t) {
          mesh.positions.emplace_back(V3d(q[0] * scale(end), heights[end], q[1] * scale(end)));
          mesh.normals.emplace_back(
              0.0f, heights[end] == std::max(prism.low, prism.high) ? 1.0f : -1.0f, 0.0f);
        }
        mesh.triangles.push_back({first, first + 1, first + 2});
      }
    }
  }
  turn_to_normals(mesh);
  return mesh;
}

Mesh patch_mesh(const BicubicPatchShape& patch) {
  constexpr std::uint32_t steps = 32;
  using Weights = std::array<double, 4>;
  const auto weights = [](std::uint32_t i) -> Weights {
    const double t = static_cast<double>(i) / steps, s = 1.0 - t;
    return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  };
  const auto slopes = [](std::uint32_t i) -> Weights {
    const double t = static_cast<double>(i) / steps, s = 1.0 - t;
    return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
  };
  const auto sum = [&](const Weights& u, const Weights& v) {
    V3d total(0.0);
    for (std::size_t i = 0; i < 16; ++i) total += patch.points[i] * (u[i % 4] * v[i / 4]);
    return total;
  };
  Mesh mesh = grid_mesh(
      steps, steps, [&](auto i, auto j) { return sum(weights(i), weights(j)); },
      [&](auto i, auto j) {
        // At an edge that is a point, the normal is taken from a little inside.
        for (std::uint32_t inward = 0; inward < 2; ++inward) {
          const std::uint32_t a = i + inward <= steps ? i + inward : i - inward;
          const std::uint32_t b = j + inward <= steps ? j + inward : j - inward;
          const V3d normal = sum(slopes(a), weights(b)).cross(sum(weights(a), slopes(b)));
          if (normal.length() > 0.0) return normal;
        }
        return V3d(0, 1, 0);
      });
  turn_to_normals(mesh);
  return mesh;
}

}  // namespace lumivec::pov
