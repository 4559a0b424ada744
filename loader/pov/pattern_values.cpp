#include "loader/pov/pattern_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "loader/pov/finiteness.h"
#include "loader/pov/functions.h"
#include "loader/pov/image_maps.h"
#include "loader/pov/noise.h"
#include "loader/pov/usual_color_maps.h"

namespace lumivec::pov {
namespace {

constexpr double pi = std::numbers::pi;

double fraction(double x) {
  return x - std::floor(x);
}

struct PatternPoint {
  V3d at{0.0};
  V3d spread{0.0};  // along each axis, for cells that meet in the surface
};

V3d option(const PatternStep& warp, K name, const V3d& usual) {
  for (const auto& [key, value] : warp.options) {
    if (key == name) return value;
  }
  return usual;
}

// Tiles along axes; what is done to them grows from one to the next.
V3d repeated(const PatternStep& warp, V3d p) {
  const V3d offset = option(warp, K::offset_, V3d(0.0)), flip = option(warp, K::flip_, V3d(0.0));
  for (int i = 0; i < 3; ++i) {
    const double width = std::abs(warp.vectors[0][i]);
    if (!(width > 0.0)) continue;
    const double tile = std::floor(p[i] / width);
    p[i] -= tile * width;
    if (std::fmod(tile, 2.0) != 0.0) {
      for (int k = 0; k < 3; ++k) {
        if (flip[k] != 0.0) p[k] = (k == i ? width : 0.0) - p[k];
      }
    }
    p += offset * tile;
  }
  return p;
}

// Points inside a ball move away from its middle, or towards it.
V3d black_hole(const PatternStep& warp, const V3d& p) {
  const double radius = warp.vectors[1].x;
  const V3d repeat = option(warp, K::repeat_, V3d(0.0));
  V3d middle = warp.vectors[0];
  for (int i = 0; i < 3; ++i) {
    if (repeat[i] != 0.0) middle[i] += std::floor(p[i] / repeat[i]) * repeat[i];
  }
  const V3d off = p - middle;
  const double distance = off.length();
  if (!(distance < radius)) return p;
  const double strength = option(warp, K::strength_, V3d(1.0)).x;
  const double falloff = option(warp, K::falloff_, V3d(2.0)).x;
  const double share = std::min(strength * std::pow(1.0 - distance / radius, falloff), 1.0);
  const bool inverse = option(warp, K::inverse_, V3d(0.0)).x != 0.0;
  return p + off * (inverse ? -share : share);
}

// A pattern in the plane of x and y, laid round: turns and heights in place of x and y, and what is
// left in place of z. Turns around the y axis, from the x axis on.
V3d laid_round(const PatternStep& warp, const V3d& p) {
  const double stretch = option(warp, K::dist_exp_, V3d(0.0)).x;
  const double across = std::hypot(p.x, p.z);
  const double turns = fraction(std::atan2(p.z, p.x) / (2.0 * pi));
  V3d at(turns, p.y, across);
  if (warp.warp == K::spherical_) {
    at.z = p.length();
    at.y = 0.5 + std::atan2(p.y, across) / pi;
  } else if (warp.warp == K::toroidal_) {
    const double off = across - option(warp, K::major_radius_, V3d(1.0)).x;
    at.z = std::hypot(off, p.y);
    at.y = 0.5 + std::atan2(p.y, off) / (2.0 * pi);
  }
  if (stretch != 0.0) {
    const double by = std::pow(at.z, stretch);
    at.x *= by;
    if (warp.warp != K::cylindrical_) at.y *= by;
  }
  return at;
}

// One of a plane's points for all.
V3d pressed_flat(const PatternStep& warp, const V3d& p) {
  const V3d distance = warp.vectors.size() > 1 ? warp.vectors[1] : V3d(0.0);
  return {p.x, p.y, distance.x};
}

// From a pattern that faces the z axis to one that faces another.
V3d facing(const V3d& axis, const V3d& p) {
  if (std::abs(axis.x) > std::abs(axis.y) && std::abs(axis.x) > std::abs(axis.z))
    return {p.z, p.y, -p.x};
  if (std::abs(axis.y) > std::abs(axis.z)) return {p.x, -p.z, p.y};
  return p;
}

V3d warped(const PatternStep& warp, const V3d& p) {
  constexpr V3d z(0.0, 0.0, 1.0);
  switch (warp.warp) {
    case K::repeat_:
      return repeated(warp, p);
    case K::black_hole_:
      return black_hole(warp, p);
    case K::planar_:
      return facing(warp.vectors.empty() ? z : warp.vectors[0], pressed_flat(warp, p));
    default:
      return facing(option(warp, K::orientation_, z), laid_round(warp, p));
  }
}

// Points move against what moved the pattern, the last step first.
PatternPoint pattern_point(const Pattern& pattern, PatternPoint p, bool with_turbulence) {
  for (auto step = pattern.steps.rbegin(); step != pattern.steps.rend(); ++step) {
    if (step->kind == PatternStep::Kind::transform) {
      const M44d inverse = step->transform.inverse();
      p.at = p.at * inverse;
      inverse.multDirMatrix(p.spread, p.spread);
    } else if (step->kind == PatternStep::Kind::turbulence) {
      if (!with_turbulence) continue;
      const Turbulence turbulence{step->lambda, step->omega, static_cast<int>(step->octaves)};
      p.at += turbulence.at(p.at) * step->turbulence;
    } else if (step->warp == K::turbulence_) {
      const Turbulence turbulence{step->lambda, step->omega, static_cast<int>(step->octaves)};
      p.at += turbulence.at(p.at) * step->turbulence;
    } else {
      p.at = warped(*step, p.at);
    }
  }
  if (!fits_float(p.at)) p.at = V3d(0.0);  // where warps reach no end
  return p;
}

// Cubes are not laid round, and black holes not disturbed.
bool follows(const PatternStep& warp) {
  switch (warp.warp) {
    case K::repeat_:
      return warp.vectors.size() == 1;
    case K::black_hole_:
      return warp.vectors.size() == 2 && warp.turbulence == V3d(0.0);
    case K::turbulence_:
    case K::planar_:
    case K::cylindrical_:
    case K::spherical_:
    case K::toroidal_:
      return true;
    default:
      return false;
  }
}

bool follows_warps(const Pattern& pattern) {
  return std::all_of(pattern.steps.begin(), pattern.steps.end(), [](const PatternStep& step) {
    return step.kind != PatternStep::Kind::warp || follows(step);
  });
}

double triangle_wave(double x) {
  const double f = fraction(x);
  return f < 0.5 ? 2.0 * f : 2.0 - 2.0 * f;
}

// Sums of finer and finer noise, as granite and its kind are.
double rough_noise(const V3d& p) {
  double sum = 0.0, frequency = 1.0;
  for (int i = 0; i < 6; ++i, frequency *= 2.0)
    sum += std::abs(0.5 - noise(p * (4.0 * frequency))) / frequency;
  constexpr double contrast = 2.0;  // to the mean brightness that POV-Ray's granite has
  return std::min(contrast * sum, 1.0);
}

double cell(const PatternPoint& p, int axis) {
  constexpr double off_the_face = 1e-9;  // of planes through whole numbers
  return std::floor(p.at[axis] + std::max(off_the_face, std::abs(p.spread[axis])));
}

double checker(const PatternPoint& p) {
  const double sum = cell(p, 0) + cell(p, 1) + cell(p, 2);
  return fraction(sum / 2.0) == 0.0 ? 0.0 : 1.0;
}

double parameter(const Pattern& pattern, K name, double usual) {
  for (const auto& [key, value] : pattern.parameters) {
    if (key == name) return value;
  }
  return usual;
}

// 0: mortar, 1: brick. Mortar lies at the upper ends of each brick; each second row is shifted by
// half a brick along x.
double brick(const Pattern& pattern, const PatternPoint& p) {
  const V3d size = pattern.vector == V3d(0.0) ? V3d(8.0, 3.0, 4.5) : pattern.vector;
  const double mortar = parameter(pattern, K::mortar_, 0.5);
  V3d at;
  for (int i = 0; i < 3; ++i) {
    if (size[i] == 0.0) return 1.0;
    at[i] = (p.at[i] + std::max(1e-9, std::abs(p.spread[i]))) / size[i];
  }
  const bool odd_row = fraction(std::floor(at.y) / 2.0) != 0.0;
  if (odd_row) at.x += 0.5;
  for (int i = 0; i < 3; ++i) {
    if ((1.0 - fraction(at[i])) * std::abs(size[i]) <= mortar) return 0.0;
  }
  return 1.0;
}

// Three colors of hexagons with sides of length 1 around the y axis: the nearest point of a
// triangular lattice says which.
double hexagon(const V3d& p) {
  constexpr double root_3 = std::numbers::sqrt3;
  const double column = p.x / 1.5, row = p.z / root_3 - column / 2.0;
  double best = std::numeric_limits<double>::infinity(), color = 0.0;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) {
      const double c = std::floor(column) + i, r = std::floor(row) + j;
      const double distance = std::hypot(c * 1.5 - p.x, (r + c / 2.0) * root_3 - p.z);
      if (distance >= best) continue;
      best = distance;
      color = std::round(fraction((r - c) / 3.0) * 3.0);
    }
  }
  return std::clamp(color, 0.0, 2.0);
}

// [0, 1), without relation between neighbours.
double random_of(const V3d& cell, double which) {
  const double mixed =
      std::sin(cell.x * 12.9898 + cell.y * 78.233 + cell.z * 37.719 + which * 4.581);
  return fraction(mixed * 43758.5453);
}

// One point in each unit cube; form weighs the distances to the three nearest.
double crackle(const Pattern& pattern, const V3d& p) {
  double form[3] = {-1.0, 1.0, 0.0};
  std::size_t given = 0;
  for (const auto& [key, value] : pattern.parameters) {
    if (key == K::form_ && given < 3) form[given++] = value;
  }
  const double metric = parameter(pattern, K::metric_, 2.0);
  const V3d home(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  constexpr double far = 1e9;
  double nearest[3] = {far, far, far};
  for (int i = 0; i < 125; ++i) {
    const V3d cube = home + V3d(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2);
    const V3d d = cube + V3d(random_of(cube, 0.0), random_of(cube, 1.0), random_of(cube, 2.0)) - p;
    double distance = 0.0;
    if (metric == 2.0) {
      distance = d.length();
    } else if (metric == 1.0) {
      distance = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
    } else {
      distance = std::pow(std::pow(std::abs(d.x), metric) + std::pow(std::abs(d.y), metric) +
                              std::pow(std::abs(d.z), metric),
                          1.0 / metric);
    }
    for (double& held : nearest) {
      if (distance < held) std::swap(distance, held);
    }
  }
  return std::clamp(form[0] * nearest[0] + form[1] * nearest[1] + form[2] * nearest[2], 0.0, 1.0);
}

// Bands along z, bent by turbulence of their own.
double agate(const Pattern& pattern, const V3d& p) {
  const double strength = parameter(pattern, K::agate_turb_, 1.0);
  const double bent = 1.1 * p.z + 1.3 * strength * Turbulence().at(p).x;
  return 0.5 + 0.5 * std::sin(2.0 * pi * bent);
}

double cube_noise(const V3d& p) {
  const double n = noise(p);
  return n * n * n;
}

// Sums of finer and finer noise without its creases.
double wrinkles(const V3d& p) {
  double sum = 0.0, strength = 1.0, total = 0.0, frequency = 1.0;
  for (int i = 0; i < 10; ++i, strength *= 0.5, frequency *= 2.0) {
    sum += strength * noise(p * frequency);
    total += strength;
  }
  return sum / total;
}

// How soon points leave the disc of radius 2 under z -> z² + c, as a share of the most rounds; 1:
// they do not.
std::optional<double> escape(const Pattern& pattern, const V3d& p) {
  const bool mandel = pattern.kind == K::mandel_;
  const std::vector<double>& n = pattern.numbers;
  if (n.size() != (mandel ? 1u : 3u) || pattern.frequency != 1.0) return std::nullopt;
  for (const auto& [key, value] : pattern.parameters) {
    if (key == K::exponent_ || key == K::interior_ || key == K::exterior_) return std::nullopt;
  }
  const auto rounds = static_cast<int>(std::clamp(n.back(), 1.0, 1e4));
  Imath::V2d z(p.x, p.y);
  const Imath::V2d c = mandel ? z : Imath::V2d(n[0], n[1]);
  for (int i = 0; i < rounds; ++i) {
    z = Imath::V2d(z.x * z.x - z.y * z.y + c.x, 2.0 * z.x * z.y + c.y);
    if (z.x * z.x + z.y * z.y > 4.0) return double(i) / rounds;
  }
  return 1.0;
}

double turbulence_strength(const Pattern& pattern) {
  for (const PatternStep& step : pattern.steps) {
    if (step.kind == PatternStep::Kind::turbulence) return step.turbulence.x;
  }
  return 0.0;
}

std::optional<double> raw_value(const Pattern& pattern, const PatternPoint& point) {
  const V3d& p = point.at;
  switch (pattern.kind) {
    case K::checker_:
      return checker(point);
    case K::brick_:
      return brick(pattern, point);
    case K::hexagon_:
      return hexagon(p);
    case K::crackle_:
      return crackle(pattern, p);
    case K::cells_:
      return random_of({cell(point, 0), cell(point, 1), cell(point, 2)}, 0.0);
    case K::pigment_pattern_: {
      if (!pattern.pigment) return std::nullopt;
      bool approximate = false;
      const ColorFT c = pigment_color(*pattern.pigment, p, approximate, point.spread);
      if (approximate) return std::nullopt;
      return 0.297 * c.red + 0.589 * c.green + 0.114 * c.blue;  // grey, as the language has it
    }
    case K::gradient_: {
      const V3d n = pattern.vector.normalized();
      return fraction(p.x * n.x + p.y * n.y + p.z * n.z);
    }
    case K::onion_:
      return fraction(p.length());
    case K::wood_:
      return triangle_wave(std::hypot(p.x, p.y));
    case K::marble_:
      return triangle_wave(p.x + turbulence_strength(pattern) * Turbulence().at(p).x);
    case K::radial_:
      return fraction(0.25 + std::atan2(p.x, p.z) / (2.0 * pi));
    case K::spiral1_: {
      if (pattern.numbers.empty()) return std::nullopt;
      const double turns = 0.25 + std::atan2(p.y, p.x) / (2.0 * pi);
      return triangle_wave(pattern.numbers[0] * turns + std::hypot(p.x, p.y));
    }
    case K::mandel_:
    case K::julia_:
      return escape(pattern, p);
    case K::planar_:
      return 1.0 - std::min(std::abs(p.y), 1.0);
    case K::cylindrical_:
      return 1.0 - std::min(std::hypot(p.x, p.z), 1.0);
    case K::spherical_:
      return 1.0 - std::min(p.length(), 1.0);
    case K::boxed_:
      return 1.0 - std::min(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1.0);
    case K::leopard_: {
      const double sum = (std::sin(p.x) + std::sin(p.y) + std::sin(p.z)) / 3.0;
      return sum * sum;
    }
    case K::bozo_:
    case K::spotted_:
    case K::bumps_:
      return noise(p);
    case K::agate_:
      return agate(pattern, p);
    case K::wrinkles_:
      return wrinkles(p);
    case K::dents_:
      return cube_noise(p);
    case K::granite_:
      return rough_noise(p);
    case K::function_: {
      const double arguments[3] = {p.x, p.y, p.z};
      if (!pattern.function) return std::nullopt;
      std::uint64_t nodes_left = most_nodes_a_point;
      const auto value = evaluate(*pattern.function, arguments, nodes_left);
      return value ? std::optional(fraction(value->n[0])) : std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

double with_wave(const Pattern& pattern, double value) {
  if (pattern.frequency != 1.0 || pattern.phase != 0.0)
    value = fraction(value * pattern.frequency + pattern.phase);
  switch (pattern.wave) {
    case K::triangle_wave_:
      return triangle_wave(value);
    case K::sine_wave_:
      return 0.5 + 0.5 * std::sin(2.0 * pi * value);
    case K::scallop_wave_:
      return std::abs(std::sin(pi * value));
    case K::cubic_wave_:
      return value * value * (3.0 - 2.0 * value);
    case K::poly_wave_:
      return std::pow(std::max(value, 0.0), pattern.wave_exponent);
    default:
      return value;
  }
}

ColorFT mix(const ColorFT& a, const ColorFT& b, double share) {
  const auto between = [&](double x, double y) { return x + (y - x) * share; };
  return {between(a.red, b.red), between(a.green, b.green), between(a.blue, b.blue),
          between(a.filter, b.filter), between(a.transmit, b.transmit)};
}

ColorFT mean_of(const Pigment& pigment, const V3d& p, bool& approximate) {
  ColorFT sum;
  double count = 0.0;
  const auto add = [&](const ColorFT& c) { sum = mix(sum, c, 1.0 / ++count); };
  for (const auto& [value, color] : pigment.color_map) add(color);
  for (const auto& [value, part] : pigment.pigment_map) add(pigment_color(*part, p, approximate));
  for (const ColorFT& color : pigment.colors) add(color);
  for (const auto& part : pigment.pigments) add(pigment_color(*part, p, approximate));
  constexpr double middle = 0.5;
  return count > 0.0 ? sum : ColorFT{middle, middle, middle, 0.0, 0.0};
}

// By the shares that the map says.
ColorFT weighted_mean(const Pigment& pigment, const PatternPoint& p, bool& approximate) {
  ColorFT sum;
  double total = 0.0;
  const auto add = [&](double weight, const ColorFT& c) {
    if (weight <= 0.0) return;
    total += weight;
    sum = mix(sum, c, weight / total);
  };
  for (const auto& [weight, color] : pigment.color_map) add(weight, color);
  for (const auto& [weight, part] : pigment.pigment_map)
    add(weight, pigment_color(*part, p.at, approximate, p.spread));
  return sum;
}

// The language's own colors of lists that say fewer.
ColorFT usual_choice(K kind, std::size_t which) {
  constexpr ColorFT blue{0, 0, 1, 0, 0}, green{0, 1, 0, 0, 0}, red{1, 0, 0, 0, 0};
  constexpr ColorFT mortar{0.5, 0.5, 0.5, 0, 0}, brick{0.6, 0.15, 0.15, 0, 0};
  if (kind == K::brick_) return which == 0 ? mortar : brick;
  return which == 0 ? blue : which == 1 ? green : red;
}

}  // namespace

bool chooses(const Pattern& pattern) {
  return pattern.kind == K::checker_ || pattern.kind == K::brick_ || pattern.kind == K::hexagon_;
}

std::optional<V3d> pattern_place(const Pattern& pattern, const V3d& point) {
  if (!follows_warps(pattern)) return std::nullopt;
  return pattern_point(pattern, {point, V3d(0.0)}, true).at;
}

std::optional<double> pattern_value(const Pattern& pattern, const V3d& point, const V3d& spread) {
  if (!follows_warps(pattern)) return std::nullopt;
  const auto value =
      raw_value(pattern, pattern_point(pattern, {point, spread}, pattern.kind != K::marble_));
  if (!value || chooses(pattern)) return value;
  return with_wave(pattern, *value);
}

ColorFT pigment_color(const Pigment& pigment, const V3d& point, bool& approximate,
                      const V3d& spread) {
  if (pigment.image) {
    const auto color = pigment.uv_mapping || !follows_warps(pigment.pattern)
                           ? std::nullopt
                           : image_color(*pigment.image,
                                         pattern_point(pigment.pattern, {point, spread}, false).at);
    if (color) return *color;
    approximate = true;
    return mean_image_color(*pigment.image);
  }
  if (pigment.pattern.kind == K::keyword_count) return pigment.color;
  const PatternPoint inside = pattern_point(pigment.pattern, {point, spread}, false);
  if (pigment.pattern.kind == K::average_) return weighted_mean(pigment, inside, approximate);
  const auto value = pattern_value(pigment.pattern, point, spread);
  if (!value) {
    approximate = true;
    return mean_of(pigment, inside.at, approximate);
  }
  const auto part = [&](const Pigment& inner) {
    return pigment_color(inner, inside.at, approximate, inside.spread);
  };
  if (chooses(pigment.pattern)) {
    const auto which = static_cast<std::size_t>(*value);
    if (which < pigment.pigments.size()) return part(*pigment.pigments[which]);
    if (which < pigment.colors.size()) return pigment.colors[which];
    return usual_choice(pigment.pattern.kind, which);
  }
  if (!pigment.pigment_map.empty()) {
    const auto [i, share] = place_in(pigment.pigment_map, *value);
    const ColorFT first = part(*pigment.pigment_map[i].second);
    if (share == 0.0) return first;
    return mix(first, part(*pigment.pigment_map[i + 1].second), share);
  }
  const ColorMap& map =
      pigment.color_map.empty() ? usual_color_map(pigment.pattern.kind) : pigment.color_map;
  if (map.empty()) return {*value, *value, *value, 0.0, 0.0};
  const auto [i, share] = place_in(map, *value);
  if (share == 0.0) return map[i].second;
  return mix(map[i].second, map[i + 1].second, share);
}

}  // namespace lumivec::pov
