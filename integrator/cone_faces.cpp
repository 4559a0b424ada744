#include "integrator/cone_faces.h"

#include <bit>

namespace lumivec {

namespace {

using Ranges = std::array<ConeFaces::Range, ConeFaces::most_ranges>;

// In ascending order. False: there is no room for another range.
bool add_face(std::uint32_t face, Ranges& ranges, std::size_t& count) {
  if (count != 0 && ranges[count - 1].end == face) {
    ++ranges[count - 1].end;
    return true;
  }
  if (count == ranges.size()) return false;
  ranges[count++] = {static_cast<std::uint16_t>(face), static_cast<std::uint16_t>(face + 1)};
  return true;
}

}  // namespace

static_assert(Icosahedron::face_count(deepest_face_level) < (1u << 16));
static_assert(icosahedron_faces <= ConeFaces::most_ranges);

ConeFaces::ConeFaces(const DirectionCone& cone) : cone_(cone), found_(0) {
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < cone.root_count; ++i) add_face(cone.roots[i], ranges_[0], count);
  counts_[0] = static_cast<std::uint8_t>(count);
}

void ConeFaces::divide() {
  const auto level = static_cast<std::size_t>(found_);
  const Icosahedron& geometry = icosahedron();
  const std::uint32_t first = Icosahedron::first_face(found_);
  Ranges& finer = ranges_[level + 1];
  std::size_t count = 0;
  std::uint32_t faces = 0;
  for (std::size_t i = 0; i < counts_[level]; ++i)
    faces += static_cast<std::uint32_t>(ranges_[level][i].end - ranges_[level][i].begin);
  bool divided = faces <= most_faces;
  for (std::size_t i = 0; i < counts_[level] && divided; ++i) {
    for (std::uint32_t f = ranges_[level][i].begin; f < ranges_[level][i].end; ++f) {
      std::uint32_t touched = geometry.children_touched(first + f, cone_);
      for (; touched != 0 && divided; touched &= touched - 1)
        divided =
            add_face(4 * f + static_cast<std::uint32_t>(std::countr_zero(touched)), finer, count);
    }
  }
  if (!divided) {
    count = counts_[level];
    for (std::size_t i = 0; i < count; ++i) {
      finer[i] = {static_cast<std::uint16_t>(4 * ranges_[level][i].begin),
                  static_cast<std::uint16_t>(4 * ranges_[level][i].end)};
    }
  }
  counts_[level + 1] = static_cast<std::uint8_t>(count);
  ++found_;
}

}  // namespace lumivec
