#include "loader/pov/bumps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "loader/pov/noise.h"
#include "loader/pov/pattern_values.h"

namespace lumivec::pov {
namespace {

constexpr double pi = std::numbers::pi;
// What POV-Ray's bumps are like, as measured on its pictures of planes: patterns bend normals by
// this share of their slope, in the pattern's own units whatever its scale.
constexpr double share_of_slope = 2.0 / 15.0;
constexpr double least_accuracy = 1e-6;
// Its noise is a little gentler.
constexpr double share_of_noise_slope = 0.83;

V3d unit_or(const V3d& v, const V3d& otherwise) {
  const double length = v.length();
  return length > 0.0 && std::isfinite(length) ? v / length : otherwise;
}

// A plane's normal where points move by m.
V3d moved_normal(const V3d& normal, const M44d& m) {
  V3d moved;
  m.inverse().transposed().multDirMatrix(normal, moved);
  return moved;
}

// The slope of noise, which POV-Ray's bumps follow.
V3d noise_slope(const V3d& p) {
  constexpr double step = 1e-3;
  V3d slope;
  for (int i = 0; i < 3; ++i) {
    V3d off(0.0);
    off[i] = step;
    slope[i] = (noise(p + off) - noise(p - off)) / (2.0 * step);
  }
  return slope;
}

V3d wrinkle(const V3d& p) {
  constexpr int octaves = 10;
  V3d sum(0.0);
  double strength = 1.0;
  for (int i = 0; i < octaves; ++i, strength *= 0.5) {
    const V3d slope = noise_slope(p / strength) * strength;
    sum += V3d(std::abs(slope.x), std::abs(slope.y), std::abs(slope.z));
  }
  return sum;
}

// Waves on water from a few places near the origin: of one length, or of many.
V3d water(const Normal& normal, const V3d& p, bool many_lengths) {
  constexpr int sources = 10;
  // What makes them as strong as POV-Ray's.
  constexpr double ripple = 0.24, wave = 0.08;
  V3d sum(0.0);
  for (int i = 0; i < sources; ++i) {
    const double n = i + 1;
    const V3d source = unit_or(vector_noise(V3d(3.7 * n + 0.31, 5.3 * n + 0.17, 7.1 * n + 0.43)),
                               V3d(1.0, 0.0, 0.0));
    const V3d off = p - source;
    const double distance = std::max(off.length(), 1e-9);
    const double frequency = many_lengths ? 0.1 * n : 1.0;
    const double turns = distance * normal.pattern.frequency * frequency + normal.pattern.phase;
    sum += off * (std::sin(2.0 * pi * turns) / (frequency * distance));
  }
  return sum * (many_lengths ? wave : ripple);
}

double control(const Normal& normal, K name) {
  for (const auto& [key, value] : normal.pattern.parameters) {
    if (key == name) return value;
  }
  return 1.0;
}

// A cushion in each unit cube.
V3d quilt(const Normal& normal, const V3d& p) {
  V3d off;
  for (int i = 0; i < 3; ++i) off[i] = p[i] - std::floor(p[i]) - 0.5;
  const double t = off.length(), s = 1.0 - t;
  const double height = 3.0 * s * s * t * control(normal, K::control0_) +
                        3.0 * s * t * t * control(normal, K::control1_) + t * t * t;
  return off * (2.0 / std::numbers::sqrt3 * height);
}

// Heights and slopes along the values of a pattern.
double mapped_height(const Normal& normal, double value) {
  if (normal.slope_map.empty()) return value;
  const auto [i, share] = place_in(normal.slope_map, value);
  const auto& [from, first] = normal.slope_map[i];
  if (share == 0.0) return first[0];
  const auto& [to, second] = normal.slope_map[i + 1];
  const double t = share, width = to - from;
  const double t2 = t * t, t3 = t2 * t;
  return first[0] * (2.0 * t3 - 3.0 * t2 + 1.0) + first[1] * width * (t3 - 2.0 * t2 + t) +
         second[0] * (3.0 * t2 - 2.0 * t3) + second[1] * width * (t3 - t2);
}

class Bend {
 public:
  explicit Bend(bool& approximate) : approximate_(approximate) {}

  V3d by(const Normal& normal, const V3d& point, const V3d& before) {
    M44d to_texture;
    for (const PatternStep& step : normal.pattern.steps) {
      if (step.kind == PatternStep::Kind::transform) to_texture *= step.transform;
    }
    const M44d to_pattern = to_texture.inverse();
    V3d n = moved_normal(before, to_pattern);
    if (!normal.no_bump_scale) n = unit_or(n, V3d(0.0, 1.0, 0.0));
    const V3d after = moved_normal(inside(normal, point, n, to_texture, to_pattern), to_texture);
    return unit_or(after, before);
  }

 private:
  // n: in the pattern's space, as the result.
  V3d inside(const Normal& normal, const V3d& point, const V3d& n, const M44d& to_texture,
             const M44d& to_pattern) {
    const auto part = [&](const Normal& inner) { return by(inner, point * to_pattern, n); };
    if (normal.image || normal.uv_mapping) return left_alone(n);
    if (normal.pattern.kind == K::average_) {
      V3d sum(0.0);
      for (const auto& [weight, inner] : normal.normal_map) sum += part(*inner) * weight;
      return unit_or(sum, n);
    }
    if (!normal.normal_map.empty() || !normal.normals.empty()) {
      const auto value = pattern_value(normal.pattern, point);
      if (!value) return left_alone(n);
      if (!normal.normals.empty()) {
        const auto which = static_cast<std::size_t>(std::max(*value, 0.0));
        return part(*normal.normals[std::min(which, normal.normals.size() - 1)]);
      }
      const auto [i, share] = place_in(normal.normal_map, *value);
      const V3d first = part(*normal.normal_map[i].second);
      if (share == 0.0) return first;
      return first * (1.0 - share) + part(*normal.normal_map[i + 1].second) * share;
    }
    const std::optional<V3d> place = pattern_place(normal.pattern, point);
    if (!place) return left_alone(n);
    switch (normal.pattern.kind) {
      case K::bumps_:
        return n + noise_slope(*place) * (share_of_noise_slope * normal.amount);
      case K::dents_: {
        const double deep = noise(*place);
        return n + noise_slope(*place) * (normal.amount * deep * deep * deep);
      }
      case K::wrinkles_:
        return n + wrinkle(*place) * (share_of_noise_slope * normal.amount);
      case K::ripples_:
        return n + water(normal, *place, false) * normal.amount;
      case K::waves_:
        return n + water(normal, *place, true) * normal.amount;
      case K::quilted_:
        return n + quilt(normal, *place) * normal.amount;
      default:
        return n - slope(normal, point, to_texture) * (share_of_slope * normal.amount);
    }
  }

  // Of the pattern's values, in its own space, from the corners of a small tetrahedron.
  V3d slope(const Normal& normal, const V3d& point, const M44d& to_texture) {
    constexpr std::array<std::array<double, 3>, 4> corners = {
        {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};
    const double reach = std::max(std::abs(normal.accuracy), least_accuracy) / std::sqrt(3.0);
    V3d sum(0.0);
    for (const auto& c : corners) {
      const V3d corner(c[0], c[1], c[2]);
      V3d off;
      to_texture.multDirMatrix(corner * reach, off);
      const auto value = pattern_value(normal.pattern, point + off);
      if (!value) {
        approximate_ = true;
        return V3d(0.0);
      }
      sum += corner * mapped_height(normal, *value);
    }
    return sum / (4.0 * reach);
  }

  V3d left_alone(const V3d& n) {
    approximate_ = true;
    return n;
  }

  bool& approximate_;
};

}  // namespace

V3d bent_normal(const Texture& texture, const V3d& point, const V3d& normal, bool& approximate) {
  V3d bent = unit_or(normal, V3d(0.0, 1.0, 0.0));
  for (const TextureLayer& layer : texture.layers) {
    if (!layer.has_normal && layer.textures.empty()) continue;
    const M44d to_layer = layer.transform.inverse();
    const V3d at = point * to_layer, before = moved_normal(normal, to_layer);
    V3d after = before;
    if (layer.textures.empty()) {
      after = Bend(approximate).by(layer.normal, at, before);
    } else {
      const auto of = [&](std::size_t i) {
        const auto& chosen = layer.textures[std::min(i, layer.textures.size() - 1)].second;
        return chosen ? bent_normal(*chosen, at, before, approximate) : before;
      };
      const std::optional<double> value = pattern_value(layer.pattern, at);
      if (!value) {
        after = of(0);
      } else if (chooses(layer.pattern)) {
        after = of(static_cast<std::size_t>(*value));
      } else {
        const auto [i, share] = place_in(layer.textures, *value);
        after = of(i);
        if (share > 0.0) after = after * (1.0 - share) + of(i + 1) * share;
      }
    }
    bent = unit_or(moved_normal(after, layer.transform), bent);
  }
  return bent;
}

bool has_bumps(const Texture& texture) {
  return std::any_of(texture.layers.begin(), texture.layers.end(), [](const TextureLayer& layer) {
    return layer.has_normal ||
           std::any_of(layer.textures.begin(), layer.textures.end(),
                       [](const auto& entry) { return entry.second && has_bumps(*entry.second); });
  });
}

}  // namespace lumivec::pov
