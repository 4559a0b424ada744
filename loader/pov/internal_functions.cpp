#include <algorithm>
#include <cmath>

#include "loader/pov/functions.h"
#include "loader/pov/noise.h"

namespace lumivec::pov {
namespace {

double torus(const V3d& p, double major, double minor) {
  return std::hypot(std::hypot(p.x, p.z) - major, p.y) - minor;
}

double rounded_box(const V3d& p, double radius, const V3d& half) {
  V3d outside;
  for (int i = 0; i < 3; ++i) outside[i] = std::max(std::abs(p[i]) - half[i] + radius, 0.0);
  return outside.length() - radius;
}

}  // namespace

// The numbers are those that the include file functions.inc gives names.
std::optional<Number> internal_function(int number, std::span<const double> a) {
  constexpr std::size_t point = 3;
  if (a.size() < point) return std::nullopt;
  const V3d p(a[0], a[1], a[2]);
  const auto parameter = [&](std::size_t i) { return point + i < a.size() ? a[point + i] : 0.0; };
  switch (number) {
    case 17:  // f_ellipsoid
      return Number(V3d(p.x * parameter(0), p.y * parameter(1), p.z * parameter(2)).length());
    case 45:  // f_paraboloid
      return Number(parameter(0) * (p.x * p.x - p.y + p.z * p.z));
    case 47:  // f_ph
      return Number(std::atan2(std::hypot(p.x, p.z), p.y));
    case 57:  // f_r
      return Number(p.length());
    case 60:  // f_rounded_box
      return Number(rounded_box(p, parameter(0), V3d(parameter(1), parameter(2), parameter(3))));
    case 61:  // f_sphere
      return Number(p.length() - parameter(0));
    case 69:  // f_th
      return Number(std::atan2(p.x, p.z));
    case 70:  // f_torus
      return Number(torus(p, parameter(0), parameter(1)));
    case 76:  // f_noise3d
      return Number(noise(p));
    default:
      return std::nullopt;
  }
}

}  // namespace lumivec::pov
