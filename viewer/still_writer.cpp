#include "viewer/still_writer.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>

#include "viewer/atomic_file.h"
#include "viewer/errors.h"
#include "viewer/version.h"

namespace fs = std::filesystem;

namespace lumivec {
namespace {

// Rec. 709 primaries and D65 white, CIE xy: red, green, blue, white.
constexpr float rec709_chromaticities[8] = {0.64f, 0.33f, 0.30f,   0.60f,
                                            0.15f, 0.06f, 0.3127f, 0.3290f};

constexpr int jpeg_quality =
    95;  // errors stay near the 8-bit step; twice the size would halve them

[[noreturn]] void fail(const fs::path& file, std::string reason) {
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  if (reason.empty()) reason = "no reason is given";
  throw CommandError(file.string() + ": cannot be written: " + reason +
                     "; see whether the disk is full");
}

void describe(OIIO::ImageSpec& spec, const StillHeader& header) {
  spec.attribute("Software", software_name());
  spec.attribute("lumivec:scene", header.scene);
  spec.attribute("lumivec:settings", header.settings);
  spec.attribute("lumivec:samples", float(header.samples));
  spec.attribute("lumivec:seconds", float(header.seconds));
}

// Writes rows in strips: fill(first, last, bytes) makes the rows [first, last).
template <typename Fill>
void write_strips(const fs::path& shown, const fs::path& file, const char* format,
                  const OIIO::ImageSpec& spec, OIIO::TypeDesc type, std::size_t row_bytes,
                  const Fill& fill) {
  constexpr int strip_rows = 64;  // a multiple of the 16 rows that OpenEXR compresses together
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) fail(shown, OIIO::geterror());
  if (!output->open(file.string(), spec)) fail(shown, output->geterror());
  std::vector<std::byte> strip(row_bytes * std::size_t(std::min(strip_rows, spec.height)));
  for (int y = 0; y < spec.height; y += strip_rows) {
    const int end = std::min(y + strip_rows, spec.height);
    fill(y, end, strip.data());
    if (!output->write_scanlines(y, end, 0, type, strip.data())) fail(shown, output->geterror());
  }
  if (!output->close()) fail(shown, output->geterror());
}

template <typename Integer>
Integer quantized(float value) {
  constexpr float top = float(std::numeric_limits<Integer>::max());
  if (!(value > 0.0f)) return 0;  // NaN too
  return Integer(std::lround(std::min(value, 1.0f) * top));
}

template <typename Integer>
void quantize_rows(const Picture& picture, int begin, int end, std::byte* bytes) {
  auto* out = reinterpret_cast<Integer*>(bytes);
  const std::size_t width = std::size_t(picture.width);
  for (std::size_t i = std::size_t(begin) * width; i < std::size_t(end) * width; ++i) {
    for (int c = 0; c < 3; ++c) *out++ = quantized<Integer>(picture.pixels[i][c]);
  }
}

}  // namespace

StillFormat still_format(const fs::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".exr") return StillFormat::exr;
  if (extension == ".png") return StillFormat::png;
  if (extension == ".jpg" || extension == ".jpeg") return StillFormat::jpeg;
  throw UsageError(file.string() + ": " +
                   (extension.empty() ? "has no extension" : "'" + extension + "' is no picture") +
                   "; use .exr, .png or .jpg");
}

std::uint64_t write_exr(const fs::path& file, const Framebuffer& framebuffer,
                        const ExrOptions& options, const StillHeader& header) {
  const std::vector<ExrChannel> channels =
      exr_channels(options.terms, options.precision, options.beauty);
  OIIO::ImageSpec spec(framebuffer.width, framebuffer.height, int(channels.size()),
                       OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const ExrChannel& channel : channels) {
    spec.channelnames.push_back(channel.name);
    spec.channelformats.emplace_back(channel.is_half ? OIIO::TypeDesc::HALF
                                                     : OIIO::TypeDesc::FLOAT);
  }
  spec.alpha_channel = -1;
  spec.attribute("compression", "zip");
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709_chromaticities);
  describe(spec, header);

  const std::size_t width = std::size_t(framebuffer.width);
  std::uint64_t clamped_pixels = 0;
  write_atomically(file, [&](const fs::path& temporary) {
    write_strips(file, temporary, "exr", spec, OIIO::TypeDesc::UNKNOWN,
                 exr_pixel_bytes(channels) * width, [&](int begin, int end, std::byte* bytes) {
                   clamped_pixels +=
                       pack_exr_pixels(framebuffer, channels, std::size_t(begin) * width,
                                       std::size_t(end) * width, bytes);
                 });
  });
  return clamped_pixels;
}

void write_displayed(const fs::path& file, const Picture& displayed,
                     const DisplayedOptions& options, const StillHeader& header) {
  const bool is_jpeg = still_format(file) == StillFormat::jpeg;
  const bool deep = options.bits == 16 && !is_jpeg;
  const OIIO::TypeDesc type = deep ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
  OIIO::ImageSpec spec(displayed.width, displayed.height, 3, type);
  if (options.is_srgb) spec.attribute("oiio:ColorSpace", "sRGB");
  if (is_jpeg) {
    spec.attribute("CompressionQuality", jpeg_quality);
    spec.attribute("jpeg:subsampling", "4:4:4");  // renders have coloured edges
  }
  describe(spec, header);

  const std::size_t row_bytes = std::size_t(displayed.width) * 3 * (deep ? 2 : 1);
  write_atomically(file, [&](const fs::path& temporary) {
    write_strips(file, temporary, is_jpeg ? "jpeg" : "png", spec, type, row_bytes,
                 [&](int begin, int end, std::byte* bytes) {
                   deep ? quantize_rows<std::uint16_t>(displayed, begin, end, bytes)
                        : quantize_rows<std::uint8_t>(displayed, begin, end, bytes);
                 });
  });
}

}  // namespace lumivec
