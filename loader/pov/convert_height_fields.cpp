#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <optional>
#include <span>
#include <stdexcept>
#include <string_view>

#include "loader/error.h"
#include "loader/picture.h"
#include "loader/pov/conversion.h"

namespace lumivec::pov {
namespace {

// Heights in [0, 1], row by row from the far edge, z = 1, to the near one.
struct Heights {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<float> values;

  double at(std::uint32_t x, std::uint32_t row) const {
    return values[std::size_t{row} * width + x];
  }
};

// Grey is the height; of colors red is the higher byte and green the lower one.
float height_of(float red, float green, float blue) {
  if (red == green && green == blue) return red;
  constexpr float low_byte = 256.0f;
  return (red * low_byte + green) / (low_byte + 1.0f);
}

using Rgb = std::array<std::uint8_t, 3>;

// The palette of a PNG; empty: it has none.
std::vector<Rgb> palette_of(std::span<const std::uint8_t> file) {
  constexpr std::array<std::uint8_t, 8> signature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::size_t around = 12;  // of a chunk: its length, its name, its checksum
  if (file.size() < signature.size() ||
      !std::equal(signature.begin(), signature.end(), file.begin()))
    return {};
  for (std::size_t at = signature.size(); at + around <= file.size();) {
    std::size_t length = 0;
    for (std::size_t i = 0; i < 4; ++i) length = length << 8 | file[at + i];
    if (length > file.size() - at - around) return {};
    const std::string_view name(reinterpret_cast<const char*>(file.data()) + at + 4, 4);
    // Pictures in full color may have a palette too, as a hint.
    constexpr std::size_t kind_at = 9;
    constexpr std::uint8_t by_palette = 3;
    if (name == "IHDR" && (length <= kind_at || file[at + 8 + kind_at] != by_palette)) return {};
    if (name == "IDAT") return {};
    if (name == "PLTE") {
      std::vector<Rgb> colors;
      for (std::size_t i = 0; i + 3 <= length; i += 3)
        colors.push_back({file[at + 8 + i], file[at + 9 + i], file[at + 10 + i]});
      return colors;
    }
    at += around + length;
  }
  return {};
}

// Pictures with a palette have heights by the colors' places in it. Of places of one color, that
// next to the height before is taken.
std::vector<float> palette_heights(const Image& image, const std::vector<Rgb>& palette) {
  std::map<Rgb, std::vector<int>> places;
  for (std::size_t i = 0; i < palette.size(); ++i)
    places[palette[i]].push_back(static_cast<int>(i));
  constexpr float full = 255.0f;
  std::vector<float> heights;
  int before = 0;
  for (std::size_t i = 0; i + 3 < image.rgba8.size(); i += 4) {
    const auto found = places.find({image.rgba8[i], image.rgba8[i + 1], image.rgba8[i + 2]});
    if (found == places.end()) return {};
    before = *std::min_element(found->second.begin(), found->second.end(), [&](int a, int b) {
      return std::abs(a - before) < std::abs(b - before);
    });
    heights.push_back(static_cast<float>(before) / full);
  }
  return heights;
}

std::optional<Heights> read_heights(Parser& parser, const HeightFieldShape& field,
                                    const Place& place) {
  Image image;
  std::vector<Rgb> palette;
  try {
    const auto file = parser.sources.read(field.image.file, field.image.named_in);
    palette = palette_of(file);
    image = decode_picture(file, [&](std::uint64_t bytes) { parser.claim(bytes); });
  } catch (const FileProblem& problem) {
    parser.mention(place, "a height field is left out: " + problem.problem);
    return std::nullopt;
  } catch (const SceneError&) {
    throw;
  } catch (const std::runtime_error& error) {
    parser.mention(place, "a height field is left out: its picture \"" + field.image.file + "\" " +
                              error.what());
    return std::nullopt;
  }
  if (image.width < 2 || image.height < 2) return std::nullopt;
  Heights heights;
  heights.width = static_cast<std::uint32_t>(image.width);
  heights.height = static_cast<std::uint32_t>(image.height);
  const std::size_t count = std::size_t{heights.width} * heights.height;
  constexpr std::uint64_t bytes_of_point =
      sizeof(float) + 2 * sizeof(V3d) + 2 * sizeof(std::array<std::uint32_t, 3>);
  parser.claim(count * bytes_of_point);
  if (!palette.empty() && !image.rgba8.empty()) heights.values = palette_heights(image, palette);
  if (heights.values.size() == count) return heights;
  heights.values.clear();
  heights.values.reserve(count);
  constexpr float full = 255.0f;
  for (std::size_t i = 0; i < 4 * count; i += 4) {
    if (image.rgba32f.empty()) {
      heights.values.push_back(height_of(static_cast<float>(image.rgba8[i]) / full,
                                         static_cast<float>(image.rgba8[i + 1]) / full,
                                         static_cast<float>(image.rgba8[i + 2]) / full));
    } else {
      heights.values.push_back(
          height_of(image.rgba32f[i], image.rgba32f[i + 1], image.rgba32f[i + 2]));
    }
  }
  return heights;
}

V3d normal_at(const Heights& h, std::uint32_t x, std::uint32_t row) {
  const std::uint32_t left = x == 0 ? 0 : x - 1, right = std::min(x + 1, h.width - 1);
  const std::uint32_t far = row == 0 ? 0 : row - 1, near = std::min(row + 1, h.height - 1);
  const double along_x = (h.at(right, row) - h.at(left, row)) * (h.width - 1) / (right - left);
  const double along_z = (h.at(x, far) - h.at(x, near)) * (h.height - 1) / (near - far);
  return V3d(-along_x, 1.0, -along_z).normalized();
}

}  // namespace

std::shared_ptr<const MeshShape> height_field_mesh(Parser& parser, const HeightFieldShape& field,
                                                   const Place& place) {
  const std::optional<Heights> read = read_heights(parser, field, place);
  if (!read) return nullptr;
  const Heights& h = *read;
  auto mesh = std::make_shared<MeshShape>();
  mesh->points.reserve(h.values.size());
  for (std::uint32_t row = 0; row < h.height; ++row) {
    for (std::uint32_t x = 0; x < h.width; ++x) {
      mesh->points.emplace_back(static_cast<double>(x) / (h.width - 1),
                                std::max(h.at(x, row), field.water_level),
                                1.0 - static_cast<double>(row) / (h.height - 1));
      mesh->bounds.extendBy(mesh->points.back());
      if (field.smooth) mesh->normals.push_back(normal_at(h, x, row));
    }
  }
  // What lies under water is not there.
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const auto dry = [&](std::uint32_t i) { return h.values[i] > field.water_level; };
    if (field.water_level <= 0.0 || dry(a) || dry(b) || dry(c)) mesh->faces.push_back({a, b, c});
  };
  for (std::uint32_t row = 0; row + 1 < h.height; ++row) {
    for (std::uint32_t x = 0; x + 1 < h.width; ++x) {
      const std::uint32_t far = row * h.width + x, near = far + h.width;
      add(far, far + 1, near);
      add(near, far + 1, near + 1);
    }
  }
  return mesh;
}

}  // namespace lumivec::pov
