// Patterns and pigments at points.
#pragma once

#include <optional>
#include <utility>

#include "loader/pov/pov_scene.h"

namespace lumivec::pov {

// None: the pattern is not one that can be evaluated. [0, 1] before waves; whole numbers for
// checker and its kind. spread: how far along each axis the point may be off the surface that is
// asked about, so that cells that meet in it are told apart.
std::optional<double> pattern_value(const Pattern& pattern, const V3d& point,
                                    const V3d& spread = V3d(0.0));

// Where the point lies for the pattern: against its transforms, turbulence and warps. None: they
// are not such that can be followed.
std::optional<V3d> pattern_place(const Pattern& pattern, const V3d& point);

// As written, without gamma. approximate becomes true where the pigment could not be followed.
ColorFT pigment_color(const Pigment& pigment, const V3d& point, bool& approximate,
                      const V3d& spread = V3d(0.0));

// Whether values of the pattern are whole numbers that choose from a list.
bool chooses(const Pattern& pattern);

// The entries of a blend map around a value, and the share of the second. The map is not empty.
template <class Map>
std::pair<std::size_t, double> place_in(const Map& map, double value) {
  if (value <= map.front().first) return {0, 0.0};
  for (std::size_t i = 0; i + 1 < map.size(); ++i) {
    if (value > map[i + 1].first) continue;
    const double width = map[i + 1].first - map[i].first;
    return {i, width > 0.0 ? (value - map[i].first) / width : 1.0};
  }
  return {map.size() - 1, 0.0};
}

}  // namespace lumivec::pov
