// When a cached light vector may be used at another point and for another view, and with which
// weight: the paper's section 4.2 to the letter.
//
//   |AB| < d_moy,   |AB| ΔE < E_B,   cos(N_A, N_B) > S_courb,   cos(ω, σ) > S_dir
//
//   p = (1 − |AB| / d_moy) · 1 / (1 + |AB| ΔE / E_B)
//       · (cos(N_A, N_B) − S_courb) / (1 − S_courb) · (cos(ω, σ) − S_dir) / (1 − S_dir)
//
// A few dozen operations a record.
#pragma once

#include "integrator/light_vector.h"
#include "integrator/settings.h"
#include "loader/scene.h"

namespace lumivec {

// A light vector with what its validity depends on: B, N_B and σ.
struct PaperRecord {
  V3f position{0.0f};
  V3f normal{0.0f, 0.0f, 1.0f};  // unit
  V3f view{0.0f, 0.0f, 1.0f};    // unit, to the eye
  LightVector light;
  float mean_distance = 0.0f;       // d_moy: to the other objects, scene units, ≥ 0
  float relative_variation = 0.0f;  // ΔE (eq. 2.6) over E, per scene unit, ≥ 0
};

// The first condition that a record fails, in the paper's order.
enum class PaperVerdict : std::uint8_t { valid, distant, varying, curved, other_view };
constexpr int paper_verdict_count = 5;

struct PaperValidity {
  PaperVerdict verdict = PaperVerdict::valid;
  float weight = 0.0f;  // p, (0, 1] if valid, otherwise 0
};

// Of a record at point A with its unit normal and the unit direction to the eye.
PaperValidity paper_validity(const PaperRecord& record, const V3f& position, const V3f& normal,
                             const V3f& view, const PaperParameters& parameters);

// The weighted mean of light vectors, as vectors: directions count by the light that they stand
// for. Records of form radiance, which have no direction, are averaged beside them.
class LightVectorMean {
 public:
  // weight: > 0.
  void add(const LightVector& v, float weight);

  int count() const { return count_; }
  // P, the mean of the weights (section 4.3); 0 of nothing.
  float mean_weight() const { return count_ == 0 ? 0.0f : weight_ / static_cast<float>(count_); }

  // The mean source of those that have a direction. What it causes and radiance() add up.
  LightVector light() const;
  // The share of the records of form radiance, W·sr⁻¹·m⁻².
  Color radiance() const;

 private:
  int count_ = 0;
  float weight_ = 0.0f;
  V3f vector_{0.0f};
  Color magnitude_{0.0f};
  Color radiance_{0.0f};
  V3f brightest_{0.0f, 0.0f, 1.0f};  // direction of the source with the most light
  float most_light_ = -1.0f;
};

}  // namespace lumivec
