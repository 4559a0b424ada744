#include "integrator/environment_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "integrator/sampling.h"

namespace lumivec {
namespace {

float mean(const Color& c) {
  return (c.x + c.y + c.z) * (1.0f / 3.0f);
}

// The interval of a cumulative distribution (first 0, last 1) that u falls in, and where in it.
int find_interval(const float* cdf, int count, float u, float& fraction) {
  const float* above = std::upper_bound(cdf, cdf + count + 1, u);
  const int i = std::clamp(static_cast<int>(above - cdf) - 1, 0, count - 1);
  const float width = cdf[i + 1] - cdf[i];
  fraction = width > 0.0f ? std::clamp((u - cdf[i]) / width, 0.0f, 0x1.fffffep-1f) : 0.5f;
  return i;
}

}  // namespace

EnvironmentLight::EnvironmentLight(const Scene& scene)
    : scale_(scene.environment.radiance),
      cos_rotation_(std::cos(scene.environment.rotation)),
      sin_rotation_(std::sin(scene.environment.rotation)) {
  if (scene.environment.image < 0) {
    mean_radiance_ = mean(scale_);
    return;
  }
  image_ = &scene.images[std::size_t(scene.environment.image)];
  const int width = image_->width, height = image_->height;
  row_cdf_.resize(std::size_t(height) + 1);
  column_cdf_.resize(std::size_t(height) * std::size_t(width + 1));
  const auto brightness = [&](int column, int row) {
    const float* texel =
        image_->rgba32f.data() + 4 * (std::size_t(row) * std::size_t(width) + std::size_t(column));
    return std::max(0.0f, mean(scale_ * Color(texel[0], texel[1], texel[2])));
  };
  // Bilinear interpolation spreads a texel over its neighbours: a texel's share is what radiance()
  // shows within it, or a sun's rim would be found by luck alone.
  constexpr double center_share = 0.75, side_share = 0.125;
  std::vector<double> rows(std::size_t(width), 0.0);
  double total = 0.0, solid = 0.0;
  for (int y = 0; y < height; ++y) {
    float* cdf = column_cdf_.data() + std::size_t(y) * std::size_t(width + 1);
    for (int x = 0; x < width; ++x) {
      rows[std::size_t(x)] = center_share * brightness(x, y) +
                             side_share * (brightness(x, std::max(y - 1, 0)) +
                                           brightness(x, std::min(y + 1, height - 1)));
    }
    double sum = 0.0;
    cdf[0] = 0.0f;
    for (int x = 0; x < width; ++x) {
      sum += center_share * rows[std::size_t(x)] +
             side_share *
                 (rows[std::size_t((x + width - 1) % width)] + rows[std::size_t((x + 1) % width)]);
      cdf[x + 1] = static_cast<float>(sum);
    }
    for (int x = 1; x <= width; ++x) {
      cdf[x] = sum > 0.0 ? static_cast<float>(cdf[x] / sum)
                         : static_cast<float>(x) / static_cast<float>(width);
    }
    cdf[width] = 1.0f;
    const double sin_theta = std::sin(std::numbers::pi * (y + 0.5) / height);
    total += sum * sin_theta;
    solid += width * sin_theta;
    row_cdf_[std::size_t(y) + 1] = static_cast<float>(total);
  }
  for (float& c : row_cdf_) c = total > 0.0 ? static_cast<float>(c / total) : 0.0f;
  row_cdf_.back() = 1.0f;
  mean_radiance_ = static_cast<float>(total / solid);
  find_level();
}

// By a histogram over the logarithm of the texels' brightness.
void EnvironmentLight::find_level() {
  constexpr int bin_count = 512;
  constexpr double darkest = -20.0, octaves_a_bin = 0.125;  // relative to the mean, log2
  constexpr double most_variation = 0.5;
  struct Bin {
    double solid = 0.0, sum = 0.0, squares = 0.0;
  };
  std::vector<Bin> bins(bin_count);
  const int width = image_->width, height = image_->height;
  Bin below;
  double solid = 0.0, brightest = 0.0;
  for (int y = 0; y < height; ++y) {
    const double sin_theta = std::sin(std::numbers::pi * (y + 0.5) / height);
    const float* row = image_->rgba32f.data() + 4 * std::size_t(y) * std::size_t(width);
    for (int x = 0; x < width; ++x, row += 4) {
      const double b =
          std::max(0.0f, mean(scale_ * Color(row[0], row[1], row[2]))) / double(mean_radiance_);
      solid += sin_theta;
      brightest = std::max(brightest, b);
      const double place = b > 0.0 ? (std::log2(b) - darkest) / octaves_a_bin : 0.0;
      Bin& bin = bins[std::size_t(std::clamp(place, 0.0, double(bin_count - 1)))];
      bin.solid += sin_theta;
      bin.sum += b * sin_theta;
      bin.squares += b * b * sin_theta;
    }
  }
  if (!(mean_radiance_ > 0.0f)) return;
  for (int i = 0; i < bin_count; ++i) {
    // With all that is brighter than this bin held at its upper end.
    const Bin& bin = bins[std::size_t(i)];
    below.solid += bin.solid;
    below.sum += bin.sum;
    below.squares += bin.squares;
    const double level = std::exp2(darkest + octaves_a_bin * (i + 1)), above = solid - below.solid;
    const double sum = below.sum + above * level, squares = below.squares + above * level * level;
    if (squares * solid <= (1.0 + most_variation * most_variation) * sum * sum) continue;
    if (level < brightest) level_ = static_cast<float>(level) * mean_radiance_;
    return;
  }
}

float EnvironmentLight::peak_share(const Color& radiance) const {
  const float brightness = mean(radiance);
  return brightness > level_ ? 1.0f - level_ / brightness : 0.0f;
}

// Position in the map, each coordinate in [0, 1].
V2f EnvironmentLight::map_position(const V3f& d) const {
  const float x = d.x * cos_rotation_ - d.z * sin_rotation_;
  const float z = d.x * sin_rotation_ + d.z * cos_rotation_;
  const float u = std::atan2(x, -z) / (2.0f * pi) + 0.5f;
  const float v = std::acos(std::clamp(d.y, -1.0f, 1.0f)) / pi;
  return {u, v};
}

Color EnvironmentLight::radiance(const V3f& direction) const {
  if (!image_) return scale_;
  const int width = image_->width, height = image_->height;
  const V2f at = map_position(direction);
  const float x = at.x * static_cast<float>(width) - 0.5f;
  const float y =
      std::clamp(at.y * static_cast<float>(height) - 0.5f, 0.0f, static_cast<float>(height - 1));
  const float left = std::floor(x), top = std::floor(y);
  const float fx = x - left, fy = y - top;
  const int x0 = (static_cast<int>(left) + width) % width, x1 = (x0 + 1) % width;
  const int y0 = static_cast<int>(top), y1 = std::min(y0 + 1, height - 1);
  const auto texel = [&](int column, int row) {
    const float* p =
        image_->rgba32f.data() + 4 * (std::size_t(row) * std::size_t(width) + std::size_t(column));
    return Color(p[0], p[1], p[2]);
  };
  const Color upper = texel(x0, y0) * (1.0f - fx) + texel(x1, y0) * fx;
  const Color lower = texel(x0, y1) * (1.0f - fx) + texel(x1, y1) * fx;
  return scale_ * (upper * (1.0f - fy) + lower * fy);
}

float EnvironmentLight::pdf(const V3f& direction) const {
  if (!image_) return 1.0f / (4.0f * pi);
  const int width = image_->width, height = image_->height;
  const V2f at = map_position(direction);
  const int x = std::clamp(static_cast<int>(at.x * static_cast<float>(width)), 0, width - 1);
  const int y = std::clamp(static_cast<int>(at.y * static_cast<float>(height)), 0, height - 1);
  const float* cdf = column_cdf_.data() + std::size_t(y) * std::size_t(width + 1);
  const float row = row_cdf_[std::size_t(y) + 1] - row_cdf_[std::size_t(y)];
  const float cell =
      row * (cdf[x + 1] - cdf[x]) * static_cast<float>(width) * static_cast<float>(height);
  const float sin_theta = std::sin(pi * at.y);
  return sin_theta > 0.0f ? cell / (2.0f * pi * pi * sin_theta) : 0.0f;
}

V3f EnvironmentLight::sample(const V2f& u, float& pdf_out) const {
  float phi, theta;
  if (!image_) {
    phi = 2.0f * pi * u.x;
    theta = std::acos(std::clamp(1.0f - 2.0f * u.y, -1.0f, 1.0f));
    pdf_out = 1.0f / (4.0f * pi);
  } else {
    const int width = image_->width, height = image_->height;
    float fx, fy;
    const int y = find_interval(row_cdf_.data(), height, u.y, fy);
    const int x =
        find_interval(column_cdf_.data() + std::size_t(y) * std::size_t(width + 1), width, u.x, fx);
    phi = 2.0f * pi * ((static_cast<float>(x) + fx) / static_cast<float>(width) - 0.5f);
    theta = pi * (static_cast<float>(y) + fy) / static_cast<float>(height);
  }
  const float sin_theta = std::sin(theta);
  const float x = sin_theta * std::sin(phi), z = -sin_theta * std::cos(phi);
  const V3f direction(x * cos_rotation_ + z * sin_rotation_, std::cos(theta),
                      -x * sin_rotation_ + z * cos_rotation_);
  if (image_) pdf_out = pdf(direction);
  return direction;
}

float EnvironmentLight::share_above(float density) const {
  if (!image_) return 1.0f / (4.0f * pi) > density ? 1.0f : 0.0f;
  const int width = image_->width, height = image_->height;
  double share = 0.0;
  for (int y = 0; y < height; ++y) {
    const float row = row_cdf_[std::size_t(y) + 1] - row_cdf_[std::size_t(y)];
    const float* cdf = column_cdf_.data() + std::size_t(y) * std::size_t(width + 1);
    // The density is greatest where a texel is nearest to its pole.
    const float nearest =
        static_cast<float>(std::min(y, height - 1 - y)) / static_cast<float>(height);
    const float least = density * 2.0f * pi * pi * std::sin(pi * nearest) /
                        (static_cast<float>(width) * static_cast<float>(height));
    for (int x = 0; x < width; ++x) {
      const float cell = row * (cdf[x + 1] - cdf[x]);
      // Rounding must not lose a texel that pdf() counts.
      if (cell > least * (1.0f - 1e-4f)) share += cell;
    }
  }
  return static_cast<float>(share);
}

}  // namespace lumivec
