#include "integrator/albedo_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "integrator/fresnel.h"

namespace lumivec {

namespace {

// a + w · b
Albedo sum(const Albedo& a, float w, const Albedo& b) {
  return {.reflected = a.reflected + w * b.reflected,
          .reflected_exact = a.reflected_exact + w * b.reflected_exact,
          .reflected_schlick = a.reflected_schlick + w * b.reflected_schlick,
          .reflected_total = a.reflected_total + w * b.reflected_total,
          .transmitted = a.transmitted + w * b.transmitted,
          .transmitted_exact = a.transmitted_exact + w * b.transmitted_exact};
}

Albedo mix(const Albedo& a, const Albedo& b, float t) {
  return sum(sum({}, 1.0f - t, a), t, b);
}

float mix(float a, float b, float t) {
  return a + t * (b - a);
}

CoatedAlbedo mix(const CoatedAlbedo& a, const CoatedAlbedo& b, float t) {
  return {mix(a.coat, b.coat, t), mix(a.reflected, b.reflected, t),
          mix(a.reflected_exact, b.reflected_exact, t),
          mix(a.reflected_schlick, b.reflected_schlick, t)};
}

// Interpolation is then off by 1e-3 (root mean square), as is the quadrature of the nodes.
constexpr int columns_without = 32;
constexpr int columns_with_critical_angle = 49;  // half of them, of even number, on each side of it

// Gauss-Legendre with three points on [0, 1]: exact to degree 5. Between two columns albedos are
// linear and the cosine quadratic in the column, so that an average is of degree 4 and one of a
// product of degree 5.
constexpr std::array<float, 3> gauss_points = {0.11270166537925831f, 0.5f, 0.88729833462074169f};
constexpr std::array<float, 3> gauss_weights = {5.0f / 18.0f, 8.0f / 18.0f, 5.0f / 18.0f};

// f(column, weight of 2 ∫ … μ dμ) at the points of the quadrature between two cosines, middle being
// that half way.
template <typename F>
void for_each_point(float low, float middle, float high, const F& f) {
  for (int i = 0; i < 3; ++i) {
    const float x = gauss_points[i];
    const float bend = 2.0f * (low + high - 2.0f * middle);
    const float slope = (high - low) + (2.0f * x - 1.0f) * bend;
    const float mu = low + x * ((high - low) + (x - 1.0f) * bend);
    f(x, mu, gauss_weights[i] * 2.0f * mu * slope);
  }
}

}  // namespace

AlbedoTable::AlbedoTable(float eta)
    : eta_(eta),
      columns_(eta < 1.0f ? columns_with_critical_angle : columns_without),
      critical_cosine_(eta < 1.0f ? std::sqrt((1.0f - eta) * (1.0f + eta)) : 0.0f),
      critical_column_(eta < 1.0f ? columns_with_critical_angle / 2 : 0),
      nodes_(rows * columns_),
      lost_(rows * columns_),
      loss_density_(rows * columns_),
      coated_(rows * rows) {
  const auto square = [](float x) { return x * x; };
  beyond_scale_ = square(columns_ - 1 - critical_column_) / (1.0f - critical_cosine_);
  before_scale_ =
      critical_cosine_ > 0.0f ? square(0.5f * critical_column_) / (0.5f * critical_cosine_) : 0.0f;
  for (int row = 0; row < rows; ++row) {
    const float y = static_cast<float>(row - 1) / (rows - 2);
    const float roughness = row == 0 ? 0.0f : delta_roughness + (1.0f - delta_roughness) * y * y;
    for (int column = 0; column < columns_; ++column)
      nodes_[row * columns_ + column] = std::bit_cast<Node>(
          ggx_albedo(cosine_of(static_cast<float>(column)), roughness * roughness, eta));
    for (int column = 0; column + 1 < columns_; ++column) {
      float lost = 0.0f;
      const auto [low, middle, high] = cosines(column);
      for_each_point(low, middle, high, [&](float x, float, float weight) {
        const Albedo a = at({column, x}, node_row(row));
        averages_[row] = sum(averages_[row], weight, a);
        lost += weight * std::max(0.0f, 1.0f - a.reflected);
      });
      const int place = row * columns_ + column;
      lost_[place + 1] = lost_[place] + lost;
      loss_density_[place] = lost / ((high - low) * 2.0f * std::numbers::pi_v<float>);
    }
  }
}

std::array<float, 3> AlbedoTable::cosines(int column) const {
  return {cosine_of(static_cast<float>(column)), cosine_of(column + 0.5f),
          cosine_of(column + 1.0f)};
}

void AlbedoTable::multiply_with_coat(const AlbedoTable& coat) {
  const float f0 = normal_reflectance(coat.eta_);
  const std::size_t points = 3 * static_cast<std::size_t>(columns_ - 1);
  std::vector<Albedo> albedos;
  std::vector<float> coat_albedos;  // times the points' weights
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column + 1 < columns_; ++column) {
      const auto [low, middle, high] = cosines(column);
      for_each_point(low, middle, high, [&](float x, float mu, float weight) {
        albedos.push_back(at({column, x}, node_row(row)));
        const Albedo c = coat.at(coat.column_of(mu), node_row(row));
        coat_albedos.push_back(weight * (f0 * c.reflected + (1.0f - f0) * c.reflected_exact));
      });
    }
  }
  for (int row = 0; row < rows; ++row) {
    for (int coat_row = 0; coat_row < rows; ++coat_row) {
      CoatedAlbedo& sum = coated_[row * rows + coat_row];
      for (std::size_t i = 0; i < points; ++i) {
        const Albedo& a = albedos[row * points + i];
        const float w = coat_albedos[coat_row * points + i];
        sum.coat += w;
        sum.reflected += w * a.reflected;
        sum.reflected_exact += w * a.reflected_exact;
        sum.reflected_schlick += w * a.reflected_schlick;
      }
    }
  }
}

// Inverse of column_place.
float AlbedoTable::cosine_of(float column) const {
  if (column >= critical_column_) {
    const float x = (column - critical_column_) / (columns_ - 1 - critical_column_);
    return critical_cosine_ + (1.0f - critical_cosine_) * x * x;
  }
  const float half = 0.5f * critical_column_;
  const bool grazing = column < half;
  const float x = (grazing ? column : critical_column_ - column) / half;
  const float distance = 0.5f * critical_cosine_ * x * x;
  return grazing ? distance : critical_cosine_ - distance;
}

AlbedoRow AlbedoTable::row_of(float roughness) {
  if (roughness < delta_roughness) return {};
  const float y =
      std::sqrt((std::min(roughness, 1.0f) - delta_roughness) / (1.0f - delta_roughness));
  const float place = 1.0f + y * (rows - 2);
  const int row = std::min(static_cast<int>(place), rows - 2);
  return {row, place - row};
}

AlbedoRow AlbedoTable::node_row(int row) {
  return row + 1 < rows ? AlbedoRow{row, 0.0f} : AlbedoRow{row - 1, 1.0f};
}

Albedo AlbedoTable::average(AlbedoRow row) const {
  return mix(averages_[row.row], averages_[row.row + 1], row.fraction);
}

CoatedAlbedo AlbedoTable::coated_average(AlbedoRow row, AlbedoRow coat_row) const {
  const CoatedAlbedo* const low = &coated_[row.row * rows + coat_row.row];
  const CoatedAlbedo* const high = low + rows;
  return mix(mix(low[0], low[1], coat_row.fraction), mix(high[0], high[1], coat_row.fraction),
             row.fraction);
}

float AlbedoTable::lost(AlbedoRow row, int column) const {
  const float* const low = &lost_[row.row * columns_ + column];
  return mix(low[0], low[columns_], row.fraction);
}

float AlbedoTable::sample_loss(float u, AlbedoRow row) const {
  const float target = u * lost(row, columns_ - 1);
  int first = 0, last = columns_ - 1;
  while (last - first > 1) {
    const int middle = (first + last) / 2;
    (lost(row, middle) <= target ? first : last) = middle;
  }
  const float below = lost(row, first);
  const float mass = lost(row, last) - below;
  const float t = mass > 0.0f ? std::clamp((target - below) / mass, 0.0f, 1.0f) : 0.5f;
  return mix(cosine_of(static_cast<float>(first)), cosine_of(static_cast<float>(last)), t);
}

AlbedoTables::AlbedoTables(std::span<const float> indices) {
  // With more indices than this, pairs of them are too many for the time they take: 64 tables are a
  // tenth of a second.
  constexpr std::size_t few = 8;
  std::vector<float> known = {coat_index};
  const auto add = [](std::vector<float>& to, float value) {
    if (std::find(to.begin(), to.end(), value) == to.end()) to.push_back(value);
  };
  for (const float n : indices)
    if (n > 0.0f && std::isfinite(n)) add(known, n);
  for (const float n : known) {
    add(etas_, n);
    add(etas_, 1.0f / n);
  }
  if (known.size() <= few) {
    for (const float n : known)
      for (const float m : known)
        if (n != m) add(etas_, n / m);
  }
  tables_.reserve(etas_.size());
  for (const float eta : etas_) tables_.emplace_back(eta);
  for (AlbedoTable& table : tables_) table.multiply_with_coat(tables_.front());
}

const AlbedoTable& AlbedoTables::nearest(float eta) const {
  const auto place = [this](auto i) -> const AlbedoTable& {
    return tables_[static_cast<std::size_t>(i - etas_.begin())];
  };
  const auto exact = std::find(etas_.begin(), etas_.end(), eta);
  if (exact != etas_.end()) return place(exact);
  if (!(eta > 0.0f)) return tables_.front();
  const auto ratio = [eta](float other) { return std::max(other / eta, eta / other); };
  return place(std::min_element(etas_.begin(), etas_.end(),
                                [&](float a, float b) { return ratio(a) < ratio(b); }));
}

}  // namespace lumivec
