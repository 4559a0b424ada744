// Directional albedos of GGX boundaries, looked up by (cosθ, roughness), for energy compensation.
//
// Source: Kulla and Conty 2017, "Revisiting Physically Based Shading at Imageworks": what a single
// bounce loses is given back by a lobe whose size these albedos tell. A table takes about 2 ms to
// build and 10 ns to look up.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <vector>

#include "integrator/ggx_albedo.h"

namespace lumivec {

// A lobe is a delta lobe below this perceptual roughness: α is then under 1e-3, the reflection of a
// point under a tenth of a degree wide, and single precision begins to lose the half vector.
constexpr float delta_roughness = 0.03f;

constexpr float coat_index = 1.5f;

// A roughness as a place between two rows of a table; the same for all tables.
struct AlbedoRow {
  int row = 0;
  float fraction = 0.0f;  // of the way to the next row
};

// A cosine as a place between two columns of one table.
struct AlbedoColumn {
  int column = 0;
  float fraction = 0.0f;  // of the way to the next column
};

// Means over the cosine-weighted hemisphere of products with the albedo of a coat of index
// coat_index: what a light that diffuses below both boundaries loses in them.
struct CoatedAlbedo {
  float coat = 0.0f;       // of the coat alone
  float reflected = 0.0f;  // coat × Albedo::reflected, likewise the others
  float reflected_exact = 0.0f;
  float reflected_schlick = 0.0f;
};

// One index of refraction (beyond over before), seen from one side.
class AlbedoTable {
 public:
  explicit AlbedoTable(float eta);

  // Roughness in [delta_roughness, 1], or 0 for a smooth boundary.
  static AlbedoRow row_of(float roughness);

  float eta() const { return eta_; }

  // cos_theta in [0, 1].
  AlbedoColumn column_of(float cos_theta) const {
    const float place = column_place(std::min(cos_theta, 1.0f));
    const int column = std::min(static_cast<int>(place), columns_ - 2);
    return {column, place - column};
  }

  Albedo at(AlbedoColumn column, AlbedoRow row) const;

  // 2 ∫ at(μ) μ dμ over [0, 1], exact for the interpolated table: energy balances to rounding.
  Albedo average(AlbedoRow row) const;

  CoatedAlbedo coated_average(AlbedoRow row, AlbedoRow coat_row) const;

  // Draws a cosine with about the density of what a single bounce loses, (1 − Albedo::reflected) μ;
  // loss_pdf is the density of such directions in sr⁻¹, at most a few times off that. Not for row
  // 0.
  float sample_loss(float u, AlbedoRow row) const;
  float loss_pdf(AlbedoColumn column, AlbedoRow row) const;

  // Computes coated_average's table. coat: the table of the coat's index; may be *this.
  void multiply_with_coat(const AlbedoTable& coat);

 private:
  static constexpr int rows = 20;  // row 0 is smooth, the others run from delta_roughness to 1

  // An Albedo as numbers: mixing four of them is four instructions where they are vectors.
  struct alignas(Albedo) Node {
    std::array<float, sizeof(Albedo) / sizeof(float)> parts;
  };

  static AlbedoRow node_row(int row);  // no interpolation
  float column_place(float cos_theta) const;
  float cosine_of(float column) const;
  std::array<float, 3> cosines(int column) const;  // at, half way beyond and one beyond the column
  float lost(AlbedoRow row, int column) const;

  float eta_;
  int columns_;
  float critical_cosine_;  // at and below it reflection is total; 0 if it never is
  int critical_column_;    // whose cosine that is
  float beyond_scale_;  // of the map from cosines to columns, beyond and before the critical cosine
  float before_scale_;
  std::vector<Node> nodes_;  // rows × columns
  std::array<Albedo, rows> averages_;
  std::vector<float> lost_;  // rows × columns: 2 ∫ (1 − reflected) μ dμ up to the column's cosine
  std::vector<float> loss_density_;  // rows × columns: its mean slope to the next column, over 2π
  std::vector<CoatedAlbedo> coated_;  // rows × rows, by (row, coat's row)
};

// Columns are denser where albedos change fastest: at grazing incidence, and on both sides of the
// critical angle, where a dielectric's reflectance falls like a square root.
inline float AlbedoTable::column_place(float cos_theta) const {
  if (cos_theta >= critical_cosine_)
    return critical_column_ + std::sqrt((cos_theta - critical_cosine_) * beyond_scale_);
  const bool grazing = cos_theta < 0.5f * critical_cosine_;
  const float x = std::sqrt((grazing ? cos_theta : critical_cosine_ - cos_theta) * before_scale_);
  return grazing ? x : critical_column_ - x;
}

inline Albedo AlbedoTable::at(AlbedoColumn column, AlbedoRow row) const {
  const Node* const low = &nodes_[row.row * columns_ + column.column];
  const Node* const high = low + columns_;
  const float wd = column.fraction * row.fraction;
  const float wc = row.fraction - wd, wb = column.fraction - wd;
  const float wa = 1.0f - row.fraction - wb;
  Node sum;
  for (std::size_t i = 0; i < sum.parts.size(); ++i)
    sum.parts[i] =
        wa * low[0].parts[i] + wb * low[1].parts[i] + wc * high[0].parts[i] + wd * high[1].parts[i];
  return std::bit_cast<Albedo>(sum);
}

inline float AlbedoTable::loss_pdf(AlbedoColumn column, AlbedoRow row) const {
  const auto mix = [&](const std::vector<float>& values, int place) {
    const float* const low = &values[row.row * columns_ + place];
    return low[0] + row.fraction * (low[columns_] - low[0]);
  };
  const float all = mix(lost_, columns_ - 1);
  return all > 0.0f ? mix(loss_density_, column.column) / all : 0.0f;
}

// The tables of all boundaries that a scene can have, and of the coat. Immutable once built, so any
// threads may read it.
class AlbedoTables {
 public:
  // indices: the refraction indices n of the scene's materials. Tables are made of n and 1/n, and,
  // where there are few indices, of the ratios of each two, which boundaries within other media
  // have. 0 (all is reflected) and repetitions are welcome. Deterministic.
  explicit AlbedoTables(std::span<const float> indices);

  // The table of eta, or else that whose index has the ratio to it that is nearest to 1: what is
  // lost and given back is then off by as much as the two albedos differ. eta == 0: any, since
  // nothing but the parts that know no index is read.
  const AlbedoTable& nearest(float eta) const;

 private:
  std::vector<float> etas_;
  std::vector<AlbedoTable> tables_;
};

}  // namespace lumivec
