#include "loader/pov/noise.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace lumivec::pov {
namespace {

std::uint32_t hash(std::int64_t x, std::int64_t y, std::int64_t z, std::uint32_t seed) {
  std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^
                    static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu ^
                    static_cast<std::uint64_t>(z) * 0x165667b19e3779f9u ^ seed;
  h ^= h >> 32;
  h *= 0xd6e8feb86659fd93u;
  h ^= h >> 32;
  return static_cast<std::uint32_t>(h);
}

// One of twelve directions to the middles of a cube's edges, times d.
double gradient(std::uint32_t h, const V3d& d) {
  const double u = (h & 4) ? d.y : d.x;
  const double v = (h & 8) ? d.x + d.y - u : d.z;
  return ((h & 1) ? -u : u) + ((h & 2) ? -v : v);
}

double fade(double t) {
  return t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
}

// [-1, 1]
double signed_noise(const V3d& p, std::uint32_t seed) {
  constexpr double farthest = 1e15;  // beyond, cells are not told apart
  if (!(std::abs(p.x) < farthest && std::abs(p.y) < farthest && std::abs(p.z) < farthest))
    return 0.0;
  const V3d cell(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const V3d d = p - cell;
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const V3d o(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const V3d from = d - o;
    const double weight =
        fade(1.0 - std::abs(from.x)) * fade(1.0 - std::abs(from.y)) * fade(1.0 - std::abs(from.z));
    sum += weight * gradient(hash(static_cast<std::int64_t>(cell.x + o.x),
                                  static_cast<std::int64_t>(cell.y + o.y),
                                  static_cast<std::int64_t>(cell.z + o.z), seed),
                             from);
  }
  return std::clamp(sum, -1.0, 1.0);
}

}  // namespace

double noise(const V3d& p) {
  return 0.5 + 0.5 * signed_noise(p, 0);
}

V3d vector_noise(const V3d& p) {
  return {signed_noise(p, 1), signed_noise(p, 2), signed_noise(p, 3)};
}

V3d Turbulence::at(const V3d& p) const {
  V3d sum(0.0);
  double scale = 1.0, strength = 1.0;
  constexpr int most_octaves = 10;  // as many as the language has
  for (int i = 0; i < std::clamp(octaves, 1, most_octaves); ++i) {
    sum += vector_noise(p * scale) * strength;
    scale *= lambda;
    strength *= omega;
  }
  return sum;
}

}  // namespace lumivec::pov
