#include "loader/pov/image_maps.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "loader/error.h"
#include "loader/picture.h"
#include "loader/pov/patterns.h"

namespace lumivec::pov {
namespace {

constexpr int planar = 0, spherical = 1, cylindrical = 2;
constexpr int bilinear = 2, normalized_distance = 4;  // interpolate

double srgb_to_linear(double v) {
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// Light of a picture's number, as the scene would write it.
float as_written(double v, double file_gamma, double scene_gamma) {
  const double linear =
      file_gamma > 0.0 ? std::pow(std::max(v, 0.0), file_gamma) : srgb_to_linear(std::max(v, 0.0));
  return static_cast<float>(std::pow(linear, 1.0 / scene_gamma));
}

MapPicture picture_of(const Image& image, double file_gamma, double scene_gamma) {
  MapPicture picture;
  picture.width = image.width;
  picture.height = image.height;
  const std::size_t count = std::size_t(image.width) * std::size_t(image.height);
  picture.pixels.resize(count);
  constexpr double full = 255.0;
  std::array<float, 256> of_byte{};
  for (std::size_t i = 0; i < of_byte.size(); ++i)
    of_byte[i] = as_written(static_cast<double>(i) / full, file_gamma, scene_gamma);
  std::array<double, 4> sum{};
  for (std::size_t i = 0; i < count; ++i) {
    std::array<float, 4>& pixel = picture.pixels[i];
    for (std::size_t c = 0; c < 4; ++c) {
      const bool bytes = image.rgba32f.empty();
      if (c == 3) {
        pixel[c] =
            bytes ? static_cast<float>(image.rgba8[4 * i + c] / full) : image.rgba32f[4 * i + c];
      } else {
        pixel[c] = bytes ? of_byte[image.rgba8[4 * i + c]]
                         : as_written(double(image.rgba32f[4 * i + c]), file_gamma, scene_gamma);
      }
      if (!std::isfinite(pixel[c])) pixel[c] = 0.0f;
      sum[c] += double(pixel[c]);
    }
  }
  for (std::size_t c = 0; c < 4; ++c)
    picture.mean[c] =
        static_cast<float>(sum[c] / static_cast<double>(std::max(count, std::size_t{1})));
  return picture;
}

std::shared_ptr<const MapPicture> read_picture(Parser& parser, const ImageUse& use,
                                               const Place& place) {
  const double scene_gamma = parser.scene.settings.assumed_gamma;
  auto& known = parser.pictures[{use.file, use.named_in, use.gamma, scene_gamma}];
  if (known) return known;
  const auto leave_out = [&](const std::string& why) {
    parser.mention(place, "a picture is left out: " + why);
  };
  try {
    const Image image = decode_picture(parser.sources.read(use.file, use.named_in),
                                       [&](std::uint64_t bytes) { parser.claim(bytes); });
    if (image.width < 1 || image.height < 1) return nullptr;
    parser.claim(std::uint64_t(image.width) * std::uint64_t(image.height) *
                 sizeof(std::array<float, 4>));
    known = std::make_shared<const MapPicture>(picture_of(image, use.gamma, scene_gamma));
  } catch (const FileProblem& problem) {
    leave_out(problem.problem);
  } catch (const SceneError&) {
    throw;
  } catch (const std::runtime_error& error) {
    leave_out("\"" + use.file + "\" " + error.what());
  }
  return known;
}

double of_all(const std::vector<std::pair<int, double>>& entries) {
  double value = 0.0;
  for (const auto& [index, share] : entries) {
    if (index < 0) value = share;
  }
  return value;
}

ColorFT color_of(const std::array<float, 4>& pixel, const ImageUse& image) {
  const double opacity = std::clamp(double(pixel[3]), 0.0, 1.0);
  ColorFT color{pixel[0], pixel[1], pixel[2], 0.0, 0.0};
  color.filter = std::clamp(of_all(image.filter), 0.0, 1.0) * opacity;
  color.transmit = 1.0 - opacity + std::clamp(of_all(image.transmit), 0.0, 1.0) * opacity;
  return color;
}

double fraction(double x) {
  return x - std::floor(x);
}

// Columns from the left, rows from the top, [0, 1]. None: outside a map that is there once.
std::optional<Imath::V2d> place_of(const ImageUse& image, const V3d& p) {
  const bool outside_y = p.y < 0.0 || p.y > 1.0;
  if (image.map_type == planar) {
    if (image.once && (outside_y || p.x < 0.0 || p.x > 1.0)) return std::nullopt;
    return Imath::V2d(fraction(p.x), 1.0 - fraction(p.y));
  }
  const double turn = fraction(std::atan2(p.z, p.x) / (2.0 * std::numbers::pi));
  if (image.map_type == cylindrical) {
    if (image.once && outside_y) return std::nullopt;
    return Imath::V2d(turn, 1.0 - fraction(p.y));
  }
  const double length = p.length();
  const double sine = length > 0.0 ? std::clamp(p.y / length, -1.0, 1.0) : 0.0;
  return Imath::V2d(turn, 0.5 - std::asin(sine) / std::numbers::pi);
}

}  // namespace

std::shared_ptr<const ImageUse> parse_image_map(Parser& parser) {
  const Place place = parser.place();
  auto image = std::make_shared<ImageUse>(*parse_image_block(parser));
  image->picture = read_picture(parser, *image, place);
  return image;
}

std::optional<ColorFT> image_color(const ImageUse& image, const V3d& point) {
  if (!image.picture || image.map_type < planar || image.map_type > cylindrical)
    return std::nullopt;
  if (!std::isfinite(point.length2())) return mean_image_color(image);
  const MapPicture& picture = *image.picture;
  const auto place = place_of(image, point);
  if (!place) return ColorFT{0.0, 0.0, 0.0, 0.0, 1.0};
  const double x = place->x * picture.width, y = place->y * picture.height;
  const auto pixel = [&](int column, int row) -> const std::array<float, 4>& {
    const int c = (column % picture.width + picture.width) % picture.width;
    const int r = image.map_type == spherical
                      ? std::clamp(row, 0, picture.height - 1)
                      : (row % picture.height + picture.height) % picture.height;
    return picture.pixels[std::size_t(r) * std::size_t(picture.width) + std::size_t(c)];
  };
  if (image.interpolate != bilinear && image.interpolate != normalized_distance) {
    return color_of(pixel(std::min(static_cast<int>(x), picture.width - 1),
                          std::min(static_cast<int>(y), picture.height - 1)),
                    image);
  }
  const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
  const double right_share = x - 0.5 - left, low_share = y - 0.5 - top;
  std::array<float, 4> mixed{};
  for (int tap = 0; tap < 4; ++tap) {
    const double share = (tap % 2 == 1 ? right_share : 1.0 - right_share) *
                         (tap / 2 == 1 ? low_share : 1.0 - low_share);
    const auto& from = pixel(static_cast<int>(left) + tap % 2, static_cast<int>(top) + tap / 2);
    for (std::size_t c = 0; c < 4; ++c) mixed[c] += static_cast<float>(share) * from[c];
  }
  return color_of(mixed, image);
}

ColorFT mean_image_color(const ImageUse& image) {
  if (!image.picture) return ColorFT{1.0, 1.0, 1.0, 0.0, 0.0};
  return color_of(image.picture->mean, image);
}

}  // namespace lumivec::pov
