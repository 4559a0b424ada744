#include "integrator/ggx_albedo.h"

#include <array>

#include "integrator/fresnel.h"
#include "integrator/ggx.h"

namespace lumivec {

namespace {

constexpr int lanes = 8;  // of a vector register
constexpr int sample_count =
    512;  // horizon and total reflection are kinks: errors fall as 1/N, to about 1e-3
constexpr float smallest_cosine = 1e-7f;  // keeps the quotients of an index of 1 from 0/0

// Points of the unit square that turn by the golden section while they climb: all heights differ,
// as do all azimuths. Heights are of [0, 1], azimuths come as cosine and sine.
struct Lattice {
  alignas(32) std::array<float, sample_count> height, cosine, sine;
};

Lattice make_lattice() {
  Lattice lattice;
  for (int i = 0; i < sample_count; ++i) {
    const double turn = std::numbers::phi * i;
    const double azimuth = 2.0 * std::numbers::pi * (turn - std::floor(turn));
    lattice.height[i] = static_cast<float>((i + 0.5) / sample_count);
    lattice.cosine[i] = static_cast<float>(std::cos(azimuth));
    lattice.sine[i] = static_cast<float>(std::sin(azimuth));
  }
  return lattice;
}

}  // namespace

Albedo ggx_albedo(float cos_o, float alpha, float eta) {
  if (alpha == 0.0f) return smooth_albedo(cos_o, eta);
  static const Lattice lattice = make_lattice();
  cos_o = std::max(cos_o, min_view_cosine);
  const float a2 = alpha * alpha;
  const float sin_o = std::sqrt(std::max(0.0f, 1.0f - cos_o * cos_o));
  const float root_o = smith_root(cos_o, alpha);
  const float stretch = 1.0f / root_o;  // |(α sin, cos)| is the root
  const float ox = alpha * sin_o * stretch;
  const float oz = cos_o * stretch;
  const float inv_eta = 1.0f / eta;
  const float eta2_minus_1 = (eta - 1.0f) * (eta + 1.0f);
  const float f0 = normal_reflectance(eta);
  const float inv_rise = 1.0f / std::max(1.0f - f0, 1e-6f);

  // The steps of sample_visible_normal and fresnel_shape, without branches, so that compilers
  // vectorise them.
  float sums[6][lanes] = {};
  for (int i = 0; i < sample_count; i += lanes) {
    for (int k = 0; k < lanes; ++k) {
      const float up = lattice.height[i + k] * (1.0f + oz);
      const float z = up - oz;
      const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
      const float hx = alpha * (ox + r * lattice.cosine[i + k]);
      const float hy = alpha * r * lattice.sine[i + k];
      const float inv_length = 1.0f / std::sqrt(hx * hx + hy * hy + up * up);
      const float hz = up * inv_length;
      const float c =
          std::max(smallest_cosine, std::min(1.0f, sin_o * hx * inv_length + cos_o * hz));
      // Fresnel; in total reflection both quotients become 1 in absolute value.
      const float cos_t = std::sqrt(std::max(0.0f, eta2_minus_1 + c * c)) * inv_eta;
      const float total = cos_t > 0.0f ? 0.0f : 1.0f;
      const float parallel = (eta * c - cos_t) / (eta * c + cos_t);
      const float perpendicular = (c - eta * cos_t) / (c + eta * cos_t);
      const float exact =
          (0.5f * (parallel * parallel + perpendicular * perpendicular) - f0) * inv_rise;
      const float x = 1.0f - c;
      const float schlick = x * x * x * x * x;
      // Value over density of the visible normals: G2 / G1(o), and G1(i) for transmission.
      const float reflected = std::max(0.0f, 2.0f * c * hz - cos_o);
      const float root_r = std::sqrt(a2 + (1.0f - a2) * reflected * reflected);
      const float w = reflected * (cos_o + root_o) / (cos_o * root_r + reflected * root_o);
      const float refracted = std::max(0.0f, cos_o * inv_eta - (c * inv_eta - cos_t) * hz);
      const float root_t = std::sqrt(a2 + (1.0f - a2) * refracted * refracted);
      const float v = (1.0f - total) * 2.0f * refracted / (refracted + root_t);
      sums[0][k] += w;
      sums[1][k] += w * exact;
      sums[2][k] += w * schlick;
      sums[3][k] += w * total;
      sums[4][k] += v;
      sums[5][k] += v * exact;
    }
  }
  Albedo mean;
  float* const values[6] = {&mean.reflected,       &mean.reflected_exact, &mean.reflected_schlick,
                            &mean.reflected_total, &mean.transmitted,     &mean.transmitted_exact};
  for (int j = 0; j < 6; ++j) {
    float sum = 0.0f;
    for (float lane : sums[j]) sum += lane;
    *values[j] = sum / sample_count;
  }
  return mean;
}

}  // namespace lumivec
