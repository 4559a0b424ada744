#include "viewer/layered_image.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <memory>

#include "viewer/errors.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

using LayerChannels =
    std::map<std::string, std::array<int, 3>>;  // channel indices of R, G, B; -1: missing

[[noreturn]] void fail(const fs::path& file, std::string reason) {
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  throw CommandError(file.string() + ": " + reason);
}

LayerChannels find_layers(const OIIO::ImageSpec& spec) {
  LayerChannels layers;
  for (int channel = 0; channel < spec.nchannels; ++channel) {
    const std::string& name = spec.channelnames[std::size_t(channel)];
    const std::size_t point = name.rfind('.');
    const std::string last = point == std::string::npos ? name : name.substr(point + 1);
    const std::size_t component = std::string("RGB").find(last);
    if (last.size() != 1 || component == std::string::npos) continue;
    const std::string layer = point == std::string::npos ? beauty_layer : name.substr(0, point);
    layers.try_emplace(layer, std::array<int, 3>{-1, -1, -1}).first->second[component] = channel;
  }
  std::erase_if(layers, [](const auto& entry) {
    const std::array<int, 3>& channels = entry.second;
    return std::find(channels.begin(), channels.end(), -1) != channels.end();
  });
  return layers;
}

void read_part(OIIO::ImageInput& input, int part, const fs::path& file, LayeredImage& image) {
  const OIIO::ImageSpec& spec = input.spec();
  const LayerChannels layers = find_layers(spec);
  if (layers.empty()) return;
  if (!spec.format.is_floating_point()) {
    fail(file, "holds displayed values, not radiance; give an OpenEXR picture");
  }
  if (image.layers.empty()) {
    image.width = spec.width;
    image.height = spec.height;
  } else if (image.width != spec.width || image.height != spec.height) {
    fail(file, "has parts of different sizes; give a picture whose layers are of one size");
  }
  // Layer by layer: a file of many layers never stands in memory twice.
  for (const auto& [name, channels] : layers) {
    const auto [low, high] = std::minmax_element(channels.begin(), channels.end());
    const std::size_t stride = std::size_t(*high - *low + 1);
    Picture picture(spec.width, spec.height);
    std::vector<float> values(stride * picture.pixels.size());
    if (!input.read_image(part, 0, *low, *high + 1, OIIO::TypeDesc::FLOAT, values.data())) {
      fail(file, "cannot be read: " + input.geterror());
    }
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
      for (std::size_t c = 0; c < channels.size(); ++c) {
        picture.pixels[i][int(c)] = values[i * stride + std::size_t(channels[c] - *low)];
      }
    }
    image.layers.insert_or_assign(name, std::move(picture));
  }
}

}  // namespace

LayeredImage read_layered_image(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) fail(file, "no such file");
  if (!fs::is_regular_file(file, error)) fail(file, "is not a file");
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string());
  if (!input) fail(file, "cannot be read as a picture: " + OIIO::geterror());
  LayeredImage image;
  for (int part = 0; input->seek_subimage(part, 0); ++part) read_part(*input, part, file, image);
  if (image.layers.empty()) {
    fail(file, "holds no layer with channels R, G and B; give a picture of a render");
  }
  return image;
}

}  // namespace lumivec
