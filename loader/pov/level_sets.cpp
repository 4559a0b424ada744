#include <array>
#include <cmath>
#include <unordered_map>

#include "loader/pov/solids.h"
#include "loader/pov/tessellation.h"

namespace lumivec::pov {
namespace {

constexpr int grid_steps = 64;  // along each axis of the box

// Marching tetrahedra: each cube is cut into six, and each of them by the surface into at most two
// triangles whose corners lie on the surface.
class LevelSet {
 public:
  LevelSet(const Shape& shape, const Imath::Box3d& box)
      : shape_(shape), low_(box.min), step_(box.size() / grid_steps) {}

  Mesh run() {
    std::vector<double> values(std::size_t{points} * points * points);
    for (std::uint32_t i = 0; i < values.size(); ++i) values[i] = field(position(i));
    values_ = &values;
    for (int z = 0; z < grid_steps; ++z) {
      for (int y = 0; y < grid_steps; ++y) {
        for (int x = 0; x < grid_steps; ++x) cube(x, y, z);
      }
    }
    turn_to_normals(mesh_);
    return std::move(mesh_);
  }

 private:
  static constexpr std::uint32_t points = grid_steps + 1;

  double field(const V3d& p) const { return shape_field(shape_, p, {}).value_or(1.0); }

  V3d position(std::uint32_t index) const {
    return low_ + step_ * V3d(index % points, index / points % points, index / (points * points));
  }

  void cube(int x, int y, int z) {
    std::array<std::uint32_t, 8> corner{};
    bool any_inside = false, any_outside = false;
    for (std::uint32_t i = 0; i < 8; ++i) {
      corner[i] = (static_cast<std::uint32_t>(z) + (i >> 2)) * points * points +
                  (static_cast<std::uint32_t>(y) + (i >> 1 & 1)) * points +
                  static_cast<std::uint32_t>(x) + (i & 1);
      ((*values_)[corner[i]] < 0.0 ? any_inside : any_outside) = true;
    }
    if (!any_inside || !any_outside) return;
    constexpr unsigned tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                           {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};
    for (const auto& t : tetrahedra)
      tetrahedron({corner[t[0]], corner[t[1]], corner[t[2]], corner[t[3]]});
  }

  void tetrahedron(const std::array<std::uint32_t, 4>& corners) {
    std::array<std::uint32_t, 4> in{}, out{};
    std::size_t inside = 0, outside = 0;
    for (const std::uint32_t c : corners) {
      if ((*values_)[c] < 0.0) {
        in[inside++] = c;
      } else {
        out[outside++] = c;
      }
    }
    if (inside == 1) {
      triangle(crossing(in[0], out[0]), crossing(in[0], out[1]), crossing(in[0], out[2]));
    } else if (inside == 3) {
      triangle(crossing(in[0], out[0]), crossing(in[1], out[0]), crossing(in[2], out[0]));
    } else if (inside == 2) {
      const std::uint32_t a = crossing(in[0], out[0]), b = crossing(in[0], out[1]),
                          c = crossing(in[1], out[1]), d = crossing(in[1], out[0]);
      triangle(a, b, c);
      triangle(a, c, d);
    }
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
  }

  std::uint32_t crossing(std::uint32_t inside, std::uint32_t outside) {
    const std::uint64_t key = std::uint64_t{inside} << 32 | outside;
    const auto [known, fresh] =
        crossings_.try_emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (!fresh) return known->second;
    V3d in = position(inside), out = position(outside);
    constexpr int halvings = 14;
    for (int i = 0; i < halvings; ++i) {
      const V3d middle = (in + out) / 2.0;
      (field(middle) < 0.0 ? in : out) = middle;
    }
    const V3d p = (in + out) / 2.0;
    mesh_.positions.emplace_back(p);
    mesh_.normals.emplace_back(V3f(gradient(p)));
    return known->second;
  }

  V3d gradient(const V3d& p) const {
    V3d g(0.0);
    constexpr double share = 1e-3;  // of a step
    for (int i = 0; i < 3; ++i) {
      V3d d(0.0);
      d[i] = step_[i] * share;
      g[i] = (field(p + d) - field(p - d)) / d[i];
    }
    return g.length() > 0.0 ? g.normalized() : V3d(0, 1, 0);
  }

  const Shape& shape_;
  V3d low_;
  V3d step_;
  const std::vector<double>* values_ = nullptr;
  std::unordered_map<std::uint64_t, std::uint32_t> crossings_;
  Mesh mesh_;
};

}  // namespace

Mesh level_set_mesh(const Shape& shape, const Imath::Box3d& box) {
  // Open boxes would lose what touches them.
  constexpr double margin = 1.001;
  const V3d half = box.size() / 2.0 * margin;
  return LevelSet(shape, {box.center() - half, box.center() + half}).run();
}

}  // namespace lumivec::pov
