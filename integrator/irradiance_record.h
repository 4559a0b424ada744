// A view-independent light vector: the light that a term brings to a point, summed up for lobes
// that do not depend on the view, with what is needed to use it nearby.
//
// For such lobes the paper's magnitude is the length of D = ∫ L ω dω (eq. 2.2, 2.3), and D · n the
// irradiance. D is kept per channel. Beside it stands the flux Φ = ∫ L dω: how much longer it is
// than D says how much of the light comes from everywhere, which a tilted normal loses less of.
#pragma once

#include <array>
#include <cstdint>

#include "loader/scene.h"

namespace lumivec {

// Sums over directions, per channel; all linear in the radiance, so that estimates can be averaged.
struct LightSum {
  std::array<V3f, 3> vector = {V3f(0.0f), V3f(0.0f), V3f(0.0f)};  // ∫ L ω dω, cd·m⁻²·sr
  Color flux{0.0f};                                               // ∫ L dω, cd·m⁻²·sr

  void add(const Color& light, const V3f& direction) {
    for (std::size_t c = 0; c < 3; ++c) vector[c] += light[static_cast<int>(c)] * direction;
    flux += light;
  }
  // On the surface with this normal at which the sum was taken, lx. Not negative.
  Color irradiance(const V3f& normal) const {
    return {std::max(0.0f, vector[0].dot(normal)), std::max(0.0f, vector[1].dot(normal)),
            std::max(0.0f, vector[2].dot(normal))};
  }
};

// The light of a sum as a sky over the surface, evenly bright, and one source: the two that have
// the sum's vector and flux.
struct SkyAndSource {
  Color sky{0.0f};     // irradiance of the sky on the surface itself, lx
  Color source{0.0f};  // of the source on a facing surface, lx
  std::array<V3f, 3> direction = {V3f(0.0f), V3f(0.0f),
                                  V3f(0.0f)};  // unit, of each channel's source
  V3f mean_direction{0.0f, 0.0f, 1.0f};        // unit

  // Irradiance on a surface whose normal is bent from the one that the sky stands over. Exact, as
  // is its first derivative, where the normal is not bent; lx.
  Color sky_irradiance(const V3f& sky_normal, const V3f& normal) const {
    return sky * (0.5f * (1.0f + sky_normal.dot(normal)));
  }
  Color source_irradiance(const V3f& normal) const {
    return {source.x * std::max(0.0f, direction[0].dot(normal)),
            source.y * std::max(0.0f, direction[1].dot(normal)),
            source.z * std::max(0.0f, direction[2].dot(normal))};
  }
};

// sky_normal: unit, of the surface, all light being above it.
SkyAndSource split_light(const LightSum& sum, const V3f& sky_normal);

// What keeps a record from being used further away than its shorter half axis.
enum class RadiusLimit : std::uint8_t {
  curvature,  // the error of interpolation
  gradient,   // light would change too much
  distance,   // of what is seen from there
  darkness,   // no light was found, so that nothing is known of its changes
  neighbour,  // that of a record nearby
  pixel       // none: it is longer, so that neighbouring pixels share a record
};
constexpr std::size_t radius_limit_count = 6;

struct IrradianceRecord {
  V3f position{0.0f};  // traced space
  V3f normal{0.0f};    // unit, interpolated, before normal maps
  LightSum light;
  // Of the irradiance on the tangent plane, per channel, lx per scene unit; in the axes of
  // make_frame(normal).
  std::array<V2f, 3> gradient = {V2f(0.0f), V2f(0.0f), V2f(0.0f)};
  // Second derivatives of the channels' mean irradiance, likewise: xx, xy, yy.
  std::array<float, 3> curvature{};
  // The ellipse inside which the record holds, at a budget of 1 (see IrradianceCache): half axes in
  // scene units, and the direction of the shorter one, unit, in the tangent plane.
  float radius_small = 0.0f, radius_large = 0.0f;
  V3f axis{1.0f, 0.0f, 0.0f};
  // Distance along the surface to the nearest thing that stands there, by sectors of azimuth in the
  // same axes.
  static constexpr std::size_t sector_count = 8;
  std::array<float, sector_count> clearance{};
  float least_reach = 0.0f;    // how far it is looked for at least, at a budget of 1, scene units
  float mean_distance = 0.0f;  // harmonic mean distance to what was seen, scene units
  float variance = 0.0f;       // of the mean irradiance, relative to its square
  std::uint32_t passes = 0;    // hemispheres that have been averaged
  RadiusLimit limit = RadiusLimit::curvature;
};
static_assert(sizeof(IrradianceRecord) <= 200, "view-independent records stay small");

}  // namespace lumivec
