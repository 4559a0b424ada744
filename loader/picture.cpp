#include "loader/picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string_view>

namespace lumivec {
namespace {

// Only what glTF allows is decoded: each further decoder would be one more that a hostile file can
// choose.
const char* format_of(std::span<const std::uint8_t> file) {
  const std::string_view head(reinterpret_cast<const char*>(file.data()),
                              std::min<std::size_t>(file.size(), 16));
  if (head.starts_with("\x89PNG\r\n\x1a\n")) return "png";
  if (head.starts_with("\xff\xd8\xff")) return "jpeg";
  if (head.starts_with("RIFF") && head.substr(8).starts_with("WEBP")) return "webp";
  return nullptr;
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? "malformed" : text;
}

// Grey and alpha from their places among the first channels to all four.
template <class T>
void spread(std::vector<T>& pixels, int channels, T full) {
  if (channels >= 4) return;
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    if (channels == 2) pixels[i + 3] = pixels[i + 1];
    if (channels <= 2) pixels[i + 1] = pixels[i + 2] = pixels[i];
    if (channels != 2) pixels[i + 3] = full;
  }
}

template <class T>
void read_pixels(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, OIIO::TypeDesc type, T full,
                 std::vector<T>& pixels) {
  const int channels = std::min(spec.nchannels, 4);
  pixels.resize(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.height) * 4);
  if (!input.read_image(0, 0, 0, channels, type, pixels.data(), 4 * sizeof(T))) {
    throw std::runtime_error(one_line(input.geterror()));
  }
  spread(pixels, channels, full);
}

}  // namespace

Image decode_picture(std::span<const std::uint8_t> file,
                     const std::function<void(std::uint64_t bytes)>& claim) {
  const char* format = format_of(file);
  if (!format) throw std::runtime_error("is neither PNG nor JPEG nor WebP");
  auto input = OIIO::ImageInput::create(format);
  if (!input) throw std::runtime_error(std::string("OpenImageIO was built without ") + format);

  OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(file.data()), file.size());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  OIIO::ImageSpec spec;
  const std::string name = std::string("memory.") + format;
  if (!input->set_ioproxy(&memory) || !input->open(name, spec, config)) {
    throw std::runtime_error(one_line(input->geterror()));
  }
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.depth > 1) {
    throw std::runtime_error("has no pixels");
  }
  const bool bytes = spec.format.basetype == OIIO::TypeDesc::UINT8;
  claim(static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height) * 4 *
        (bytes ? sizeof(std::uint8_t) : sizeof(float)));
  Image image;
  image.width = spec.width;
  image.height = spec.height;
  if (bytes) {
    read_pixels<std::uint8_t>(*input, spec, OIIO::TypeUInt8, 255, image.rgba8);
  } else {
    read_pixels<float>(*input, spec, OIIO::TypeFloat, 1.0f, image.rgba32f);
  }
  input->close();
  return image;
}

}  // namespace lumivec
