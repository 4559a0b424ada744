#include "loader/pov/pattern_values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "loader/pov/functions.h"
#include "loader/pov/noise.h"

namespace lumivec::pov {
namespace {

constexpr double pi = std::numbers::pi;

// Points move against what moved the pattern, the last step first.
V3d pattern_point(const Pattern& pattern, V3d p, bool with_turbulence) {
  for (auto step = pattern.steps.rbegin(); step != pattern.steps.rend(); ++step) {
    if (step->kind == PatternStep::Kind::transform) {
      p = p * step->transform.inverse();
    } else if (step->kind == PatternStep::Kind::turbulence && with_turbulence) {
      const Turbulence turbulence{step->lambda, step->omega, static_cast<int>(step->octaves)};
      p += turbulence.at(p) * step->turbulence;
    }
  }
  return p;
}

double fraction(double x) {
  return x - std::floor(x);
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
  return std::min(sum, 1.0);
}

double checker(const V3d& p) {
  constexpr double off_the_face = 1e-9;  // of planes through whole numbers
  const double sum = std::floor(p.x + off_the_face) + std::floor(p.y + off_the_face) +
                     std::floor(p.z + off_the_face);
  return fraction(sum / 2.0) == 0.0 ? 0.0 : 1.0;
}

double turbulence_strength(const Pattern& pattern) {
  for (const PatternStep& step : pattern.steps) {
    if (step.kind == PatternStep::Kind::turbulence) return step.turbulence.x;
  }
  return 0.0;
}

std::optional<double> raw_value(const Pattern& pattern, const V3d& p) {
  switch (pattern.kind) {
    case K::checker_:
      return checker(p);
    case K::gradient_: {
      const V3d n = pattern.vector.normalized();
      return fraction(std::abs(p.x * n.x + p.y * n.y + p.z * n.z));
    }
    case K::onion_:
      return fraction(p.length());
    case K::wood_:
      return triangle_wave(std::hypot(p.x, p.y));
    case K::marble_:
      return triangle_wave(p.x + turbulence_strength(pattern) * Turbulence().at(p).x);
    case K::radial_:
      return fraction(0.25 + std::atan2(p.x, p.z) / (2.0 * pi));
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
    case K::granite_:
    case K::agate_:
    case K::wrinkles_:
    case K::dents_:
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
    case K::cubic_wave_: {
      const double t = triangle_wave(value);
      return t * t * (3.0 - 2.0 * t);
    }
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

// The entries around a value, and the share of the second.
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

}  // namespace

std::optional<double> pattern_value(const Pattern& pattern, const V3d& point) {
  const auto value = raw_value(pattern, pattern_point(pattern, point, pattern.kind != K::marble_));
  if (!value || pattern.kind == K::checker_) return value;
  return with_wave(pattern, *value);
}

ColorFT pigment_color(const Pigment& pigment, const V3d& point, bool& approximate) {
  if (pigment.image) {
    approximate = true;
    return mean_of(pigment, point, approximate);
  }
  if (pigment.pattern.kind == K::keyword_count) return pigment.color;
  const V3d inside = pattern_point(pigment.pattern, point, false);
  const auto value = pattern_value(pigment.pattern, point);
  if (!value) {
    approximate = true;
    return mean_of(pigment, inside, approximate);
  }
  if (pigment.pattern.kind == K::checker_) {
    const auto which = static_cast<std::size_t>(*value);
    if (which < pigment.pigments.size())
      return pigment_color(*pigment.pigments[which], inside, approximate);
    if (which < pigment.colors.size()) return pigment.colors[which];
    constexpr ColorFT usual[2] = {{0, 0, 1, 0, 0}, {0, 1, 0, 0, 0}};  // as the language has them
    return usual[which];
  }
  if (!pigment.pigment_map.empty()) {
    const auto [i, share] = place_in(pigment.pigment_map, *value);
    const ColorFT first = pigment_color(*pigment.pigment_map[i].second, inside, approximate);
    if (share == 0.0) return first;
    return mix(first, pigment_color(*pigment.pigment_map[i + 1].second, inside, approximate),
               share);
  }
  if (pigment.color_map.empty()) return {*value, *value, *value, 0.0, 0.0};
  const auto [i, share] = place_in(pigment.color_map, *value);
  if (share == 0.0) return pigment.color_map[i].second;
  return mix(pigment.color_map[i].second, pigment.color_map[i + 1].second, share);
}

}  // namespace lumivec::pov
