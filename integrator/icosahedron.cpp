#include "integrator/icosahedron.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "integrator/lanes.h"

namespace lumivec {

namespace {

using Triangle = std::array<V3f, 3>;

// Cosines of single-precision unit vectors are off by no more than this, plane distances too.
constexpr float rounding = 5e-7f;

V3f midpoint(const V3f& a, const V3f& b) {
  return (a + b).normalized();
}

// The child in the middle is the triangle of the midpoints; the others keep a corner.
Triangle child_triangle(const Triangle& t, std::uint32_t which) {
  const Triangle middle = {midpoint(t[1], t[2]), midpoint(t[2], t[0]), midpoint(t[0], t[1])};
  for (std::uint32_t corner = 0; corner < 3; ++corner) {
    if (which != Icosahedron::corner_child(corner)) continue;
    Triangle child = middle;
    child[corner] = t[corner];
    // The two midpoints on the edges of this corner, in an order that keeps the orientation.
    child[(corner + 1) % 3] = middle[(corner + 2) % 3];
    child[(corner + 2) % 3] = middle[(corner + 1) % 3];
    return child;
  }
  return middle;
}

// The twelve corners: cyclic permutations of (0, ±1, ±golden ratio).
std::array<V3f, 12> icosahedron_corners() {
  const float g = std::numbers::phi_v<float>;
  std::array<V3f, 12> corners;
  std::size_t n = 0;
  for (const float a : {-1.0f, 1.0f}) {
    for (const float b : {-g, g}) {
      corners[n++] = V3f(0.0f, a, b).normalized();
      corners[n++] = V3f(a, b, 0.0f).normalized();
      corners[n++] = V3f(b, 0.0f, a).normalized();
    }
  }
  return corners;
}

}  // namespace

Icosahedron::Icosahedron() {
  // Faces are the triples of corners that are an edge apart; cosine of an edge: 1/√5.
  const std::array<V3f, 12> corners = icosahedron_corners();
  const auto adjacent = [&](std::size_t a, std::size_t b) {
    return corners[a].dot(corners[b]) > 0.4f;
  };
  std::size_t count = 0;
  for (std::size_t a = 0; a < corners.size(); ++a) {
    for (std::size_t b = a + 1; b < corners.size(); ++b) {
      for (std::size_t c = b + 1; c < corners.size(); ++c) {
        if (!adjacent(a, b) || !adjacent(b, c) || !adjacent(a, c)) continue;
        assert(count < icosahedron_faces);
        corners_[count] = {corners[a], corners[b], corners[c]};
        centers_[count] = (corners[a] + corners[b] + corners[c]).normalized();
        ++count;
      }
    }
  }
  assert(count == icosahedron_faces);
  // Each face is a neighbour of the one before, unless that has none left: of the nearest ones,
  // that which is nearest to the faces that are in order already leaves no gaps.
  for (std::size_t f = 1; f < icosahedron_faces; ++f) {
    const V3f& last = centers_[f - 1];
    V3f sum(0.0f);
    for (std::size_t g = 0; g < f; ++g) sum += centers_[g];
    constexpr float small = 1e-2f;  // against the distances between faces
    const auto closeness = [&](std::size_t g) {
      return centers_[g].dot(last) + small * centers_[g].dot(sum);
    };
    std::size_t next = f;
    for (std::size_t g = f + 1; g < icosahedron_faces; ++g) {
      if (closeness(g) > closeness(next)) next = g;
    }
    std::swap(corners_[f], corners_[next]);
    std::swap(centers_[f], centers_[next]);
  }

  // Neighbours are the three faces whose centres are nearest, and the planes half-way to them are
  // those through the edges.
  for (std::size_t f = 0; f < icosahedron_faces; ++f) {
    std::array<std::uint8_t, icosahedron_faces> order;
    for (std::size_t g = 0; g < icosahedron_faces; ++g) order[g] = static_cast<std::uint8_t>(g);
    std::sort(order.begin(), order.end(), [&](std::uint8_t g, std::uint8_t h) {
      return centers_[f].dot(centers_[g]) > centers_[f].dot(centers_[h]);
    });
    for (std::size_t i = 0; i < 3; ++i) {
      const V3f normal = (centers_[f] - centers_[order[i + 1]]).normalized();
      for (std::size_t axis = 0; axis < 3; ++axis)
        edges_[i][axis][f] = normal[static_cast<int>(axis)];
    }
  }

  // Parents have lower numbers than children.
  cuts_.resize(divided_faces);
  std::vector<Triangle> triangles(divided_faces);
  std::copy(corners_.begin(), corners_.end(), triangles.begin());
  for (std::uint32_t face = 0; face < divided_faces; ++face) {
    const Triangle& t = triangles[face];
    for (std::uint32_t i = 0; i < 3; ++i) {
      const V3f normal =
          midpoint(t[i], t[(i + 1) % 3]).cross(midpoint(t[i], t[(i + 2) % 3])).normalized();
      cuts_[face][i] = normal.dot(t[i]) > 0.0f ? normal : -normal;
    }
    for (std::uint32_t i = 0; i < 4 && child(face, i) < divided_faces; ++i)
      triangles[child(face, i)] = child_triangle(t, i);
  }
}

std::uint32_t Icosahedron::root_of(const V3f& direction) const {
  // By symmetry a face is where its centre is the nearest of all.
  std::uint32_t best = 0;
  float cosine = centers_[0].dot(direction);
  for (std::uint32_t f = 1; f < icosahedron_faces; ++f) {
    const float c = centers_[f].dot(direction);
    if (c > cosine) {
      best = f;
      cosine = c;
    }
  }
  return best;
}

std::uint32_t Icosahedron::face_of(const V3f& direction, int level) const {
  assert(level >= 0 && level <= deepest_face_level);
  std::uint32_t face = root_of(direction);
  for (int l = 0; l < level; ++l) face = child(face, child_of(face, direction));
  return face;
}

std::array<V3f, 3> Icosahedron::triangle(std::uint32_t face) const {
  if (face < icosahedron_faces) return corners_[face];
  const std::uint32_t parent = (face - icosahedron_faces) / 4;
  return child_triangle(triangle(parent), (face - icosahedron_faces) % 4);
}

DirectionCone Icosahedron::cone(const V3f& direction, float min_cosine) const {
  DirectionCone cone;
  cone.direction = direction;
  cone.min_cosine = min_cosine;
  const float cosine = min_cosine - rounding;
  constexpr float everything = 2.0f;
  cone.margin =
      cosine <= 0.0f ? everything : std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)) + rounding;
  const float x = direction.x, y = direction.y, z = direction.z, margin = cone.margin;
  std::uint32_t touched = (1u << icosahedron_faces) - 1;
  for (const std::array<Lane, 3>& normal : edges_) {
    Lane inside;
    for (std::size_t i = 0; i < padded_faces; ++i)
      inside[i] = normal[0][i] * x + normal[1][i] * y + normal[2][i] * z + margin;
    touched &= not_negative(inside);
  }
  for (; touched != 0; touched &= touched - 1)
    cone.roots[cone.root_count++] = static_cast<std::uint8_t>(std::countr_zero(touched));
  return cone;
}

const Icosahedron& icosahedron() {
  static const Icosahedron made;
  return made;
}

}  // namespace lumivec
