#include "integrator/albedo_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "integrator/fresnel.h"

namespace lumivec {

namespace {

constexpr int albedo_floats = sizeof(Albedo) / sizeof(float);

float* floats(Albedo& a) {
  return &a.reflected;
}
const float* floats(const Albedo& a) {
  return &a.reflected;
}

Albedo mix(const Albedo& a, const Albedo& b, float t) {
  Albedo result;
  for (int i = 0; i < albedo_floats; ++i)
    floats(result)[i] = floats(a)[i] + t * (floats(b)[i] - floats(a)[i]);
  return result;
}

CoatedAlbedo mix(const CoatedAlbedo& a, const CoatedAlbedo& b, float t) {
  return {std::lerp(a.coat, b.coat, t), std::lerp(a.reflected, b.reflected, t),
          std::lerp(a.reflected_exact, b.reflected_exact, t),
          std::lerp(a.reflected_schlick, b.reflected_schlick, t)};
}

// Gauss-Legendre with three points on [0, 1]: exact to degree 5. Between two columns albedos are
// linear and the cosine quadratic in the column, so that an average is of degree 4 and one of a
// product of degree 5.
constexpr std::array<float, 3> gauss_points = {0.11270166537925831f, 0.5f, 0.88729833462074169f};
constexpr std::array<float, 3> gauss_weights = {5.0f / 18.0f, 8.0f / 18.0f, 5.0f / 18.0f};

// f(column, weight) at points of a quadrature of 2 ∫ … μ dμ over a table's columns.
template <typename CosineOf, typename F>
void for_each_point(int columns, const CosineOf& cosine_of, const F& f) {
  for (int column = 0; column + 1 < columns; ++column) {
    const float low = cosine_of(static_cast<float>(column));
    const float high = cosine_of(static_cast<float>(column + 1));
    for (int i = 0; i < 3; ++i) {
      // μ is quadratic within the column: its slope follows from its values at both ends and in the
      // middle.
      const float middle = cosine_of(column + 0.5f);
      const float x = gauss_points[i];
      const float slope = (high - low) + (2.0f * x - 1.0f) * 2.0f * (low + high - 2.0f * middle);
      const float mu = cosine_of(column + x);
      f(column + x, mu, gauss_weights[i] * 2.0f * mu * slope);
    }
  }
}

}  // namespace

AlbedoTable::AlbedoTable(float eta)
    : eta_(eta),
      columns_(eta < 1.0f ? 49 : 32),
      critical_cosine_(eta < 1.0f ? std::sqrt((1.0f - eta) * (1.0f + eta)) : 0.0f),
      critical_column_(eta < 1.0f ? 24 : 0),
      nodes_(rows * columns_),
      lost_(rows * columns_),
      coated_(rows * rows) {
  const auto square = [](float x) { return x * x; };
  beyond_scale_ = square(columns_ - 1 - critical_column_) / (1.0f - critical_cosine_);
  before_scale_ =
      critical_cosine_ > 0.0f ? square(0.5f * critical_column_) / (0.5f * critical_cosine_) : 0.0f;
  for (int row = 0; row < rows; ++row) {
    const float y = static_cast<float>(row - 1) / (rows - 2);
    const float roughness = row == 0 ? 0.0f : delta_roughness + (1.0f - delta_roughness) * y * y;
    for (int column = 0; column < columns_; ++column)
      nodes_[row * columns_ + column] =
          ggx_albedo(cosine_of(static_cast<float>(column)), roughness * roughness, eta);
    for_each_point(
        columns_, [this](float column) { return cosine_of(column); },
        [&](float column, float, float weight) {
          const Albedo a = interpolate(row, column);
          for (int i = 0; i < albedo_floats; ++i)
            floats(averages_[row])[i] += weight * floats(a)[i];
          lost_[row * columns_ + static_cast<int>(column) + 1] +=
              weight * std::max(0.0f, 1.0f - a.reflected);
        });
    for (int column = 1; column < columns_; ++column)
      lost_[row * columns_ + column] += lost_[row * columns_ + column - 1];
  }
}

void AlbedoTable::multiply_with_coat(const AlbedoTable& coat) {
  const float f0 = normal_reflectance(coat.eta_);
  struct Point {
    float column, mu, weight;
  };
  std::vector<Point> points;
  for_each_point(
      columns_, [this](float column) { return cosine_of(column); },
      [&](float column, float mu, float weight) {
        points.push_back({column, mu, weight});
      });
  std::vector<Albedo> albedos(rows * points.size());
  std::vector<float> coat_albedos(rows * points.size());  // times the point's weight
  for (int row = 0; row < rows; ++row) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t place = row * points.size() + i;
      albedos[place] = interpolate(row, points[i].column);
      const Albedo c = coat.interpolate(row, coat.column_of(points[i].mu));
      coat_albedos[place] = points[i].weight * (f0 * c.reflected + (1.0f - f0) * c.reflected_exact);
    }
  }
  for (int row = 0; row < rows; ++row) {
    for (int coat_row = 0; coat_row < rows; ++coat_row) {
      CoatedAlbedo& sum = coated_[row * rows + coat_row];
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Albedo& a = albedos[row * points.size() + i];
        const float w = coat_albedos[coat_row * points.size() + i];
        sum.coat += w;
        sum.reflected += w * a.reflected;
        sum.reflected_exact += w * a.reflected_exact;
        sum.reflected_schlick += w * a.reflected_schlick;
      }
    }
  }
}

// Columns are denser where albedos change fastest: at grazing incidence, and on both sides of the
// critical angle, where a dielectric's reflectance falls like a square root.
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

float AlbedoTable::column_of(float cos_theta) const {
  if (cos_theta >= critical_cosine_)
    return critical_column_ + std::sqrt((cos_theta - critical_cosine_) * beyond_scale_);
  const bool grazing = cos_theta < 0.5f * critical_cosine_;
  const float x = std::sqrt((grazing ? cos_theta : critical_cosine_ - cos_theta) * before_scale_);
  return grazing ? x : critical_column_ - x;
}

Albedo AlbedoTable::interpolate(int row, float column) const {
  const int first = std::min(static_cast<int>(column), columns_ - 2);
  return mix(node(row, first), node(row, first + 1), column - first);
}

AlbedoRow AlbedoTable::row_of(float roughness) {
  if (roughness < delta_roughness) return {};
  const float y =
      std::sqrt((std::min(roughness, 1.0f) - delta_roughness) / (1.0f - delta_roughness));
  const float place = 1.0f + y * (rows - 2);
  const int row = std::min(static_cast<int>(place), rows - 2);
  return {row, place - row};
}

Albedo AlbedoTable::at(float cos_theta, AlbedoRow row) const {
  const float column = column_of(std::min(cos_theta, 1.0f));
  return mix(interpolate(row.row, column), interpolate(row.row + 1, column), row.fraction);
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
  return std::lerp(low[0], low[columns_], row.fraction);
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
  return std::lerp(cosine_of(static_cast<float>(first)), cosine_of(static_cast<float>(last)), t);
}

float AlbedoTable::loss_pdf(float cos_theta, AlbedoRow row) const {
  const float all = lost(row, columns_ - 1);
  if (all <= 0.0f) return 0.0f;
  const int first = std::min(static_cast<int>(column_of(std::min(cos_theta, 1.0f))), columns_ - 2);
  const float width = cosine_of(first + 1.0f) - cosine_of(static_cast<float>(first));
  return (lost(row, first + 1) - lost(row, first)) /
         (all * width * 2.0f * std::numbers::pi_v<float>);
}

AlbedoTables::AlbedoTables(std::span<const float> indices) {
  std::vector<float> etas = {coat_index, 1.0f / coat_index};
  for (const float n : indices) {
    if (!(n > 0.0f) || !std::isfinite(n)) continue;
    for (const float eta : {n, 1.0f / n})
      if (std::find(etas.begin(), etas.end(), eta) == etas.end()) etas.push_back(eta);
  }
  tables_.reserve(etas.size());
  for (const float eta : etas) tables_.emplace_back(eta);
  for (AlbedoTable& table : tables_) table.multiply_with_coat(tables_.front());
}

const AlbedoTable& AlbedoTables::nearest(float eta) const {
  if (!(eta > 0.0f)) return tables_.front();
  const AlbedoTable* best = &tables_.front();
  float best_ratio = std::numeric_limits<float>::infinity();
  for (const AlbedoTable& table : tables_) {
    const float ratio = std::max(table.eta() / eta, eta / table.eta());
    if (ratio < best_ratio) {
      best_ratio = ratio;
      best = &table;
    }
  }
  return *best;
}

}  // namespace lumivec
