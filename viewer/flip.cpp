#include "viewer/flip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "integrator/parallel.h"
#include "viewer/separable_filter.h"

namespace lumivec {
namespace {

constexpr std::size_t pixels_at_once = 4096;

constexpr float pi = std::numbers::pi_v<float>;

// CIE XYZ of linear Rec. 709 (IEC 61966-2-1) and of its white, (1, 1, 1).
V3f xyz(const Color& c) {
  return {0.4123908f * c.x + 0.3575843f * c.y + 0.1804808f * c.z,
          0.2126390f * c.x + 0.7151687f * c.y + 0.0721923f * c.z,
          0.0193308f * c.x + 0.1191948f * c.y + 0.9505322f * c.z};
}

Color linear_rgb(const V3f& v) {
  return {3.2409699f * v.x - 1.5373832f * v.y - 0.4986108f * v.z,
          -0.9692436f * v.x + 1.8759675f * v.y + 0.0415551f * v.z,
          0.0556301f * v.x - 0.2039770f * v.y + 1.0569715f * v.z};
}

float srgb_to_linear(float v) {
  if (!(v > 0.0f)) return 0.0f;  // NaN too
  if (v >= 1.0f) return 1.0f;
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

// Section 4.1: an opponent space that is linear in light, so that it may be filtered.
V3f ycxcz(const V3f& v) {
  const V3f white = xyz(Color(1.0f));
  const V3f n = v / white;
  return {116.0f * n.y - 16.0f, 500.0f * (n.x - n.y), 200.0f * (n.y - n.z)};
}

V3f xyz_of_ycxcz(const V3f& v) {
  const V3f white = xyz(Color(1.0f));
  const float y = (v.x + 16.0f) / 116.0f;
  return V3f(y + v.y / 500.0f, y, y - v.z / 200.0f) * white;
}

// Section 4.1.2: CIE L*a*b*, the chromatic axes scaled by lightness (Hunt effect).
V3f hunt_adjusted_lab(const Color& c) {
  const V3f white = xyz(Color(1.0f));
  const V3f n = xyz(c) / white;
  const auto f = [](float t) {
    constexpr float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
  };
  const float fy = f(n.y);
  const float lightness = 116.0f * fy - 16.0f;
  const float hunt = 0.01f * lightness;
  return {lightness, hunt * 500.0f * (f(n.x) - fy), hunt * 200.0f * (fy - f(n.z))};
}

// Large colour differences add up over lightness and chroma (equation 8).
float hyab(const V3f& a, const V3f& b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

constexpr float color_exponent = 0.7f;    // q_c
constexpr float feature_exponent = 0.5f;  // q_f
constexpr float knee = 0.4f;              // p_c: up to this share of the largest difference …
constexpr float knee_value = 0.95f;       // p_t: … the error rises to this

// Compresses the perceptual difference to [0, 1] (section 4.1.3).
float color_error(const V3f& a, const V3f& b, float largest) {
  const float difference = std::pow(hyab(a, b), color_exponent);
  const float cut = knee * largest;
  if (difference < cut) return knee_value / cut * difference;
  return knee_value + (difference - cut) / (largest - cut) * (1.0f - knee_value);
}

// The contrast sensitivity functions of the three axes, in the spatial domain: a sum of Gaussians
// a √(π/b) exp(−π²x²/b), x in degrees (table 1).
struct Sensitivity {
  float a1, b1, a2, b2;
};
constexpr std::array<Sensitivity, 3> sensitivities = {{
    {1.0f, 0.0047f, 0.0f, 1e-5f},  // achromatic
    {1.0f, 0.0053f, 0.0f, 1e-5f},  // red-green
    {34.1f, 0.04f, 13.5f, 0.025f}  // blue-yellow
}};
constexpr float widest_b = 0.04f;

std::vector<float> sensitivity_gaussian(float b, int radius, float pixels_per_degree) {
  return sampled_kernel(radius, [=](float pixels) {
    const float degrees = pixels / pixels_per_degree;
    return std::exp(-pi * pi * degrees * degrees / b);
  });
}

// The plane as the eye's contrast sensitivity lets it through.
Plane filter_by_sensitivity(const Plane& plane, const Sensitivity& s, float pixels_per_degree) {
  const int radius =
      int(std::ceil(3.0f * std::sqrt(widest_b / (2.0f * pi * pi)) * pixels_per_degree));
  const auto gaussian = [&](float a, float b, float& weight) {
    std::vector<float> kernel = sensitivity_gaussian(b, radius, pixels_per_degree);
    const float sum = std::accumulate(kernel.begin(), kernel.end(), 0.0f);
    for (float& k : kernel) k /= sum;
    weight = a * std::sqrt(pi / b) * sum * sum;  // of this Gaussian in the kernel of both
    return convolved(plane, kernel, kernel);
  };
  float weight1 = 0.0f, weight2 = 0.0f;
  Plane result = gaussian(s.a1, s.b1, weight1);
  if (s.a2 == 0.0f) return result;
  const Plane second = gaussian(s.a2, s.b2, weight2);
  const float share = weight2 / (weight1 + weight2);
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] += share * (second.values[i] - result.values[i]);
  }
  return result;
}

// Section 4.2: edges and points, by the first and second derivative of a Gaussian as wide as a
// small feature.
struct Features {
  std::vector<float> edge;   // length of the filtered gradient
  std::vector<float> point;  // and of the second derivatives
};

Features find_features(const Plane& luminance, float pixels_per_degree) {
  constexpr float feature_width = 0.082f;  // degrees
  const float sigma = 0.5f * feature_width * pixels_per_degree;
  const int radius = int(std::ceil(3.0f * sigma));
  const auto gauss = [=](float x) { return std::exp(-x * x / (2.0f * sigma * sigma)); };

  std::vector<float> smooth = sampled_kernel(radius, gauss);
  normalize_signs(smooth);
  std::vector<float> first = sampled_kernel(radius, [=](float x) { return -x * gauss(x); });
  normalize_signs(first);
  std::vector<float> second =
      sampled_kernel(radius, [=](float x) { return (x * x / (sigma * sigma) - 1.0f) * gauss(x); });
  normalize_signs(second);

  const auto length = [&](const std::vector<float>& derivative) {
    const Plane across = convolved(luminance, derivative, smooth);
    const Plane down = convolved(luminance, smooth, derivative);
    std::vector<float> lengths(across.values.size());
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      lengths[i] = std::hypot(across.values[i], down.values[i]);
    }
    return lengths;
  };
  return {length(first), length(second)};
}

// What one picture brings to the comparison.
struct Seen {
  std::vector<V3f> lab;  // Hunt-adjusted, filtered
  Features features;
};

Seen see(const Picture& picture, float pixels_per_degree) {
  const std::size_t count = picture.pixels.size();
  std::array<Plane, 3> planes;
  planes.fill(Plane(picture.width, picture.height));
  Plane luminance(picture.width, picture.height);
  for_each_in_groups(count, pixels_at_once, [&](std::size_t i) {
    const Color& c = picture.pixels[i];
    const Color linear(srgb_to_linear(c.x), srgb_to_linear(c.y), srgb_to_linear(c.z));
    const V3f opponent = ycxcz(xyz(linear));
    for (int axis = 0; axis < 3; ++axis) planes[std::size_t(axis)].values[i] = opponent[axis];
    luminance.values[i] = (opponent.x + 16.0f) / 116.0f;
  });
  Seen seen;
  seen.features = find_features(luminance, pixels_per_degree);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    planes[axis] = filter_by_sensitivity(planes[axis], sensitivities[axis], pixels_per_degree);
  }
  seen.lab.resize(count);
  for_each_in_groups(count, pixels_at_once, [&](std::size_t i) {
    Color c =
        linear_rgb(xyz_of_ycxcz({planes[0].values[i], planes[1].values[i], planes[2].values[i]}));
    for (int k = 0; k < 3; ++k) c[k] = std::clamp(c[k], 0.0f, 1.0f);
    seen.lab[i] = hunt_adjusted_lab(c);
  });
  return seen;
}

}  // namespace

std::vector<float> flip_map(const Picture& reference, const Picture& test,
                            float pixels_per_degree) {
  assert(reference.width == test.width && reference.height == test.height);
  const Seen a = see(reference, pixels_per_degree);
  const Seen b = see(test, pixels_per_degree);
  // No two colours of the display are further apart than its green and its blue.
  const float largest =
      std::pow(hyab(hunt_adjusted_lab({0.0f, 1.0f, 0.0f}), hunt_adjusted_lab({0.0f, 0.0f, 1.0f})),
               color_exponent);
  std::vector<float> errors(reference.pixels.size());
  for_each_in_groups(errors.size(), pixels_at_once, [&](std::size_t i) {
    const float edge = std::abs(a.features.edge[i] - b.features.edge[i]);
    const float point = std::abs(a.features.point[i] - b.features.point[i]);
    const float feature =
        std::pow(std::max(edge, point) / std::numbers::sqrt2_v<float>, feature_exponent);
    const float color = color_error(a.lab[i], b.lab[i], largest);
    errors[i] = std::clamp(std::pow(color, 1.0f - std::min(feature, 1.0f)), 0.0f, 1.0f);
  });
  return errors;
}

double mean(const std::vector<float>& values) {
  if (values.empty()) return 0.0;
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

}  // namespace lumivec
