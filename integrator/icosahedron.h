// The icosahedron's recursive division of the unit sphere: 20 triangles, each of which falls into
// four at the midpoints of its edges, pushed to the sphere (paper, section 3.2). Which face is a
// direction in, and which faces does a cone of directions touch?
//
// Faces are told apart by planes through the sphere's centre, and a direction on a plane belongs to
// one side of it: every direction is in exactly one face of a level. A level costs three dot
// products, the first one twenty.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "loader/scene.h"

namespace lumivec {

// Of the undivided icosahedron; its faces are numbered 0 … 19, and the children of face f
// 20 + 4f … 20 + 4f + 3, so that numbers go up with the level.
constexpr std::uint32_t icosahedron_faces = 20;
// Faces of this level are 2° wide: directions that are closer together than that are too few and
// too much alike to be told apart, since no lobe that is cached is much narrower.
constexpr int deepest_face_level = 5;
// Faces that have children: all levels above the deepest.
constexpr std::uint32_t divided_faces =
    icosahedron_faces * ((1u << (2 * deepest_face_level)) - 1) / 3;

// The directions within an angle of one.
struct DirectionCone {
  V3f direction{0.0f, 0.0f, 1.0f};  // unit
  float min_cosine = 1.0f;          // of the angle, [-1, 1]
  // Sine of the angle, and more than any plane distance if it is above 90°; rounding included.
  float margin = 0.0f;
  std::uint32_t root_count = 0;
  std::array<std::uint8_t, icosahedron_faces> roots{};  // faces of the icosahedron that it touches
};

class Icosahedron {
 public:
  Icosahedron();

  // The face of the undivided icosahedron that a unit direction is in.
  std::uint32_t root_of(const V3f& direction) const;
  // Which of the four children of a face, 0 … 3, a direction inside it is in. face < divided_faces.
  std::uint32_t child_of(std::uint32_t face, const V3f& direction) const {
    const Cut& cut = cuts_[face];
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      if (cut[corner].dot(direction) > 0.0f) return corner_child(corner);
    }
    return middle_child;
  }
  // The face of a level, [0, deepest_face_level], that a unit direction is in.
  std::uint32_t face_of(const V3f& direction, int level) const;

  // The faces of a level have consecutive numbers, those of the next one that are inside them too.
  static constexpr std::uint32_t first_face(int level) {
    return icosahedron_faces * ((1u << (2 * level)) - 1) / 3;
  }
  static constexpr std::uint32_t face_count(int level) { return icosahedron_faces << (2 * level); }
  // Of the children, the one in the middle is next to two others: what a cone touches has mostly
  // consecutive numbers.
  static constexpr std::uint32_t middle_child = 2;
  static constexpr std::uint32_t corner_child(std::uint32_t corner) {
    return corner < middle_child ? corner : corner + 1;
  }
  static constexpr std::uint32_t child(std::uint32_t face, std::uint32_t which) {
    return icosahedron_faces + 4 * face + which;
  }
  // The corners of a face.
  std::array<V3f, 3> triangle(std::uint32_t face) const;

  // The directions around a unit one whose cosine with it is min_cosine or more, in [-1, 1].
  DirectionCone cone(const V3f& direction, float min_cosine) const;
  // Bit i: the cone touches child i of a face that it touches; conservative. face < divided_faces.
  std::uint32_t children_touched(std::uint32_t face, const DirectionCone& cone) const {
    const Cut& cut = cuts_[face];
    std::uint32_t mask = 1u << middle_child;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const float distance = cut[corner].dot(cone.direction);
      if (distance >= -cone.margin) mask |= 1u << corner_child(corner);
      if (distance > cone.margin) mask &= ~(1u << middle_child);
    }
    return mask;
  }

 private:
  // Normals of the planes that cut the three corners off a face, pointing to the corners. What is
  // left is the child in the middle.
  using Cut = std::array<V3f, 3>;

  // The planes to the three neighbours of each face, by coordinates; there is room for as many
  // faces as a loop handles at once.
  static constexpr std::size_t width = 8;
  static constexpr std::size_t padded_faces = (icosahedron_faces + width - 1) / width * width;
  using Lane = std::array<float, padded_faces>;

  std::array<std::array<V3f, 3>, icosahedron_faces> corners_;
  std::array<V3f, icosahedron_faces> centers_;
  std::array<std::array<Lane, 3>, 3> edges_{};
  std::vector<Cut> cuts_;
};

// Made at the first call, in under a millisecond; 250 KB.
const Icosahedron& icosahedron();

}  // namespace lumivec
